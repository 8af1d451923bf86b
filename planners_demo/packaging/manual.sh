#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
#   planners_demo/packaging/manual.sh PROGRAM DATE
# The manual page swept(1), of that date, on stdout: what PROGRAM's --help says, and that of each subcommand.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
if (($# != 2)) || [[ ! -x "$1" ]]; then
  echo "error: usage: manual.sh PROGRAM DATE, where PROGRAM can be run" >&2
  exit 3
fi
program="$1"

help() { "$program" "$@" --help; }
# Of the program, or of a subcommand that has some.
subcommands() { help "$@" | awk '/^[A-Z]/ { inside = /^Subcommands:$/ } inside && /^  [a-z]/ { print $1 }'; }
page() { LC_ALL=C awk -f "$here/manual.awk" -v part="$1"; }

# As they are typed, one a line.
commands=()
while read -r name; do
  mapfile -t below < <(subcommands "$name")
  if ((${#below[@]} == 0)); then commands+=("$name"); else commands+=("${below[@]/#/$name }"); fi
done < <(subcommands)
((${#commands[@]} > 0)) || { echo "error: $program --help names no subcommands" >&2 && exit 3; }

version="$("$program" --version)"
echo '.\" Made of what the program says of itself.'
echo ".TH SWEPT 1 $2 \"$version\" \"User Commands\""
help | page name
echo '.SH SYNOPSIS'
echo .nf
for command in "${commands[@]}"; do
  # shellcheck disable=SC2086
  help $command | page synopsis
done
echo .fi
echo '.SH OPTIONS'
help | page options
echo '.SH SUBCOMMANDS'
for command in "${commands[@]}"; do
  # shellcheck disable=SC2086
  help $command | page command
done
echo '.SH EXIT STATUS'
help | page notes

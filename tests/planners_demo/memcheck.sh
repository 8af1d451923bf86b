#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# memcheck.sh SWEPT PROBE: runs the program's main commands under valgrind's memcheck, from the top
# folder of the tree. Exit code 1: a command used memory wrongly, lost some, or answered otherwise than
# without; 77: there is no valgrind, or none that can run PROBE, an empty program (skipped).
set -euo pipefail
swept="$1"
source "$(dirname "${BASH_SOURCE[0]}")/../valgrind/valgrind.sh"
if ! require_valgrind "$2"; then
  echo "skipped: $missing"
  exit 77
fi
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
arm=(tests/planners_demo/planar_arm.urdf --group arm)
task=("${arm[@]}" --scene tests/planners_demo/posts.yaml)
bad=0

# A build without three.js has no pages.
page=()
if [[ "$("$swept" plan --help)" == *--html* ]]; then page=(--html "$folder/path.html"); fi

# What the program said: times differ from run to run, and with them the widths of columns.
said() {
  sed -E 's/[0-9.]+(e-?[0-9]+)? (s|ms|us|ns)\b/# s/g; s/ +/ /g' "$1"
}

# expect EXIT_CODE ARGUMENT ...
expect() {
  local expected="$1" status=0 plain=0 what
  shift
  "$swept" "$@" >"$folder/plain.out" 2>"$folder/plain.err" || plain=$?
  # What is lost, and not what libraries keep until the end.
  valgrind --quiet --log-file="$folder/log" --error-exitcode=99 --leak-check=full \
    --show-leak-kinds=definite --errors-for-leak-kinds=definite \
    "$swept" "$@" >"$folder/valgrind.out" 2>"$folder/valgrind.err" || status=$?
  local failure=""
  if ((status != expected || plain != expected)); then
    failure="exit code $status, $plain without valgrind, expected $expected"
  fi
  for what in out err; do
    diff <(said "$folder/plain.$what") <(said "$folder/valgrind.$what") >"$folder/diff.$what" ||
      failure+="${failure:+; }another std$what than without valgrind"
  done
  if [[ -z "$failure" ]]; then
    echo "clean: swept $*"
  else
    echo "FAILED: swept $*: $failure"
    head -n 60 "$folder/log" "$folder/valgrind.err" "$folder"/diff.*
    bad=1
  fi
}

expect 0 info models/robots/drifter/drifter.urdf
expect 0 check "${task[@]}" left 1.2,-0.3,0.2
expect 1 check "${task[@]}" 0,0.1,0
expect 0 check "${arm[@]}" --cloud models/clouds/shelf.bt left
expect 1 motion "${task[@]}" left 1.2,-0.3,0.2
expect 0 plan "${task[@]}" left 1.2,-0.3,0.2 --seed 1 -o "$folder/path.json" "${page[@]}"
expect 0 verify "$folder/path.json"
expect 0 acm "${arm[@]:0:1}" -o "$folder/arm.srdf"
expect 0 replay models/cases.json
expect 3 info models/README.md
exit "$bad"

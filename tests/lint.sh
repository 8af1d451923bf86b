#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Looks through sources with clang-tidy and cppcheck, and prints one line for each finding. Exit code 1:
# there are findings.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
source "$root/.ci/setup.sh"

usage() {
  echo "usage: tests/lint.sh [FILE|FOLDER ...]"
  echo "Without any: all sources that the build has."
}

for argument in "$@"; do
  case "$argument" in
    -h | --help) usage && exit 0 ;;
    -*)
      echo "error: no option '$argument'" >&2
      usage >&2
      exit 2
      ;;
  esac
done

install_packages
install_packages "$root/.ci/lint-packages.txt"
# Configured only: nothing that is looked at is generated.
(cd "$root" && cmake --preset clang -B build/lint -DSWEPT_BUILD_BENCHMARKS=ON) >/dev/null
exec python3 -B "$root/tests/lint.py" "$root" "$root/build/lint" "$@"

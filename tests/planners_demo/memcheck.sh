#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# memcheck.sh SWEPT: runs the program's main commands under valgrind's memcheck, from the top folder
# of the tree. Exit code 1: a command used memory wrongly, lost some, or answered otherwise than
# without; 77: there is no valgrind (skipped).
set -euo pipefail
swept="$1"
if ! command -v valgrind >/dev/null; then
  echo "skipped: no valgrind"
  exit 77
fi
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
arm=(tests/ompl_bridge/planar_arm.urdf --group arm)
task=("${arm[@]}" --scene tests/ompl_bridge/posts.yaml)
bad=0

# expect EXIT_CODE ARGUMENT ...
expect() {
  local expected="$1" status=0
  shift
  # What is lost, and not what libraries keep until the end.
  valgrind --quiet --error-exitcode=99 --leak-check=full --show-leak-kinds=definite \
    --errors-for-leak-kinds=definite "$swept" "$@" >"$folder/out" 2>"$folder/err" || status=$?
  if ((status == expected)); then
    echo "clean: swept $*"
  else
    echo "FAILED: swept $*: exit code $status, expected $expected"
    head -n 60 "$folder/err"
    bad=1
  fi
}

expect 0 info models/robots/drifter/drifter.urdf
expect 0 check "${task[@]}" left 1.2,-0.3,0.2
expect 1 check "${task[@]}" 0,0.1,0
expect 0 check "${arm[@]}" --cloud models/clouds/shelf.bt left
expect 1 motion "${task[@]}" left 1.2,-0.3,0.2
expect 0 plan "${task[@]}" left 1.2,-0.3,0.2 --seed 1 -o "$folder/path.json" --html "$folder/path.html"
expect 0 verify "$folder/path.json"
expect 0 acm "${arm[@]:0:1}" -o "$folder/arm.srdf"
expect 0 replay models/cases.json
expect 3 info models/README.md
exit "$bad"

#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# A path with a proof that needs no trust in what found it: plans one, and has its proof checked.
#   12_verify.sh SWEPT
# `swept verify` decides with code that shares nothing with planner and library; 13_certify_path has
# the library's calls. Exits 0 if the proof holds as it was written, and is refused after each
# change.
set -euo pipefail
swept="$1"
folder="$(mktemp -d)"
trap 'rm -r "$folder"' EXIT

# With --embed robot and world are in the file, too: nothing else is needed to check it elsewhere.
"$swept" plan models/robots/rook7/rook7.urdf home ready --group arm \
  --scene models/scenes/narrow_slot.yaml --embed -o "$folder/path.json"
"$swept" verify "$folder/path.json" > "$folder/answer"
head -2 "$folder/answer"

wrong=0
refused() {  # WHAT SED-SCRIPT: the file with this change has exit code 1, and is told what is wrong
  sed -E "$2" "$folder/path.json" > "$folder/changed.json"
  local code=0
  "$swept" verify "$folder/changed.json" > "$folder/answer" 2>&1 || code=$?
  echo "$1: $(head -1 "$folder/answer")"
  [ "$code" = 1 ] || wrong=1
}
refused "the start is another" 's/^(  \[\[?0\.0,)-0\.5,/\1-0.4,/'
refused "a plate is 1 cm nearer" 's/0\.42,0\.31,0\.48/0.42,0.30,0.48/'
refused "a clearance is exaggerated" 's/("clearance":0\.)0/\11/'
refused "a part of the motion is left out" 's/("intervals":\[\[0\.0),1\.0,/\1,0.9,/'
exit "$wrong"

#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Compares what two builds of swept answer, of which the second one may be for another processor and run in an
# emulator: answers and proofs bit by bit, and each verifies the other one's proofs. Exit code 1: a verdict
# differs, or a proof does not hold.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
root="$(cd "$here/../.." && pwd)"

usage() {
  echo "usage: tests/packaging/same_answers.sh BUILD OTHER FOLDER [EMULATOR ...]"
  echo "BUILD, OTHER: builds of the targets swept_answers_record and swept_proofs_record. EMULATOR: a command that runs"
  echo "programs of OTHER. FOLDER is made, for the records and proofs."
  echo "\$COUNT questions (default 3000) are asked of each, \$ROBOTS (a regular expression) of some robots only;"
  echo "BUILD asks them with each instruction set of \$TARGETS (default: SCALAR SSE4 AVX2)."
  echo "\$PATHS (a regular expression; default: shelf): the stored paths to prove."
}

if [[ "${1:-}" == -h || "${1:-}" == --help ]]; then usage && exit 0; fi
if (($# < 3)); then
  usage >&2
  exit 3
fi
mkdir -p "$3"
build="$(realpath "$1")" other="$(realpath "$2")" folder="$(realpath "$3")"
emulator=("${@:4}")
for file in {"$build","$other"}/tests/answers/swept_{answers,proofs}_record; do
  if [[ ! -x "$file" ]]; then
    echo "error: no $file; build the targets swept_answers_record and swept_proofs_record" >&2
    exit 3
  fi
done
cd "$root"
failed=0

here_() { "$build/$1" "${@:2}"; }
there() { "${emulator[@]}" "$other/$1" "${@:2}"; }

# record WHERE NAME ARGUMENT...: what one build answers, without the line that names its instruction set.
record() {
  "$1" tests/answers/swept_answers_record --seed 1 --count "${COUNT:-3000}" --robots "${ROBOTS:-.}" \
    --out "$folder/$2.all" --each "$folder/$2.each.all" "${@:3}" >"$folder/$2.said" 2>&1 || failed=1
  grep -v '^#' "$folder/$2.all" >"$folder/$2.txt"
  grep -v '^#' "$folder/$2.each.all" >"$folder/$2.each.txt"
}

record there other
for target in ${TARGETS:-SCALAR SSE4 AVX2}; do
  record here_ "$target" --target "$target"
  printf '%-8s' "$target"
  python3 -B tests/answers/compare.py "$folder/$target.each.txt" "$folder/other.each.txt" >"$folder/$target.differ" || failed=1
  tail -n 1 "$folder/$target.differ"
done

rm -rf "$folder/proofs"
here_ tests/answers/swept_proofs_record write "$folder/proofs/here" "${PATHS:-shelf}" >"$folder/verdicts_here.txt" || failed=1
there tests/answers/swept_proofs_record write "$folder/proofs/there" "${PATHS:-shelf}" >"$folder/verdicts_there.txt" || failed=1
if ! diff "$folder/verdicts_here.txt" "$folder/verdicts_there.txt"; then
  echo "these verdicts of stored paths differ"
  failed=1
fi
same=0
all=0
for file in "$folder"/proofs/here/*.json; do
  all=$((all + 1))
  if cmp -s "$file" "$folder/proofs/there/${file##*/}"; then same=$((same + 1)); fi
done
echo "paths: $(wc -l <"$folder/verdicts_here.txt") with the same verdict; proofs: $same of $all are the same, byte for byte"
said="$(here_ tests/answers/swept_proofs_record verify "$folder/proofs/there")" || failed=1
echo "written by the other, verified here: $said"
said="$(there tests/answers/swept_proofs_record verify "$folder/proofs/here")" || failed=1
echo "written here, verified by the other: $said"
exit "$failed"

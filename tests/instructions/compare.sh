#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# compare.sh FOLDER PROBE: counts with callgrind the instructions of the workloads of instruction_workload,
# which is in FOLDER of the build, and compares them with those that counts.txt records. Exit code 0:
# at most 5 % more in each; 1: more than that, or other queries; 77: cannot be compared (skipped).
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
source "$here/callgrind.sh"
folder="$1"

skip() {
  echo "skipped: $1"
  exit 77
}

require_tools "$folder" "$2" || skip "$missing"
build="$(cat "$folder/build.txt")"
recorded_build="$(sed -n 's/^# build: //p' "$here/counts.txt")"
if [[ "$build" != "$recorded_build" ]]; then
  skip "counts are recorded for '$recorded_build', this build is '$build'"
fi
count_instructions "$folder"
recorded_set="$(sed -n 's/^# instruction set: //p' "$here/counts.txt")"
if [[ "$instruction_set" != "$recorded_set" ]]; then
  skip "counts are recorded for $recorded_set, valgrind offers $instruction_set here"
fi

# Fields: name, queries, instructions per query.
awk '
  BEGIN { anew = "to record anew: tests/instructions/record.sh BUILD_FOLDER" }
  /^#/ { next }
  !($2 > 0 && $3 > 0) { print "FAILED: a count that is none: " $0 "; " anew; exit bad = 1 }
  FNR == NR { queries[$1] = $2; recorded[$1] = $3; next }
  !($1 in recorded) { print "FAILED: " $1 ": nothing is recorded; " anew; bad = 1; next }
  {
    ratio = $3 / recorded[$1]
    text = sprintf("%s: recorded %.1f, seen %.1f instructions per query, ratio %.4f", $1, recorded[$1], $3, ratio)
    if ($2 != queries[$1]) {
      print "FAILED: " $1 ": recorded " queries[$1] " queries, seen " $2 "; " anew
      bad = 1
    } else if (!(ratio <= 1.05)) {
      print "FAILED: " text ", more than 1.05; if it is worth that, " anew
      bad = 1
    } else {
      print text (ratio < 0.95 ? "; note: less than 0.95, " anew : "")
    }
    delete recorded[$1]
  }
  END {
    if (bad) exit 1
    for (name in recorded) { print "FAILED: " name ": recorded, and not seen; " anew; bad = 1 }
    exit bad
  }' "$here/counts.txt" - <<<"$counts"

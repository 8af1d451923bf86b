#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# count_results.sh FOLDER: prints `N passed, M failed, K skipped` from FOLDER/ctest.junit and the
# GoogleTest reports (FOLDER/NAME.xml) of the programs that ctest ran. A program counts by its test
# cases; one without a report, or that failed although its report has no failure (a crash after the
# last case, a timeout), counts as one.
set -euo pipefail
folder="$1"

# Lines `passed failed skipped` of one GoogleTest report.
count_cases() {
  awk '
    function close_case() {
      if (open) { if (bad) failed++; else if (skip) skipped++; else passed++ }
      open = 0
    }
    /<testcase / {
      close_case()
      open = !/ status="notrun"/
      skip = / result="skipped"/
      bad = 0
    }
    /<failure/ { bad = 1 }
    END { close_case(); print passed + 0, failed + 0, skipped + 0 }' "$1"
}

passed=0
failed=0
skipped=0
while read -r name status; do
  p=0 f=0 s=0
  if [[ -s "$folder/$name.xml" ]]; then read -r p f s < <(count_cases "$folder/$name.xml"); fi
  case "$status" in
    run) if ((p + f + s == 0)); then p=1; fi ;;
    notrun | disabled) s=$((s + 1)) ;;
    *) if ((f == 0)); then f=1; fi ;;
  esac
  passed=$((passed + p)) failed=$((failed + f)) skipped=$((skipped + s))
done < <(sed -n 's/.*<testcase name="\([^"]*\)".* status="\([^"]*\)".*/\1 \2/p' "$folder/ctest.junit")
echo "$passed passed, $failed failed, $skipped skipped"

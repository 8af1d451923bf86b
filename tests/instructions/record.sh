#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# record.sh [BUILD_FOLDER]: counts anew what counts.txt records, with the release build in BUILD_FOLDER
# (default: build/release), where the target instruction_workload is up to date.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
source "$here/callgrind.sh"
folder="$(cd "${1:-$here/../../build/release}" && pwd)/tests/instructions"
if ! require_tools "$folder" "$folder/../valgrind/valgrind_probe"; then
  echo "error: $missing" >&2
  exit 1
fi
count_instructions "$folder"
cat >"$here/counts.txt" <<END
# SPDX-License-Identifier: BSD-3-Clause
# Written by record.sh. More than 5 % above these is a failure, with this build and under a valgrind
# that offers this instruction set; other builds are not compared.
# build: $(cat "$folder/build.txt")
# instruction set: $instruction_set
# workload         queries  instructions per query
$counts
END
cat "$here/counts.txt"

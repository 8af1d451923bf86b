# SPDX-License-Identifier: BSD-3-Clause
# Sourced by compare.sh and record.sh.
source "$(dirname "${BASH_SOURCE[0]}")/../valgrind/valgrind.sh"

# What counting in FOLDER lacks is left in `missing`; true when nothing. PROBE is an empty program.
require_tools() {
  require_valgrind "$2" || return
  if [[ ! -x "$1/instruction_workload" ]]; then missing="$1/instruction_workload was not built"; fi
  [[ -z "$missing" ]]
}

# Runs all workloads of FOLDER and leaves: instruction_set, and in counts a line `NAME QUERIES
# INSTRUCTIONS_PER_QUERY` for each. Where the instructions went is in FOLDER/callgrind.out.PID, for
# callgrind_annotate; meshes are read in processes of their own, whose files say nothing.
count_instructions() {
  local output
  rm -f "$1"/callgrind.out.*
  if ! output="$(valgrind --tool=callgrind --instr-atstart=no --combine-dumps=yes \
    --callgrind-out-file="$1/callgrind.out.%p" "$1/instruction_workload" 2>&1)"; then
    echo "FAILED: $output"
    return 1
  fi
  instruction_set="$(sed -n 's/^instruction-set //p' <<<"$output")"
  counts="$(awk '
    $1 == "queries" { queries[$2] = $3; next }
    /^desc: Trigger: / { name = /Client Request: / ? $NF : "" }
    /^totals: / && $2 > 0 && queries[name] > 0 {
      printf "%-18s %7d %10.1f\n", name, queries[name], $2 / queries[name]
      delete queries[name]
    }
    END { for (name in queries) { print "FAILED: no count of " name > "/dev/stderr"; exit 1 } }
    ' - "$1"/callgrind.out.* <<<"$output")"
}

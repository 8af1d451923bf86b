# SPDX-License-Identifier: BSD-3-Clause
# Sourced by the tests that run programs under valgrind.

# True if valgrind can run PROBE, a program that does nothing; else `missing` says why. Valgrind does
# not know all instructions of all processors. Where libraries run such ones when they are loaded, no
# program gets as far as `main`, which says nothing about ours.
require_valgrind() {
  missing=""
  local output status=0
  if ! command -v valgrind >/dev/null; then
    missing="valgrind is not installed"
  elif [[ ! -x "$1" ]]; then
    missing="$1 was not built"
  else
    output="$(valgrind --tool=none "$1" 2>&1)" || status=$?
    if ((status != 0)); then
      missing="valgrind cannot run an empty program here: exit code $status"
      # The first line that says why; most of the others say who and where.
      output="$(grep -m 1 -iE 'unhandled|unrecogni|illegal|error|fatal|fail' <<<"$output")" || true
      missing+="${output:+, $output}"
    fi
  fi
  [[ -z "$missing" ]]
}

#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# unusable_test.sh COMMAND...: a test under valgrind is skipped, and says why, where valgrind cannot run
# an empty program.
set -euo pipefail
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT

# expect_skip REASON COMMAND...: with the valgrind in the folder.
expect_skip() {
  local reason="$1" status=0 output
  shift
  output="$(PATH="$folder:$PATH" "$@" 2>&1)" || status=$?
  if ((status != 77)) || [[ "$output" != "skipped: $reason" ]]; then
    echo "expected: exit code 77, 'skipped: $reason'"
    echo "seen:     exit code $status, '$output'"
    exit 1
  fi
}

cannot="valgrind cannot run an empty program here: exit code"
cat >"$folder/valgrind" <<'END'
#!/bin/sh
echo "==$$== Command: $2" >&2
echo "vex amd64->IR: unhandled instruction bytes: 0xF 0x1 0xF9" >&2
echo "==$$== Process terminating with default action of signal 4 (SIGILL)" >&2
exit 132
END
chmod +x "$folder/valgrind"
expect_skip "$cannot 132, vex amd64->IR: unhandled instruction bytes: 0xF 0x1 0xF9" "$@"

printf '#!/bin/sh\nexit 1\n' >"$folder/valgrind"
expect_skip "$cannot 1" "$@"

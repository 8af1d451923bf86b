#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds everything and runs all tests. On a fresh Debian 12 it installs what it needs first.
# The last line counts test cases: `N passed, M failed, K skipped`.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
source "$root/.ci/setup.sh"

install_packages
build_release

results="$root/build/release/test-results"
rm -rf "$results"
mkdir -p "$results"
status=0
GTEST_OUTPUT="xml:$results/" ctest --test-dir "$root/build/release" --parallel "$(nproc)" \
  --output-on-failure --no-tests=error --output-junit "$results/ctest.junit" || status=$?

"$root/tests/count_results.sh" "$results"
exit "$status"

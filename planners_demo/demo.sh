#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Plans for a 7-joint arm in a shelf, proves every motion of the path, and makes a page of it. On a
# fresh Debian 12 it installs what it needs first.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
source "$root/.ci/setup.sh"

install_packages
build_release swept

cd "$root"
swept=build/release/planners_demo/swept
problem=(--problems models/problems.json --set shelf --index 1)
mkdir -p build/demo
set -x
"$swept" plan models/robots/rook7/rook7.urdf --group arm "${problem[@]}" \
  -o build/demo/path.json --html build/demo/page.html

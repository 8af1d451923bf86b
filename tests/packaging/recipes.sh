#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
#   tests/packaging/recipes.sh [conan] [vcpkg]
# Makes the packages of Conan and vcpkg from this tree, with all that they need, and builds and runs the program of full
# with each. It takes hours and the network. Without a name: with those of the two that are installed; it says which one
# is not, and was not checked. check_conan.py and check_vcpkg.py compare the recipes with CMake's files, without either.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"

recipe_conan() {
  conan profile detect --exist-ok
  conan create "$here/conan" --build=missing -s compiler.cppstd=20
}

recipe_vcpkg() {
  local root="${VCPKG_ROOT:-${VCPKG_INSTALLATION_ROOT:-$(dirname "$(realpath "$(command -v vcpkg)")")}}" work
  work="$(mktemp -d)"
  trap 'rm -rf "$work"' EXIT
  (cd "$work" && vcpkg install swept --overlay-ports="$here/vcpkg" --x-install-root="$work/installed")
  cmake -S "$here/full" -B "$work/full" -D CMAKE_BUILD_TYPE=Release -D VCPKG_MANIFEST_MODE=OFF \
    -D VCPKG_INSTALLED_DIR="$work/installed" -D CMAKE_TOOLCHAIN_FILE="$root/scripts/buildsystems/vcpkg.cmake"
  cmake --build "$work/full"
  "$work/full/motion" "$here/../../models/robots/rook7/rook7.urdf" "$here/../../models/scenes/narrow_slot.yaml"
}

for name in "$@"; do
  if ! declare -F "recipe_$name" >/dev/null; then
    echo "error: no recipe for '$name'; there are: conan vcpkg" >&2
    exit 3
  elif ! command -v "$name" >/dev/null; then
    echo "error: $name is not installed" >&2
    exit 3
  fi
done
names=("$@")
if ((${#names[@]} == 0)); then names=(conan vcpkg); fi
for name in "${names[@]}"; do
  if command -v "$name" >/dev/null; then
    "recipe_$name"
    echo "$name: ok"
  else
    echo "$name: not checked ($name is not installed)"
  fi
done

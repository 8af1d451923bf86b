#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
#   tests/packaging/run.sh BUILD [CASE]...
# Installs a finished build into a folder, moves that elsewhere, and builds and runs programs that have nothing but
# what is there. README.md has the cases; without one, all but whole_tree.
# The build folder is only read.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
root="$(cd "$here/../.." && pwd)"
if (($# == 0)) || [[ ! -f "$1/CMakeCache.txt" ]]; then
  echo "error: usage: run.sh BUILD [CASE]..., where BUILD has a CMakeCache.txt" >&2
  exit 3
fi
build="$(cd "$1" && pwd)"
shift
source "$here/cases.sh"

cached() { sed -n "s|^$1:[A-Z]*=||p" "$build/CMakeCache.txt"; }
compiler="$(cached CMAKE_CXX_COMPILER)"
flags="$(cached CMAKE_CXX_FLAGS)"
temporary="$(mktemp -d)"
trap 'rm -rf "$temporary"' EXIT

# The rules of `cmake --install`, which writes a list of the files into the build folder besides.
cmake -D CMAKE_INSTALL_PREFIX="$temporary/first" -P "$build/planners_demo/packaging/cmake_install.cmake" \
  >"$temporary/install.log"
mkdir "$temporary/elsewhere"
mv "$temporary/first" "$temporary/elsewhere/prefix"
prefix="$temporary/elsewhere/prefix"
library_folder="$(dirname "$(find "$prefix" -name 'libswept_core.*' | head -n 1)")"
installed=()
for component in core robot_model proofs pages ompl_bridge; do
  if [[ -d "$prefix/include/swept/$component" ]]; then installed+=("$component"); fi
done
is_static=OFF
if [[ -f "$library_folder/libswept_core.a" ]]; then is_static=ON; fi

fail() {
  echo "FAILED: $*" >&2
  exit 1
}
has() { [[ " ${installed[*]} " == *" $1 "* ]]; }

# configure PROJECT [OPTION]...: a project of this folder, against the moved prefix, into $temporary/PROJECT.
configure() {
  cmake --no-warn-unused-cli -S "$here/$1" -B "$temporary/$1" -G "$(cached CMAKE_GENERATOR)" -D CMAKE_BUILD_TYPE=Release \
    -D CMAKE_CXX_COMPILER="$compiler" -D CMAKE_CXX_FLAGS="$flags" \
    -D CMAKE_PREFIX_PATH="$prefix" -D CMAKE_FIND_USE_PACKAGE_REGISTRY=OFF "${@:2}"
}

cases=("$@")
if ((${#cases[@]} == 0)); then cases=(files core requests full proofs pages pkg_config flags program manual bare_options arm_options wasm_options windows_options wheel_options ci_options tree); fi
for name in "${cases[@]}"; do
  if ! declare -F "case_$name" >/dev/null; then
    echo "error: no case '$name'; there are $(declare -F | sed -n 's/declare -f case_//p' | xargs)" >&2
    exit 3
  fi
  "case_$name"
  echo "$name: ok"
done

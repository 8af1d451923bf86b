#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the core for 64-bit Windows on a Debian 12, with MinGW, and runs its tests in Wine. Needs
# g++-mingw-w64-x86-64-posix, wine64, cmake, ninja-build, dpkg-dev and a mirror of Debian; no root, and nothing of it is
# installed: the core's dependencies are built in FOLDER from Debian's packages.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
root="$(cd "$here/../.." && pwd)"
source "$here/source_packages.sh"
triple=x86_64-w64-mingw32
sources=(libccd)
# The tests need GoogleTest, and numbers of many digits.
headers=(libeigen3-dev libhwy-dev libboost1.74-dev googletest)

usage() {
  echo "usage: tests/packaging/windows.sh FOLDER [--tests REGEX]"
  echo "FOLDER is made, or goes on with what an earlier run left in it; it takes 1 GB. The build is FOLDER/build."
  echo "--tests: only the tests that match are run; without it, all of the core that need nothing of glibc."
  echo "Packages come from \$DEBIAN_MIRROR, or from http://deb.debian.org/debian."
}

tests=
folder=
while (($# > 0)); do
  case "$1" in
    --tests)
      if (($# < 2)); then
        echo "error: --tests needs a value" >&2
        exit 3
      fi
      tests="$2" && shift 2
      ;;
    -h | --help) usage && exit 0 ;;
    -*)
      echo "error: no option '$1'; there are: --tests --help" >&2
      exit 3
      ;;
    *)
      if [[ -n "$folder" ]]; then
        echo "error: a second folder, '$1'; one is taken" >&2
        exit 3
      fi
      folder="$1" && shift
      ;;
  esac
done
if [[ -z "$folder" ]]; then
  usage >&2
  exit 3
fi
# Debian has it outside the path.
wine="$(command -v wine64 || true)"
if [[ -z "$wine" && -x /usr/lib/wine/wine64 ]]; then wine=/usr/lib/wine/wine64; fi
missing=()
if [[ -z "$wine" ]]; then missing+=(wine64); fi
for program in "$triple-g++-posix" cmake ninja apt-get dpkg-deb dpkg-source; do
  if ! command -v "$program" >/dev/null; then missing+=("$program"); fi
done
if ((${#missing[@]} > 0)); then
  echo "error: these programs are missing: ${missing[*]}" >&2
  echo "Debian 12 has them in g++-mingw-w64-x86-64-posix, wine64, cmake, ninja-build, apt, dpkg and dpkg-dev." >&2
  exit 2
fi
mkdir -p "$folder"
folder="$(cd "$folder" && pwd)"
sysroot="$folder/sysroot"
export WINEPREFIX="$folder/wine" WINEDEBUG=-all

unpack() {
  if [[ -e "$folder/source/complete" ]]; then return; fi
  rm -rf "$folder/source" "$sysroot"
  unpack_packages
  mv "$sysroot/usr/src/googletest" "$folder/source/googletest"
  touch "$folder/source/complete"
}

write_toolchain() {
  cat >"$folder/toolchain.cmake" <<END
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER $triple-gcc-posix)
set(CMAKE_CXX_COMPILER $triple-g++-posix)
set(CMAKE_FIND_ROOT_PATH "$sysroot" /usr/$triple)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
set(CMAKE_CROSSCOMPILING_EMULATOR "$wine")
END
}

library() {
  local name="$1"
  shift
  if [[ -e "$folder/libraries/$name/complete" ]]; then return; fi
  cmake -S "$folder/source/$name" -B "$folder/libraries/$name" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_TOOLCHAIN_FILE="$folder/toolchain.cmake" -DCMAKE_INSTALL_PREFIX="$sysroot/usr" -DBUILD_SHARED_LIBS=OFF "$@"
  ninja -C "$folder/libraries/$name" install
  touch "$folder/libraries/$name/complete"
}

unpack
write_toolchain
library libccd -DENABLE_DOUBLE_PRECISION=ON -DBUILD_TESTING=OFF
library googletest
cmake -S "$root" -B "$folder/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_TOOLCHAIN_FILE="$folder/toolchain.cmake" \
  -DSWEPT_WARNINGS_AS_ERRORS=ON -DSWEPT_BUILD_PROGRAM=OFF -DSWEPT_BUILD_PYTHON=OFF -DSWEPT_INSTALL=OFF
mapfile -t programs < <(ninja -C "$folder/build" -t targets all | sed -n 's/^\(core_[a-z0-9_]*_test\): phony$/\1/p')
ninja -C "$folder/build" "${programs[@]}"

# Paths in Windows begin with a drive, so reports are named from where each test runs.
results="$folder/build/tests/core/results"
rm -rf "$results"
mkdir -p "$results"
status=0
GTEST_OUTPUT="xml:results/" ctest --test-dir "$folder/build" --parallel "$(nproc)" --timeout 3600 --output-on-failure \
  --no-tests=error --output-junit "$results/ctest.junit" --tests-regex "^core_.*${tests}" || status=$?
"$root/tests/count_results.sh" "$results"
exit "$status"

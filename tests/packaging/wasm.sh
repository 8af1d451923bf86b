#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the checker for WebAssembly on a Debian 12: the module with which a page proves where its sliders are dragged
# to (SWEPT_LIVE). Needs emscripten, clang-19, lld-19, llvm-19, nodejs, cmake, ninja-build, dpkg-dev and a mirror of
# Debian; no root, and nothing of it is installed.
#
# Debian's emscripten has the standard library of LLVM 13, which lacks much of C++20. So this builds libc++ of LLVM 19
# with it, and the libraries that the checker needs, all from Debian's source packages.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
root="$(cd "$here/../.." && pwd)"
source "$here/source_packages.sh"
emscripten=/usr/share/emscripten
sources=(libccd console-bridge tinyxml tinyxml2 urdfdom urdfdom-headers yaml-cpp llvm-toolchain-19)
headers=(libeigen3-dev libhwy-dev nlohmann-json3-dev)

usage() {
  echo "usage: tests/packaging/wasm.sh FOLDER [--check SWEPT]"
  echo "FOLDER is made, or goes on with what an earlier run left in it; it takes 1 GB. The module is FOLDER/live."
  echo "--check: compares the module's answers with those of this program, for thousands of states."
  echo "Packages come from \$DEBIAN_MIRROR, or from http://deb.debian.org/debian."
}

folder=
program=
while (($# > 0)); do
  case "$1" in
    --check)
      if (($# < 2)); then
        echo "error: --check needs a value" >&2
        exit 3
      fi
      program="$2" && shift 2
      ;;
    -h | --help) usage && exit 0 ;;
    -*)
      echo "error: no option '$1'; there are: --check --help" >&2
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
if [[ -n "$program" && ! -x "$program" ]]; then
  echo "error: --check: '$program' is no program" >&2
  exit 3
fi
if [[ -n "$program" ]]; then program="$(cd "$(dirname "$program")" && pwd)/$(basename "$program")"; fi
missing=()
for name in emcc node cmake ninja python3 apt-get dpkg-deb dpkg-source xz; do
  if ! command -v "$name" >/dev/null; then missing+=("$name"); fi
done
for name in clang-19 wasm-ld-19 llvm-ar-19; do
  if ! command -v "$name" >/dev/null; then missing+=("$name"); fi
done
if ((${#missing[@]} > 0)); then
  echo "error: these programs are missing: ${missing[*]}" >&2
  echo "Debian 12 has them in emscripten, clang-19, lld-19, llvm-19, nodejs, cmake, ninja-build, python3, apt, dpkg, dpkg-dev and xz-utils." >&2
  exit 2
fi
mkdir -p "$folder"
folder="$(cd "$folder" && pwd)"
sysroot="$folder/sysroot"
llvm="$folder/source/llvm-toolchain-19"

# Emscripten with the other compiler. Node finds Debian's modules for it even if it is not Debian's node.
export EM_CONFIG="$folder/emscripten.config" NODE_PATH=/usr/share/nodejs
cat >"$EM_CONFIG" <<END
EMSCRIPTEN_ROOT = '$emscripten'
LLVM_ROOT = '/usr/lib/llvm-19/bin'
BINARYEN_ROOT = '/usr'
NODE_JS = '$(command -v node)'
CACHE = '$emscripten/cache'
FROZEN_CACHE = True
END
export EM_FROZEN_CACHE=1

unpack() {
  if [[ -e "$folder/source/complete" ]]; then return; fi
  rm -rf "$folder/source" "$sysroot"
  unpack_packages
  # Of LLVM only what its standard library is built with.
  mkdir "$llvm"
  tar -xJf llvm-toolchain-19_*.orig.tar.xz -C "$llvm" --strip-components=1 --wildcards \
    '*/libcxx/*' '*/libcxxabi/*' '*/libunwind/*' '*/libc/*' '*/runtimes/*' '*/cmake/*' '*/llvm/utils/llvm-lit/*'
  touch "$folder/source/complete"
}

standard_library() {
  if [[ -e "$sysroot/usr/lib/unwind.o" ]]; then return; fi
  local build="$folder/standard_library"
  cmake -S "$llvm/runtimes" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_TOOLCHAIN_FILE="$emscripten/cmake/Modules/Platform/Emscripten.cmake" \
    -DLLVM_ENABLE_RUNTIMES='libcxx;libcxxabi' -DLLVM_INCLUDE_TESTS=OFF \
    -DCMAKE_C_FLAGS=-fwasm-exceptions -DCMAKE_CXX_FLAGS='-fwasm-exceptions -nostdinc++ -Wno-macro-redefined' \
    -DLIBCXX_ENABLE_SHARED=OFF -DLIBCXX_ENABLE_STATIC_ABI_LIBRARY=OFF -DLIBCXX_CXX_ABI=libcxxabi \
    -DLIBCXX_HAS_MUSL_LIBC=ON -DLIBCXX_HAS_PTHREAD_API=ON -DLIBCXX_ENABLE_TIME_ZONE_DATABASE=OFF \
    -DLIBCXX_INCLUDE_BENCHMARKS=OFF -DLIBCXX_INCLUDE_TESTS=OFF \
    -DLIBCXXABI_ENABLE_SHARED=OFF -DLIBCXXABI_USE_LLVM_UNWINDER=OFF -DLIBCXXABI_ENABLE_THREADS=OFF \
    -DLIBCXXABI_INCLUDE_TESTS=OFF
  ninja -C "$build" cxx cxxabi
  mkdir -p "$sysroot/usr/include/c++" "$sysroot/usr/lib"
  cp -r "$build/include/c++/v1" "$sysroot/usr/include/c++"
  cp "$build"/lib/libc++.a "$build"/lib/libc++abi.a "$sysroot/usr/lib"
  # How exceptions of WebAssembly unwind; the rest of libunwind is for processors.
  emcc -O2 -DNDEBUG -fwasm-exceptions -fdeclspec -D_LIBUNWIND_HIDE_SYMBOLS -I "$llvm/libunwind/include" \
    -c "$llvm/libunwind/src/Unwind-wasm.c" -o "$sysroot/usr/lib/unwind.o"
}

flags="-fwasm-exceptions -msimd128"
cxx_flags="$flags -nostdinc++ -isystem $sysroot/usr/include/c++/v1 -D_LIBCPP_ENABLE_EXPERIMENTAL -Wno-macro-redefined"

write_toolchain() {
  cat >"$folder/toolchain.cmake" <<END
include($emscripten/cmake/Modules/Platform/Emscripten.cmake)
set(CMAKE_C_FLAGS_INIT "$flags")
set(CMAKE_CXX_FLAGS_INIT "$cxx_flags")
set(CMAKE_EXE_LINKER_FLAGS_INIT "-nostdlib++ -L$sysroot/usr/lib")
set(CMAKE_CXX_STANDARD_LIBRARIES "$sysroot/usr/lib/libc++.a $sysroot/usr/lib/libc++abi.a $sysroot/usr/lib/unwind.o")
set(CMAKE_HAVE_LIBC_PTHREAD ON)
list(APPEND CMAKE_FIND_ROOT_PATH "$sysroot")
END
}

library() {
  local name="$1"
  shift
  if [[ -e "$folder/libraries/$name/complete" ]]; then return; fi
  cmake -S "$folder/source/$name" -B "$folder/libraries/$name" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_TOOLCHAIN_FILE="$folder/toolchain.cmake" -DCMAKE_INSTALL_PREFIX="$sysroot/usr" \
    -DCMAKE_INSTALL_LIBDIR=lib -DBUILD_SHARED_LIBS=OFF -DBUILD_TESTING=OFF "$@"
  ninja -C "$folder/libraries/$name" install
  touch "$folder/libraries/$name/complete"
}

# It has no CMakeLists.txt.
tinyxml() {
  if [[ -e "$sysroot/usr/lib/libtinyxml.a" ]]; then return; fi
  local name objects=()
  mkdir -p "$folder/libraries/tinyxml"
  for name in tinystr tinyxml tinyxmlerror tinyxmlparser; do
    # shellcheck disable=SC2086
    em++ $cxx_flags -O2 -DNDEBUG -DTIXML_USE_STL -c "$folder/source/tinyxml/$name.cpp" -o "$folder/libraries/tinyxml/$name.o"
    objects+=("$folder/libraries/tinyxml/$name.o")
  done
  cp "$folder"/source/tinyxml/*.h "$sysroot/usr/include"
  emar rcs "$sysroot/usr/lib/libtinyxml.a" "${objects[@]}"
}

module() {
  # Highway has no doubles for WebAssembly: its loops over four numbers become vectors all the same.
  cmake -S "$root" -B "$folder/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE='-O2 -DNDEBUG' \
    -DCMAKE_TOOLCHAIN_FILE="$folder/toolchain.cmake" -DSWEPT_VECTORS=EMU128 -DSWEPT_CCACHE=OFF -DSWEPT_BUILD_TESTS=OFF \
    -DSWEPT_BUILD_PROGRAM=OFF -DSWEPT_BUILD_PYTHON=OFF -DSWEPT_INSTALL=OFF
  ninja -C "$folder/build" swept_live
  mkdir -p "$folder/live"
  cp "$folder"/build/planners_demo/live/live.js "$folder"/build/planners_demo/live/live.wasm "$folder/live"
}

unpack
standard_library
write_toolchain
library libccd -DENABLE_DOUBLE_PRECISION=ON -DLIBM_LIBRARY:STRING=-lm
library tinyxml2
library console-bridge
library urdfdom-headers
library yaml-cpp -DYAML_CPP_BUILD_TESTS=OFF -DYAML_CPP_BUILD_TOOLS=OFF -DYAML_CPP_BUILD_CONTRIB=OFF
tinyxml
library urdfdom
module
echo "the module: $folder/live ($(du -ck "$folder"/live/* | tail -1 | cut -f1) KB)"
if [[ -n "$program" ]]; then
  exec python3 -B "$here/wasm/same_verdicts.py" "$program" "$root" "$folder/live"
fi

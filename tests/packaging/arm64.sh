#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds swept for 64-bit ARM (aarch64) on a Debian 12 of another processor, and runs its tests in an
# emulator. Needs g++-aarch64-linux-gnu, qemu-user-static, cmake, ninja-build, python3, and a mirror of Debian;
# no root, and nothing of it is installed: the libraries are unpacked in FOLDER.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
root="$(cd "$here/../.." && pwd)"
architecture=arm64
triple=aarch64-linux-gnu

usage() {
  echo "usage: tests/packaging/arm64.sh FOLDER [--tests REGEX] [--each SECONDS] [--target NAME ...]"
  echo "FOLDER is made, or goes on with what an earlier run left in it; it takes 3 GB. The build is FOLDER/build."
  echo "--tests: only the tests that match are built and run. Without it, all are."
  echo "--each: one test after the other is built, and run for SECONDS at most; all run, whatever fails. FOLDER/results"
  echo "  keeps what each one wrote and what came of it. A later run leaves out what passed, unless its program changed."
  echo "--target: only this target is built, and no test runs unless --tests is given too."
  echo "CMAKE_BUILD_PARALLEL_LEVEL says how many compilers run at once. ccache is used where it is installed."
  echo "Packages come from \$DEBIAN_MIRROR, or from http://deb.debian.org/debian."
}

tests=
each=
folder=
targets=()
while (($# > 0)); do
  case "$1" in
    --tests | --each | --target)
      if (($# < 2)); then
        echo "error: $1 needs a value" >&2
        exit 3
      fi
      case "$1" in
        --tests) tests="$2" ;;
        --each)
          each="$2"
          if [[ ! "$each" =~ ^[1-9][0-9]*$ ]]; then
            echo "error: --each is '$each'; it takes seconds, a whole number from 1" >&2
            exit 3
          fi
          ;;
        --target) targets+=("$2") ;;
      esac
      shift 2
      ;;
    -h | --help) usage && exit 0 ;;
    -*)
      echo "error: no option '$1'; there are: --tests --each --target --help" >&2
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
missing=()
for program in "$triple-g++" qemu-aarch64-static cmake ninja python3 apt-get dpkg-deb; do
  if ! command -v "$program" >/dev/null; then missing+=("$program"); fi
done
if ((${#missing[@]} > 0)); then
  echo "error: these programs are missing: ${missing[*]}" >&2
  echo "Debian 12 has them in g++-aarch64-linux-gnu, qemu-user-static, cmake, ninja-build, python3, apt and dpkg." >&2
  exit 2
fi
mkdir -p "$folder"
folder="$(cd "$folder" && pwd)"
sysroot="$folder/sysroot"
export QEMU_LD_PREFIX="$sysroot"

# The libraries of .ci/apt-packages.txt, and what they depend on; those for Python and MPI would need programs
# of the other processor while building.
libraries() {
  sed -e 's/#.*//' -e '/^[[:space:]]*$/d' "$root/.ci/apt-packages.txt" | grep -e '-dev$' -e '^libjs-' |
    grep -v -e '^libopenmpi' -e '^python3' -e '^pybind11'
  echo libc6-dev libstdc++-12-dev
}

# An apt of its own: of the other architecture, with nothing installed.
other_apt() {
  apt-get -q -o APT::Architecture="$architecture" -o APT::Architectures="$architecture" \
    -o Dir::State="$folder/apt" -o Dir::State::status="$folder/apt/status" \
    -o Dir::Cache="$folder/apt/cache" -o Dir::Etc::sourceparts="$folder/apt/none" \
    -o Dir::Etc::sourcelist="$folder/apt/sources.list" -o Debug::NoLocking=true "$@"
}

unpack_libraries() {
  if [[ -e "$sysroot/complete" ]]; then return; fi
  rm -rf "$sysroot"
  mkdir -p "$folder/apt/lists/partial" "$folder/apt/cache/archives/partial" "$folder/apt/none" "$sysroot"
  : >"$folder/apt/status"
  echo "deb ${DEBIAN_MIRROR:-http://deb.debian.org/debian} bookworm main" >"$folder/apt/sources.list"
  local names
  mapfile -t names < <(libraries | tr ' ' '\n')
  if ! other_apt update || ! other_apt install --download-only --yes --no-install-recommends "${names[@]}"; then
    echo "error: the packages of $architecture cannot be had; DEBIAN_MIRROR names another mirror" >&2
    exit 2
  fi
  local package link
  for package in "$folder"/apt/cache/archives/*.deb; do dpkg-deb -x "$package" "$sysroot"; done
  # Links and CMake files name /usr of the system that the packages are for.
  find "$sysroot" -type l -lname '/*' | while read -r link; do
    ln -sfnr "$sysroot$(readlink "$link")" "$link"
  done
  grep -rlE '[" ;(:]/usr' "$sysroot/usr/lib/$triple" "$sysroot/usr/share" --include='*.cmake' |
    xargs sed -i -E "s#([\" ;(:])/usr([/\"])#\1$sysroot/usr\2#g"
  touch "$sysroot/complete"
}

configure() {
  cat >"$folder/toolchain.cmake" <<END
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER $triple-gcc)
set(CMAKE_CXX_COMPILER $triple-g++)
set(CMAKE_LIBRARY_ARCHITECTURE $triple)
set(CMAKE_SYSROOT "$sysroot")
set(CMAKE_FIND_ROOT_PATH "$sysroot")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(CMAKE_CROSSCOMPILING_EMULATOR "$(command -v qemu-aarch64-static);-L;$sysroot")
END
  cmake -S "$root" -B "$folder/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DSWEPT_WARNINGS_AS_ERRORS=ON \
    -DSWEPT_BUILD_PYTHON=OFF -DCMAKE_DISABLE_FIND_PACKAGE_MPI=ON -DCMAKE_TOOLCHAIN_FILE="$folder/toolchain.cmake"
}

# Of the tests that match: `emulated NAME FILE` of a program that the emulator runs, or `other NAME`. The others
# are scripts, which run on this system, and would start programs of the other one without the emulator.
list_tests() {
  ctest --test-dir "$folder/build" --show-only=json-v1 --tests-regex "${tests:-.}" |
    python3 -c '
import json, os, sys
build = sys.argv[1]
for test in json.load(sys.stdin)["tests"]:
    command = test.get("command", [""])
    if os.path.basename(command[0]) == "qemu-aarch64-static":
        print("emulated", test["name"], os.path.relpath(command[3], build))
    else:
        print("other", test["name"])' "$folder/build"
}

# emulating COMMAND...: runs it where the kernel itself starts the emulator for programs of the other processor, so that
# tests can start some. Linux 6.7 and newer let a namespace of users have that for itself; on others, COMMAND runs
# without, and such tests fail.
emulating() {
  # An executable file of 64 bits for ARM: as in qemu-user-static's own list.
  local magic='\x7fELF\x02\x01\x01\x00\x00\x00\x00\x00\x00\x00\x00\x00\x02\x00\xb7\x00'
  local mask='\xff\xff\xff\xff\xff\xff\xff\x00\xff\xff\xff\xff\xff\xff\xff\xff\xfe\xff\xff\xff'
  local handler=":swept:M::$magic:$mask:$(command -v qemu-aarch64-static):F"
  local register='mount -t binfmt_misc swept /proc/sys/fs/binfmt_misc && printf %s "$1" >/proc/sys/fs/binfmt_misc/register'
  local own=(unshare --user --map-root-user --mount bash -c)
  if ! "${own[@]}" "$register" _ "$handler" 2>/dev/null; then
    echo "this kernel gives no emulator to programs that tests start: tests of the program fail"
    "$@"
    return
  fi
  "${own[@]}" "$register"' && shift && exec "$@"' _ "$handler" "$@"
}

# Lines `passed failed skipped` of the cases that GoogleTest says are done in a test's output.
count_cases() {
  awk '/^[0-9]+: \[       OK \] / { passed++ }
    /^[0-9]+: \[  FAILED  \] .* ms\)$/ { failed++ }
    /^[0-9]+: \[  SKIPPED \] .* ms\)$/ { skipped++ }
    END { print passed + 0, failed + 0, skipped + 0 }' "$1"
}

# run_one NAME FILE: NAME.txt has what the test wrote, and NAME.result its outcome and how many cases passed, failed and
# were skipped. Programs are linked statically, so one that did not change is older than what came of it.
run_one() {
  local result="$folder/results/$1.result" log="$folder/results/$1.txt" outcome=passed
  if ! build_targets "$2" >"$log" 2>&1; then
    outcome="does not compile"
  elif [[ "$result" -nt "$folder/build/$2" ]] && grep -q '^passed ' "$result"; then
    return
  elif ! emulating ctest --test-dir "$folder/build" --verbose --timeout "$each" --tests-regex "^$1\$" >"$log" 2>&1; then
    outcome=failed
    if grep -q '\*\*\*Timeout' "$log"; then outcome=stopped; fi
  fi
  echo "$outcome $(count_cases "$log")" >"$result"
  echo "$1: $(cat "$result")"
}

build_targets() { cmake --build "$folder/build" --target "$@"; }

unpack_libraries
configure
if ((${#targets[@]} > 0)); then build_targets "${targets[@]}"; fi
if ((${#targets[@]} > 0)) && [[ -z "$tests" ]]; then exit 0; fi
list_tests >"$folder/tests.txt"
mapfile -t programs < <(awk '$1 == "emulated" { print $3 }' "$folder/tests.txt" | sort -u)
others="$(awk '$1 == "other" { print $2 }' "$folder/tests.txt" | paste -sd '|')"
if ((${#programs[@]} == 0)); then
  echo "error: no test that the emulator can run matches '$tests'" >&2
  exit 3
fi
if [[ -n "$others" ]]; then echo "left out, as scripts on this system: ${others//|/ }"; fi
if [[ -n "$each" ]]; then
  mkdir -p "$folder/results"
  bad=0
  while read -r name file; do
    run_one "$name" "$file" </dev/null
    if ! grep -q '^passed ' "$folder/results/$name.result"; then bad=$((bad + 1)); fi
  done < <(awk '$1 == "emulated" { print $2, $3 }' "$folder/tests.txt")
  echo "tests that did not pass: $bad; $folder/results has what each one wrote"
  exit $((bad > 0))
fi
build_targets "${programs[@]}"
emulating ctest --test-dir "$folder/build" --parallel "$(nproc)" --timeout 3600 --output-on-failure --no-tests=error \
  --tests-regex "${tests:-.}" --exclude-regex "^(${others:-none})\$"

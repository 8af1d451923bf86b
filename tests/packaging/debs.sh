#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
#   tests/packaging/debs.sh [BUILD]
# Builds the .deb packages in BUILD (build/deb, which is configured first), looks at what is in them, builds and runs
# the core's program against the core's packages alone, unpacked, and runs an example in Python. Needs dpkg-dev and file;
# lintian judges the packages where it is installed.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
root="$(cd "$here/../.." && pwd)"
build="${1:-$root/build/deb}"
for tool in dpkg-deb dpkg-shlibdeps file; do
  if ! command -v "$tool" >/dev/null; then
    echo "error: no $tool; install dpkg-dev and file first" >&2
    exit 3
  fi
done
temporary="$(mktemp -d)"
trap 'rm -rf "$temporary"' EXIT

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

(cd "$root" && cmake --preset deb -B "$build" &&
  cmake --build "$build" --parallel 2 && cd "$build" && cpack -B "$temporary/debs")
debs="$temporary/debs"

# expect_depends PACKAGE PATTERN [FORBIDDEN]: of its Depends.
expect_depends() {
  local depends
  depends="$(dpkg-deb -f "$debs/$1"_*.deb Depends)"
  grep -qE "$2" <<<"$depends" || fail "$1 does not depend on '$2': $depends"
  if [[ -n "${3:-}" ]] && grep -E "$3" <<<"$depends"; then fail "$1 depends on '$3'"; fi
}
# expect_file PACKAGE PATTERN
expect_file() {
  local content
  content="$(dpkg-deb -c "$debs/$1"_*.deb)"
  grep -qE "$2" <<<"$content" || fail "$1 has no '$2': $content"
}

ls "$debs"/*.deb
heavy='ompl|assimp|urdfdom|yaml|tinyxml|tbb|nlohmann|boost'
expect_depends libswept-core0.1 '(^|, )libccd2 ' "hwy|$heavy"
expect_depends libswept-core-dev 'libswept-core0.1 \(= .*libeigen3-dev|libeigen3-dev.*libswept-core0.1 \(=' "$heavy"
expect_depends libswept-robot-model0.1 'libassimp5' ompl
expect_depends libswept-robot-model0.1 'libswept-core0.1'
expect_depends libswept-robot-model-dev 'libswept-core-dev' ompl
expect_depends libswept-proofs0.1 'libswept-robot-model0.1' ompl
expect_depends libswept-proofs-dev 'libswept-robot-model-dev' ompl
expect_depends libswept-pages0.1 'libswept-robot-model0.1' ompl
expect_depends libswept-pages-dev 'libswept-robot-model-dev' ompl
expect_depends libswept-ompl-bridge0.1 'libompl16'
expect_depends libswept-ompl-bridge-dev 'libompl-dev'
expect_depends swept 'libswept-ompl-bridge0.1' 'dev'
expect_depends python3-swept 'python3-numpy'
expect_depends python3-swept 'libswept-ompl-bridge0.1' 'dev'
expect_file python3-swept 'lib/python3/dist-packages/swept/_swept\.cpython.*\.so'
expect_file python3-swept 'lib/python3/dist-packages/swept/py\.typed'
expect_file libswept-core0.1 'libswept_core\.so\.0\.1 -> libswept_core\.so\.0\.1\.'
expect_file libswept-core-dev 'libswept_core\.so -> libswept_core\.so\.0\.1'
expect_file libswept-core-dev 'cmake/swept/sweptConfig\.cmake'
expect_file libswept-core-dev 'pkgconfig/swept-core\.pc'
expect_file libswept-core-dev 'include/swept/core/shapes\.hpp'
expect_file swept 'usr/bin/swept$'
expect_file swept 'share/man/man1/swept\.1\.gz$'
expect_file swept-mpi 'share/man/man1/swept-mpi\.1\.gz$'
for deb in "$debs"/*.deb; do
  mkdir "$temporary/one"
  dpkg-deb -x "$deb" "$temporary/one"
  for file in copyright changelog.gz; do
    compgen -G "$temporary/one/usr/share/doc/*/$file" >/dev/null || fail "no $file in $deb"
  done
  # `dpkg -r` keeps what has a script to run when it is purged.
  if dpkg-deb --ctrl-tarfile "$deb" | tar -t | grep -E 'post(inst|rm)'; then fail "$deb has these scripts"; fi
  if grep -rlF -e "$root" -e "$build" "$temporary/one"; then fail "these files of $deb name a folder of the build"; fi
  rm -r "$temporary/one"
done

# The core's program, with the core's packages alone.
for package in libswept-core0.1 libswept-core-dev; do dpkg-deb -x "$debs/$package"_*.deb "$temporary/root"; done
cmake -G Ninja -S "$here/core" -B "$temporary/core" -D CMAKE_BUILD_TYPE=Release -D CMAKE_PREFIX_PATH="$temporary/root/usr"
cmake --build "$temporary/core"
"$temporary/core/distance" || fail "the core's answers are wrong"

# An example in Python, with the libraries of the packages.
for package in libswept-{core,robot-model,proofs,pages,ompl-bridge}0.1 python3-swept; do
  dpkg-deb -x "$debs/$package"_*.deb "$temporary/python"
done
libraries="$(dirname "$(compgen -G "$temporary/python/usr/lib/*/libswept_core.so.0.1")")"
python="$temporary/python/usr/lib/python3/dist-packages"
LD_LIBRARY_PATH="$libraries" PYTHONPATH="$python" /usr/bin/python3 -B "$root/planners_demo/examples/python/04_batch.py" \
  "$root/models" || fail "python3-swept has wrong answers"
LD_LIBRARY_PATH="$libraries" ldd "$python"/swept/_swept.*.so | grep -F "$libraries/libswept_ompl_bridge" >/dev/null ||
  fail "python3-swept has another library than the packages have"

# README.md says what is left out, and why.
if command -v lintian >/dev/null; then
  lintian --allow-root --fail-on error,warning "$debs"/*.deb \
    --suppress-tags malformed-contact,bogus-mail-host-in-debian-changelog ||
    fail "lintian is not content"
else
  echo "lintian: left out (it is not installed)"
fi
echo "debs: ok"

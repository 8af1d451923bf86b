#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
#   tests/packaging/wheel.sh FOLDER [PYTHON]...
# Builds a wheel of the package `swept` for each PYTHON (/usr/bin/python3), with the shared libraries that it needs beside
# the module, and runs an example with it in an environment that has nothing else but numpy. FOLDER/wheels has the wheels;
# they are published nowhere. Each PYTHON needs numpy, pip, setuptools and wheel; patchelf and unzip are needed, too.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
root="$(cd "$here/../.." && pwd)"
if (($# < 1)) || [[ "$1" == -* ]]; then
  echo "error: usage: wheel.sh FOLDER [PYTHON]..." >&2
  exit 3
fi
for tool in patchelf unzip ldd cmake; do
  if ! command -v "$tool" >/dev/null; then
    echo "error: no $tool; install it first" >&2
    exit 3
  fi
done
mkdir -p "$1"
folder="$(cd "$1" && pwd)"
shift
pythons=("$@")
if ((${#pythons[@]} == 0)); then pythons=(/usr/bin/python3); fi

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

# What each system with this C library has, as the manylinux policies say, and Python itself.
system='^(linux-vdso|ld-linux.*|libc|libm|libdl|librt|libpthread|libstdc\+\+|libgcc_s|libpython.*)\.so'

# Copies the libraries that the module in a folder of an unpacked wheel needs to swept.libs beside it, and has module and
# libraries look there: bundle FOLDER.
bundle() {
  local module libraries="$1/swept.libs" name path
  module="$(compgen -G "$1/swept/_swept.*.so")"
  mkdir -p "$libraries"
  while read -r name _ path _; do
    if [[ "$name" =~ $system ]]; then continue; fi
    [[ -f "$path" ]] || fail "no library $name for $module"
    cp -L "$path" "$libraries/$name"
    chmod u+w "$libraries/$name"
  done < <(ldd "$module" | grep '=>')
  for path in "$libraries"/*; do patchelf --force-rpath --set-rpath '$ORIGIN' "$path"; done
  patchelf --force-rpath --set-rpath '$ORIGIN/../swept.libs' "$module"
}

# Whether the module in a folder gets all libraries from there: expect_bundled FOLDER.
expect_bundled() {
  local module name path
  module="$(compgen -G "$1/swept/_swept.*.so")"
  while read -r name _ path _; do
    if [[ "$name" =~ $system ]]; then continue; fi
    [[ "$(realpath "$path")" == "$(realpath "$1")"/swept.libs/* ]] || fail "$name is taken from $path"
  done < <(ldd "$module" | grep '=>')
}

rm -rf "$folder/wheels"
mkdir -p "$folder/wheels"
for python in "${pythons[@]}"; do
  work="$folder/$("$python" -c 'import sys; print("cp%d%d" % sys.version_info[:2])')"
  rm -rf "$work"
  mkdir -p "$work/made" "$work/unpacked"
  "$python" -m pip wheel --no-build-isolation --no-deps --no-index -w "$work/made" "$root/ompl_bridge/python"
  "$python" -m wheel unpack -d "$work/unpacked" "$work"/made/swept-*.whl
  bundle "$(compgen -G "$work/unpacked/swept-*")"
  "$python" -m wheel pack -d "$folder/wheels" "$work"/unpacked/swept-*
  wheel="$folder/wheels/$(basename "$work"/made/swept-*.whl)"
  unzip -l "$wheel" | grep -q 'swept/py\.typed' || fail "$wheel has no py.typed"
  "$python" -m venv --system-site-packages "$work/environment"
  "$work/environment/bin/python" -m pip install --no-index --no-deps --force-reinstall "$wheel"
  expect_bundled "$("$work/environment/bin/python" -c 'import pathlib, swept; print(pathlib.Path(swept.__file__).parents[1])')"
  (cd / && env -u PYTHONPATH "$work/environment/bin/python" -B "$root/planners_demo/examples/python/04_batch.py" "$root/models") ||
    fail "$wheel has wrong answers"
  echo "$(basename "$wheel"): $(stat -c %s "$wheel") bytes"
done
echo "wheels: ok"

# SPDX-License-Identifier: BSD-3-Clause
# Sourced by scripts that build for another system from Debian's packages. Needs: folder. Nothing is installed.

# An apt of its own, which knows source packages.
own_apt() {
  apt-get -q -o Dir::State="$folder/apt" -o Dir::State::status=/var/lib/dpkg/status \
    -o Dir::Cache="$folder/apt/cache" -o Dir::Etc::sourceparts="$folder/apt/none" \
    -o Dir::Etc::sourcelist="$folder/apt/sources.list" -o Debug::NoLocking=true "$@"
}

# Fetches what `sources` lists as source packages, and `headers` as packages whose files are those of any system, to
# FOLDER/source. Unpacks the headers in `sysroot`, and all sources but those of LLVM.
unpack_packages() {
  mkdir -p "$folder/apt/lists/partial" "$folder/apt/cache/archives/partial" "$folder/apt/none" "$folder/source" "$sysroot"
  local mirror="${DEBIAN_MIRROR:-http://deb.debian.org/debian}" name
  printf '%s %s bookworm main\n' deb "$mirror" deb-src "$mirror" >"$folder/apt/sources.list"
  cd "$folder/source"
  if ! own_apt update || ! own_apt source --download-only "${sources[@]}" || ! own_apt download "${headers[@]}"; then
    echo "error: the packages cannot be had; DEBIAN_MIRROR names another mirror" >&2
    exit 2
  fi
  for name in "${headers[@]}"; do dpkg-deb -x "$name"_*.deb "$sysroot"; done
  for name in "${sources[@]}"; do
    if [[ "$name" != llvm-* ]]; then dpkg-source --no-check -x "$name"_*.dsc "$name"; fi
  done
  # Highway's headers alone are used; its library is that of this processor.
  rm -rf "$sysroot"/usr/lib
  mkdir -p "$sysroot/usr/lib/cmake/hwy"
  cat >"$sysroot/usr/lib/cmake/hwy/hwy-config.cmake" <<END
add_library(hwy::hwy INTERFACE IMPORTED)
set_target_properties(hwy::hwy PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "$sysroot/usr/include")
END
}

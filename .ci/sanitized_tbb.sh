# SPDX-License-Identifier: BSD-3-Clause
# Sourced by .ci/nightly.

# Builds oneTBB with ThreadSanitizer, from the sources of the system's package: build_sanitized_tbb FOLDER. It is installed
# in FOLDER/installed. The system's own lists of packages are not touched.
build_sanitized_tbb() {
  local folder="$1" codename
  codename="$(. /etc/os-release && echo "${VERSION_CODENAME:-}")"
  if [[ "$(. /etc/os-release && echo "$ID")" != debian || -z "$codename" ]]; then
    echo "error: oneTBB with ThreadSanitizer is built from Debian's sources; this system is no Debian" >&2
    return 1
  fi
  rm -rf "$folder"
  mkdir -p "$folder"/{lists/partial,cache/archives/partial,package,source}
  echo "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg]" \
    "${DEBIAN_MIRROR:-http://deb.debian.org/debian} $codename main" >"$folder/sources.list"
  local options=(-q -o Dir::Etc::sourcelist="$folder/sources.list" -o Dir::Etc::sourceparts=/dev/null
    -o Dir::State::lists="$folder/lists" -o Dir::Cache="$folder/cache")
  apt-get "${options[@]}" update
  (cd "$folder/package" && apt-get "${options[@]}" --download-only source onetbb)
  tar -xf "$folder/package/"*.orig.tar.* -C "$folder/source" --strip-components=1
  cmake -S "$folder/source" -B "$folder/build" -G Ninja -D CMAKE_BUILD_TYPE=RelWithDebInfo \
    -D CMAKE_INSTALL_PREFIX="$folder/installed" -D CMAKE_INSTALL_LIBDIR=lib \
    -D TBB_SANITIZE=thread -D TBB_TEST=OFF -D TBBMALLOC_BUILD=OFF -D TBB_STRICT=OFF
  cmake --build "$folder/build" --parallel "$(nproc)"
  cmake --install "$folder/build"
}

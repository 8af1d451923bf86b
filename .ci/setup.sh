# SPDX-License-Identifier: BSD-3-Clause
# Sourced by the scripts that build. Needs: root, the top folder of the tree.

# Packages of a list, one a line: packages_of FILE.
packages_of() { sed -e 's/[[:space:]]*#.*//' -e '/^[[:space:]]*$/d' "$1"; }

# Packages of a list that are not installed, but for those that .ci/not-on-SYSTEM.txt names, where there is such a file:
# missing_packages FILE [SYSTEM], which is this system's ID without one.
missing_packages() {
  local package system absent=""
  system="${2:-$(. /etc/os-release && echo "${ID:-}")}"
  if [[ -f "$root/.ci/not-on-$system.txt" ]]; then absent="$(packages_of "$root/.ci/not-on-$system.txt")"; fi
  while read -r package; do
    if grep -qxF "$package" <<<"$absent"; then continue; fi
    if [[ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" != installed ]]; then
      echo "$package"
    fi
  done < <(packages_of "$1")
}

# Installs what is missing of a list, of .ci/apt-packages.txt without one, as root or with sudo; asks
# for neither when nothing is: install_packages [FILE].
install_packages() {
  local list="${1:-$root/.ci/apt-packages.txt}"
  if ! command -v dpkg-query >/dev/null; then
    echo "not a Debian system: taking the packages of ${list#"$root/"} for installed" >&2
    return
  fi
  local missing
  mapfile -t missing < <(missing_packages "$list")
  if ((${#missing[@]} == 0)); then return; fi
  local as_root=()
  if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
      echo "error: not root and no sudo; install these packages first: ${missing[*]}" >&2
      return 1
    fi
    as_root=(sudo)
  fi
  if ! command -v apt-get >/dev/null; then
    echo "error: no apt-get; install these packages first: ${missing[*]}" >&2
    return 1
  fi
  echo "installing: ${missing[*]}"
  "${as_root[@]}" apt-get update -q
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -q -y --no-install-recommends "${missing[@]}"
}

# Configures the release preset and builds the targets given, or everything.
build_release() {
  local targets=()
  if (($# > 0)); then targets=(--target "$@"); fi
  (cd "$root" && cmake --preset release &&
    cmake --build --preset release --parallel "$(nproc)" "${targets[@]}")
}

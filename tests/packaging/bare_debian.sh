#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# What the README promises of a bare Debian, done in one: a clean clone of HEAD, its two commands,
# installing, programs against what is installed; the .deb packages, each in a Debian of its own.
# Needs root, debootstrap and git. Prints a line for each step, and a table at the end. Exit code 1: a
# step failed, whose log is in FOLDER/logs.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
root="$(cd "$here/../.." && pwd)"
source "$here/bare_steps.sh"
# Suites of Debian, and their releases.
suites=(bookworm trixie)
declare -A releases=([bookworm]=12 [trixie]=13)

usage() {
  echo "usage: tests/packaging/bare_debian.sh FOLDER [--suite SUITE] [--keep] [--only STEP ...]"
  echo "SUITE is one of: ${suites[*]}; without it, that of an earlier run in FOLDER, or bookworm."
  echo "Steps: ${steps[*]}"
  echo "FOLDER is made, and removed at the end unless --keep is given or a step failed; it takes more than 7 GB."
  echo "--only takes the FOLDER that an earlier run with --keep left, and keeps it too; the steps that"
  echo "were done before are in the table with their times."
  echo "Packages come from \$DEBIAN_MIRROR, or else from where this system's own do."
}

# Of this system's own packages if it is a Debian, or nothing: debootstrap has a default.
system_mirror() {
  if command -v apt-get >/dev/null; then
    apt-get indextargets --format '$(REPO_URI)' 'Origin: Debian' \
      "Codename: $(. /etc/os-release && echo "${VERSION_CODENAME:-}")" \
      'Component: main' 'Created-By: Packages' | head -n 1
  fi
}

# inside SYSTEM COMMAND...: as root in one of the systems in FOLDER, with an environment of its own. What it
# mounts and starts ends with it, however it ends: it has namespaces of its own, where it is not process 1,
# which nothing kills by mistake. In `hidden`: a folder that is empty to it.
inside() {
  local system="$folder/$1" proxy=() name
  for name in http_proxy https_proxy no_proxy; do
    if [[ -n "${!name:-}" ]]; then proxy+=("$name=${!name}"); fi
  done
  unshare --mount --propagation private --pid --fork --kill-child bash -euo pipefail -c '
    mount -t proc proc "$1/proc"
    mount -t sysfs -o ro sysfs "$1/sys"
    mount -t devpts -o newinstance,ptmxmode=0666 devpts "$1/dev/pts"
    mount -t tmpfs shm "$1/dev/shm"
    if [[ -n "$2" ]]; then mount -t tmpfs hidden "$1$2"; fi
    chroot "$1" "${@:3}" || exit $?' inside "$system" "${hidden:-}" \
    env -i HOME=/root TERM=dumb PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
    DEBIAN_FRONTEND=noninteractive "${proxy[@]}" "${@:2}"
}

logged() { (set -euo pipefail && "step_$1") >"$2" 2>&1; }

# do_step STEP: runs it, and notes its times in FOLDER/times.
do_step() {
  local step="$1" log="$folder/logs/$1.log" status=0
  local TIMEFORMAT='%0R %0U %0S'
  # Not behind a condition, where a failing command would not end it.
  set +e
  { time logged "$step" "$log"; } 2>"$folder/logs/$step.time"
  status=$?
  set -e
  local wall user system
  read -r wall user system <"$folder/logs/$step.time"
  if ((status != 0)); then
    tail -n 40 "$log"
    echo "error: $step failed after $wall s; what it printed is in $log" >&2
    failed=yes
    exit 1
  fi
  sed -i "/^$step /d" "$folder/times"
  echo "$step $wall $((user + system))" >>"$folder/times"
  printf '%-10s %6d s, of processors %6d s; %s\n' "$step" "$wall" "$((user + system))" "$(step_says "$step")"
}

# The steps that were done, in their order.
print_table() {
  local step
  echo
  echo "| step | s | s of processors | |"
  echo "|---|---|---|---|"
  for step in "${steps[@]}"; do
    if ! grep -q "^$step " "$folder/times"; then continue; fi
    awk -v step="$step" -v says="$(step_says "$step")" \
      '$1 == step { printf "| `%s` | %d | %d | %s |\n", step, $2, $3, says }' "$folder/times"
  done
  echo
  echo "$(nproc) processors ($(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo | head -n 1))."
}

clean_up() {
  # Nothing is mounted there; if something were, it would not be emptied.
  if [[ -z "$keep" && -z "$failed" ]]; then rm -rf --one-file-system "$folder"; fi
}

keep=
suite=
only=()
folder=
while (($# > 0)); do
  case "$1" in
    --keep) keep=yes && shift ;;
    --suite)
      if (($# < 2)); then
        echo "error: --suite needs a value, one of: ${suites[*]}" >&2
        exit 3
      fi
      if [[ " ${suites[*]} " != *" $2 "* ]]; then
        echo "error: no suite '$2'; there are: ${suites[*]}" >&2
        exit 3
      fi
      suite="$2" && shift 2
      ;;
    --only)
      shift
      while (($# > 0)) && [[ "$1" != --* ]]; do
        if [[ " ${steps[*]} " != *" $1 "* ]]; then
          echo "error: no step '$1'; there are: ${steps[*]}" >&2
          exit 3
        fi
        only+=("$1") && shift
      done
      if ((${#only[@]} == 0)); then
        echo "error: --only names no step; there are: ${steps[*]}" >&2
        exit 3
      fi
      keep=yes
      ;;
    -h | --help) usage && exit 0 ;;
    -*)
      echo "error: no option '$1'; there are: --suite --keep --only --help" >&2
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
earlier="$(cat "$folder/suite" 2>/dev/null || true)"
suite="${suite:-${earlier:-bookworm}}"
if [[ -n "$earlier" && "$suite" != "$earlier" ]]; then
  echo "error: $folder is of the suite '$earlier', not '$suite'" >&2
  exit 3
fi
if ((EUID != 0)); then
  echo "error: not root, whom chroot and debootstrap need" >&2
  exit 3
fi
for tool in debootstrap git unshare; do
  if ! command -v "$tool" >/dev/null; then
    echo "error: no $tool; install it first" >&2
    exit 3
  fi
done
if ((${#only[@]} == 0)) && [[ -e "$folder" ]]; then
  echo "error: $folder is there already; name a new folder, or steps with --only" >&2
  exit 3
fi
mkdir -p "$folder/logs"
folder="$(cd "$folder" && pwd)"
touch "$folder/times"
echo "$suite" >"$folder/suite"
mirror="${DEBIAN_MIRROR:-$(system_mirror)}"
failed=
trap clean_up EXIT

wanted=("${only[@]}")
if ((${#wanted[@]} == 0)); then wanted=("${steps[@]}"); fi
for step in "${wanted[@]}"; do do_step "$step"; done
print_table

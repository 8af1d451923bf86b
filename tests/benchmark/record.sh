#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# record.sh [--machine MACHINE] [--build FOLDER] [NAME ...]: runs what runs.txt has under these names, all of it without
# one, one after the other, and writes what each prints, below a head that says where and how, to results/MACHINE/NAME.md.
# MACHINE: what the processor is called, if not given. FOLDER: a build with -DSWEPT_BUILD_BENCHMARKS=ON (build/release).
# Without SWEPT_DATA, commands that name its files are skipped, and the programs say what they leave out.
# Exit code 1 when a program fails, whose results then stay as they were; 2: usage.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
root="$(cd "$here/../.." && pwd)"
cd "$root"

fail() {
  echo "record.sh: $1" >&2
  exit 2
}

value_of() { sed -n "s/^$1[[:space:]]*[:=][[:space:]]*\"\{0,1\}\([^\"]*\)\"\{0,1\}$/\1/p" "$2" | head -1; }

processor="$(value_of 'model name' /proc/cpuinfo)"
processor="${processor:-$(uname -m)}"
machine="$(sed -e 's/([^)]*)//g' -e 's/[^A-Za-z0-9]\{1,\}/-/g' -e 's/-$//' <<<"$processor" | tr '[:upper:]' '[:lower:]')"
build=build/release
names=()
while (($#)); do
  case "$1" in
    --machine | --build)
      [[ -n "${2:-}" ]] || fail "$1 needs a value"
      printf -v "${1#--}" %s "$2"
      shift
      ;;
    -*) fail "unknown option '$1'; known: --machine MACHINE, --build FOLDER" ;;
    *) names+=("$1") ;;
  esac
  shift
done
[[ "$machine" =~ ^[A-Za-z0-9][A-Za-z0-9._-]*$ ]] || fail "--machine '$machine': letters, digits, '.', '_' and '-' only"

known="$(sed -n 's/^\([a-z_0-9]*\): .*/\1/p' "$here/runs.txt")"
((${#names[@]})) || mapfile -t names <<<"$known"
for name in "${names[@]}"; do
  grep -Fqx -- "$name" <<<"$known" || fail "unknown name '$name'; in runs.txt: $(paste -sd ' ' <<<"$known")"
done
grep -q '^SWEPT_BUILD_BENCHMARKS:BOOL=ON$' "$build/CMakeCache.txt" 2>/dev/null ||
  fail "--build '$build': no build with -DSWEPT_BUILD_BENCHMARKS=ON"
build="$(cd "$build" && pwd)"

command_of() { sed -n "s/^$1: //p" "$here/runs.txt"; }

mapfile -t programs < <(for name in "${names[@]}"; do command_of "$name" | cut -d' ' -f1; done | sort -u)
cmake --build "$build" --target "${programs[@]}" >&2
PATH="$build/tests/benchmark:$build/planners_demo:$PATH"

# What results depend on: the newest commit of these is named.
measured=(CMakeLists.txt core robot_model ompl_bridge planners_demo/src 'tests/benchmark/*.[ch]pp' ':!*.md')

load_average() { cut -d' ' -f1-3 /proc/loadavg; }

# What was measured and on what, as a list; the load before the run is the argument.
head_of() {
  local compiler versions="" peer version changed=""
  compiler="$("$(value_of CMAKE_CXX_COMPILER:[A-Z]* "$build/CMakeCache.txt")" --version | head -1)"
  for peer in fcl ode bullet ompl octomap; do
    version="$(pkg-config --modversion "$peer" 2>/dev/null)" && versions+=", $peer $version"
  done
  [[ -z "$(git status --porcelain -- "${measured[@]}" || echo unknown)" ]] || changed=" and changes not committed"
  echo "* sources of commit $(git log -1 --format=%h --abbrev=10 -- "${measured[@]}")$changed; $(date -u +%Y-%m-%d)"
  echo "* $processor, $(nproc) cores; load average (1, 5, 15 minutes) before $1, after $(load_average)"
  echo "* $(value_of PRETTY_NAME /etc/os-release), $compiler, $(value_of CMAKE_BUILD_TYPE:STRING "$build/CMakeCache.txt")"
  echo "* installed: ${versions#, }; SWEPT_DATA $([[ -n "${SWEPT_DATA:-}" ]] || echo "not ")set"
}

record() {
  local name="$1" result="tests/benchmark/results/$machine/$1" command load
  local output="$scratch/output" made="$scratch/made/$1"
  command="$(command_of "$name")"
  load="$(load_average)"
  mkdir -p "${result%/*}" "${made%/*}"
  if [[ "$command" == *DATA* && -z "${SWEPT_DATA:-}" ]]; then
    echo "skipped: SWEPT_DATA is not set" >"$output"
  else
    local words
    read -ra words <<<"$command"
    words=("${words[@]//RESULT/"$made"}")
    # In quotes of its own: a `&` would stand for DATA.
    "${words[@]//DATA/"${SWEPT_DATA:-}"}" >"$output" || return
    # Only now: what a program that fails has written is no result.
    find "${made%/*}" -type f -exec mv -t "${result%/*}" {} + && sed -i "s|$made|$result|g" "$output" || return
  fi
  {
    printf '# %s\n\n    %s\n\n' "$name" "${command//RESULT/$result}"
    head_of "$load"
    printf '\n## Output\n\n'
    # What is no Markdown: `swept` prints text.
    if grep -q '^|' "$output"; then
      sed '/./,$!d' "$output"
    else
      printf '~~~text\n%s\n~~~\n' "$(<"$output")"
    fi
  } >"$result.md"
}

scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT
failed=0
for name in "${names[@]}"; do
  rm -rf "$scratch/made"
  begin=$SECONDS
  if record "$name"; then
    echo "$name: $((SECONDS - begin)) s"
  else
    echo "$name: FAILED, nothing written" >&2
    failed=1
  fi
done
exit $failed

#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Fuzzes each target from its corpus, as many at once as there are processors, and prints a line for
# each: seconds of processor, inputs run, edges covered, inputs kept because they cover more, finds.
# Exit code 1: there are finds, which are in build/fuzz/finds.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
build="$root/build/fuzz"
source "$root/.ci/setup.sh"

usage() {
  echo "usage: tests/fuzz/run.sh [--seconds N] [--record] [TARGET ...]"
  echo "Targets: $(targets | tr '\n' ' ')"
  echo "Without targets: all of them. Seconds: of each target, 60 without."
  echo "--record adds what was run to tests/fuzz/results.md."
}

targets() {
  (cd "$root/tests/fuzz" && ls -- *_fuzz.cpp | sed 's/_fuzz\.cpp$//')
}

# What libFuzzer says of the run: fuzz_one TARGET.
fuzz_one() {
  local target="$1" log="$build/logs/$1.log"
  local found="$build/found/$target" finds="$build/finds/$target"
  local words=()
  if [[ -f "$root/tests/fuzz/dictionaries/$target.dict" ]]; then
    words=("-dict=$root/tests/fuzz/dictionaries/$target.dict")
  fi
  mkdir -p "$build/logs" "$found" "$finds"
  local before
  before="$(find "$finds" -type f | wc -l)"
  local TIMEFORMAT='%U %S' busy
  # Reading a mesh waits for a process: up to its limit of wall time.
  busy="$({ time "$build/tests/fuzz/${target}_fuzz" -max_total_time="$seconds" -timeout=60 \
    -report_slow_units=60 -rss_limit_mb=4096 -print_final_stats=1 -artifact_prefix="$finds/" \
    "${words[@]}" "$found" "$root/tests/fuzz/corpus/$target" >"$log" 2>&1 || true; } 2>&1)"
  awk -v target="$target" -v finds="$(($(find "$finds" -type f | wc -l) - before))" -v busy="$busy" '
    / cov: / { for (i = 1; i < NF; i++) if ($i == "cov:") cover = $(i + 1) }
    /^stat::number_of_executed_units/ { runs = $2 }
    /^stat::new_units_added/ { kept = $2 }
    END {
      if (runs == "") { print target ": did not end as it should, see its log"; exit }
      split(busy, second, " ")
      printf "%-14s %5d s, %10d inputs, %5d edges, %5d kept, %d finds\n", target, second[1] + second[2],
        runs, cover, kept, finds
    }' "$log"
}

# Adds the runs in build/fuzz/summary.txt to the table, in which each target has a row.
record() {
  local table="$root/tests/fuzz/results.md"
  touch "$table"
  {
    echo "# Results"
    echo
    echo "Written by \`run.sh --record\`: of all runs together, but for edges, of which there are the most of one run."
    echo "Seconds are of processor."
    echo
    echo "| target | s | inputs | edges | finds |"
    echo "|---|---|---|---|---|"
    awk '
      /^\| `/ { gsub("`", "", $2); s[$2] = $4; runs[$2] = $6; edges[$2] = $8; finds[$2] = $10; next }
      / inputs, / { s[$1] += $2; runs[$1] += $4; finds[$1] += $10; if ($6 + 0 > edges[$1] + 0) edges[$1] = $6 }
      END { for (t in s) printf "| `%s` | %d | %d | %d | %d |\n", t, s[t], runs[t], edges[t], finds[t] }
    ' "$table" "$build/summary.txt" | sort
  } >"$build/results.md"
  cp "$build/results.md" "$table"
}

seconds=60
recorded=
wanted=()
while (($# > 0)); do
  case "$1" in
    --seconds)
      seconds="${2:-}"
      if ! [[ "$seconds" =~ ^[1-9][0-9]*$ ]]; then
        echo "error: --seconds is '$seconds'; it must be a whole number from 1" >&2
        exit 2
      fi
      shift 2
      ;;
    --record)
      recorded=yes
      shift
      ;;
    -h | --help) usage && exit 0 ;;
    *)
      if ! targets | grep -qx -- "$1"; then
        echo "error: no target '$1'; there are: $(targets | tr '\n' ' ')" >&2
        exit 2
      fi
      wanted+=("$1")
      shift
      ;;
  esac
done
if ((${#wanted[@]} == 0)); then mapfile -t wanted < <(targets); fi

install_packages
install_packages "$root/.ci/fuzz-packages.txt"
(cd "$root" && cmake --preset fuzz >/dev/null &&
  cmake --build --preset fuzz --parallel "$(nproc)" --target "${wanted[@]/%/_fuzz}" >/dev/null)
export -f fuzz_one
export root build seconds
printf '%s\n' "${wanted[@]}" | xargs -P "$(nproc)" -I{} bash -euo pipefail -c 'fuzz_one {}' |
  tee "$build/summary.txt"
if [[ -n "$recorded" ]]; then record; fi
if grep -qv ' 0 finds$' "$build/summary.txt"; then
  for target in $(grep -v ' 0 finds$' "$build/summary.txt" | sed 's/[ :].*//'); do
    tail -n 40 "$build/logs/$target.log"
  done
  echo "error: finds are in $build/finds, what was printed in $build/logs" >&2
  exit 1
fi

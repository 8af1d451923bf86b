# SPDX-License-Identifier: BSD-3-Clause
"""Results of a campaign: one JSON object a line, as they come; the last one of a mutation counts."""

import json
import pathlib

WANTED_SHARE = 0.95
CAUGHT = ("caught", "does not end")


def read_results(path):
    """By name of the mutation. A line that an interruption cut off is left out."""
    results = {}
    if not pathlib.Path(path).is_file():
        return results
    for line in pathlib.Path(path).read_text().splitlines():
        try:
            result = json.loads(line)
        except json.JSONDecodeError:
            continue
        results[result["mutation"]] = result
    return results


def append_result(path, result):
    with pathlib.Path(path).open("a") as file:
        file.write(json.dumps(result) + "\n")


def result_of(mutation, results):
    """None: not run, or run as it was before it changed."""
    result = results.get(mutation.name)
    return result if result and result["digest"] == mutation.digest() else None


def words(result):
    if result is None:
        return "not run"
    if result["outcome"] == "caught":
        return f"caught by `{result['by']}`"
    if result["outcome"] == "does not end":
        return f"caught: `{result['by']}` does not end"
    return f"**{result['outcome']}**"


def score(mutations, results):
    """Caught, of how many that were run."""
    run = [r for m in mutations if (r := result_of(m, results))]
    return sum(r["outcome"] in CAUGHT for r in run), len(run)


def verdict(mutations, results):
    caught, run = score(mutations, results)
    share = 100.0 * caught / run if run else 0.0
    return f"{share:.1f} % of {run} mutations caught, {len(mutations) - run} not run."


def table(mutations, results):
    lines = ["# Results", "", "Written by `mutate.py` from `results.jsonl`.", "",
             "| mutation | file | what it breaks | result |", "|---|---|---|---|"]
    for m in mutations:
        lines.append(f"| `{m.name}` | `{m.file}` | {m.why} | {words(result_of(m, results))} |")
    lines += ["", "| component | caught | of |", "|---|---|---|"]
    for component in sorted({m.component for m in mutations}):
        caught, run = score([m for m in mutations if m.component == component], results)
        lines.append(f"| {component} | {caught} | {run} |")
    caught, run = score(mutations, results)
    return "\n".join([*lines, f"| all | {caught} | {run} |", "", verdict(mutations, results), ""])


def succeeded(mutations, results):
    caught, run = score(mutations, results)
    broken = any(r["outcome"] == "does not compile" for m in mutations if (r := result_of(m, results)))
    return run == len(mutations) and not broken and caught >= WANTED_SHARE * run

"""Checks the workflows of the code host: each is YAML, and what it names within itself exists.

The host itself reads them only when a tag or a commit has been pushed, which is late to learn of a slip.
"""

import re
import sys
from pathlib import Path

import yaml


def flaws(text):
    """What is wrong with a workflow."""
    workflow = yaml.safe_load(text)
    # YAML 1.1 reads the key `on` as true.
    if not (workflow.get("on") or workflow.get(True)):
        yield "it says not when it runs"
    jobs = workflow.get("jobs") or {}
    if not jobs:
        yield "it has no jobs"
    for name, job in jobs.items():
        if "runs-on" not in job:
            yield f"job {name}: no runs-on"
        needs = job.get("needs", [])
        for other in [needs] if isinstance(needs, str) else needs:
            if other not in jobs:
                yield f"job {name} needs the job {other}, which is missing"
        steps = job.get("steps") or []
        if not steps:
            yield f"job {name}: no steps"
        for number, step in enumerate(steps, 1):
            if ("uses" in step) == ("run" in step):
                yield f"job {name}, step {number}: either `uses` or `run`"
            if "uses" in step and not re.fullmatch(r"[\w.-]+/[\w./-]+@[\w.-]+", step["uses"]):
                yield f"job {name}, step {number}: `uses` names no version of an action"
        rows = job.get("strategy", {}).get("matrix", {}).get("include", [])
        for key in set(re.findall(r"matrix\.(\w+)", str(job))):
            if not rows or any(key not in row for row in rows):
                yield f"job {name}: a row of the matrix has no {key}"


found = 0
for path in sys.argv[1:]:
    try:
        wrong = list(flaws(Path(path).read_text(encoding="utf-8")))
    except yaml.YAMLError as error:
        wrong = [str(error)]
    for flaw in wrong:
        print(f"{path}: {flaw}")
    found += len(wrong)
print(f"{len(sys.argv) - 1} workflows, {found} flaws")
sys.exit(found > 0)

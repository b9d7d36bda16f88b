"""Monte Carlo campaigns: sample uncertain inputs, run and summarise, on one machine or on many.

`grouser.Campaign` describes a campaign, `run` computes it into a folder or under a URL of fsspec,
`results` reads its results, `merge` joins the parts of an array of jobs.

The document of a campaign determines its shards. A worker gets the study as a text and the number
of a shard, and returns the bytes of a Parquet file. The bytes depend on these two alone, so that
the digest over all shards is the same for one thread, a pool of processes, Dask, Ray and an array
of jobs, for any order of the shards, and also if workers died. A worker needs only this package, in
the same version.

``python -m grouser.campaign run STUDY --out DIR --executor dask --scheduler ADDRESS`` is the same
from a shell.

Examples
--------
>>> import tempfile
>>> import grouser as gr
>>> study = gr.Campaign(
...     study="wheel-test",
...     runs=200,
...     wheel_test={"soil": "toyoura", "wheel": "hakuto", "load_n": 17.0, "slip_ratio": 0.2},
...     parameter=[{"key": "load_n", "distribution": "normal", "standard_deviation": 1.0}],
... )
>>> with tempfile.TemporaryDirectory() as folder:
...     found = gr.campaign.run(study, out=folder)
...     summary = found.summarise()
>>> summary.status["ok"].count
200
"""

from ._progress import Progress
from ._results import Results, merge, results
from ._run import run
from ._study import Campaign
from ._summary import Quantity, Share, Summary

__all__ = [
    "Campaign",
    "Progress",
    "Quantity",
    "Results",
    "Share",
    "Summary",
    "merge",
    "results",
    "run",
]

# One canonical path for each name, in messages and in documentation; that of `Campaign` is
# `grouser.Campaign`.
for _thing in (Progress, Quantity, Results, Share, Summary, merge, results, run):
    _thing.__module__ = __name__
del _thing

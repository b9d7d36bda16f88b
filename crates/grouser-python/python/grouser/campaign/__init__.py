"""Campaigns: many runs over what is not known exactly, on one machine or on many.

`grouser.Campaign` describes one, `run` computes it into a folder or under a URL of fsspec, `results`
reads what is there, `merge` brings the parts of an array of jobs together.

A campaign is split into shards, by its document alone; a worker gets the study as a text and a
shard's number, and gives back the bytes of a Parquet file. These depend on the two and on nothing
else, so that the digest over all shards is the same for one thread, a pool of processes, Dask, Ray
and an array of jobs, in whatever order the shards came, and however often workers died meanwhile.
A worker needs this package, in the same version, and nothing else.

``python -m grouser.campaign run STUDY --out DIR --executor dask --scheduler ADDRESS`` is the same from
a shell.

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

"""The description of a campaign."""

from __future__ import annotations

from typing import Any

from .. import _core
from .._descriptions import _Description
from .._errors import ParameterError


class Campaign(_Description):
    """Description of a Monte Carlo campaign: many runs of one study with sampled inputs. Keys:
    ``study``, ``runs``, ``seed``, ``shard_runs``, ``sampling``, ``sensitivity``, ``scenario``,
    ``mission`` or ``wheel_test``, and the uncertain inputs: ``parameter``, ``correlation``,
    ``samples``, ``soil_uncertainty``. The guide on campaigns explains them. Sources and errors are
    those of `Soil`.

    The complete document (``to_toml``) contains samples and all documents that it names: a worker
    needs only that text.

    Examples
    --------
    How uncertain is the heading offset, if the friction angle is known to 1.5°?

    >>> import grouser as gr
    >>> study = gr.Campaign(
    ...     study="heading",
    ...     runs=32,
    ...     scenario="traverse-10-deg",
    ...     parameter=[
    ...         {
    ...             "key": "soil.friction_angle_deg",
    ...             "distribution": "normal",
    ...             "standard_deviation": 1.5,
    ...         }
    ...     ],
    ... )
    >>> study.row_count, study.inputs, "yaw_deg" in study.outputs
    (32, ('soil.friction_angle_deg',), True)
    >>> study.rerun(0)["status"]                                    # one run, without a folder
    'ok'
    """

    __slots__ = ("_facts",)
    _kind = "campaign"
    _facts: dict[str, Any]

    def _take(self, document: _core.Document) -> None:
        super()._take(document)
        object.__setattr__(self, "_facts", _core.campaign_facts(document))

    @classmethod
    def _of_document(cls, document: _core.Document) -> Campaign:
        """The description of a document that was read."""
        made = cls.__new__(cls)
        made._take(document)
        return made

    @property
    def row_count(self) -> int:
        """Number of runs: ``runs`` or, with ``sensitivity``, ``runs`` times the number of inputs
        plus two."""
        count: int = self._facts["runs"]
        return count

    @property
    def shard_count(self) -> int:
        """Number of shards, which the document determines."""
        count: int = self._facts["shards"]
        return count

    @property
    def sha256(self) -> str:
        """SHA-256 of the complete document: it identifies the campaign."""
        name: str = self._facts["sha256"]
        return name

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns, in order."""
        return tuple(name for name, *_ in self._facts["columns"])

    @property
    def inputs(self) -> tuple[str, ...]:
        """The columns of sampled inputs."""
        return self._of_role("input")

    @property
    def outputs(self) -> tuple[str, ...]:
        """The columns of results."""
        return self._of_role("result")

    @property
    def units(self) -> dict[str, str | None]:
        """The unit of each column; None for ratios and texts."""
        return {name: unit for name, _, _, unit in self._facts["columns"]}

    def _of_role(self, wanted: str) -> tuple[str, ...]:
        return tuple(name for name, _, role, _ in self._facts["columns"] if role == wanted)

    def runs_of(self, shard: int) -> range:
        """The runs of a shard; empty beyond the last shard.

        Parameters
        ----------
        shard : int
            The shard's number, from 0.
        """
        length: int = self._items["shard_runs"]
        start = min(shard * length, self.row_count)
        return range(start, min(start + length, self.row_count))

    def shard(self, shard: int, *, threads: int = 0) -> bytes:
        """Computes a shard.

        Parameters
        ----------
        shard : int
            Its number, from 0.
        threads : int
            Number of threads; 0 for one on each core. The bytes do not depend on it.

        Returns
        -------
        bytes
            A Parquet file.

        Raises
        ------
        ParameterError
            If the shard does not exist.
        """
        return _core.campaign_shard(
            self._document, _whole("shard", shard), _whole("threads", threads)
        )

    def rerun(self, run: int) -> dict[str, Any]:
        """Computes a single run: its row by column, None where there is no value.

        Parameters
        ----------
        run : int
            The run's number, from 0.

        Raises
        ------
        ParameterError
            If the run does not exist.
        """
        return _core.campaign_row(self._document, _whole("run", run))


def _whole(name: str, value: int) -> int:
    """A number that is not negative."""
    if not 0 <= value < 2**63:
        raise ParameterError(
            f"{name} is {value}, it must not be negative", name, value, "0 or more"
        )
    return value

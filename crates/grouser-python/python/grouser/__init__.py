"""Predicts how a wheeled rover moves on loose soil.

Descriptions say what there is (`Soil`, `Wheel`, `Rover`, `Site`, `Scenario`); `settle` and
`wheel_forces` ask what the soil does to wheels, on whole arrays; studies ask what a rover does
(`simulate`, `rollout`, `attitude`, `attitude_map`) and what a test stand shows
(`wheel_test`, `validate`, `calibrate`). A `Simulator` leads a rover step by step; ``grouser.gym``,
imported by itself, has environments for Gymnasium.
A `Campaign` puts what is not known exactly through a study, on one machine or on many
(`grouser.campaign`).

Units stand in names: ``load_n``, ``sinkage_mm``, ``slope_deg``. Frames and signs are those of the
project's dictionary, ``docs/conventions.md``: slopes rise along +y, yaw is positive where the nose
points uphill, slip angles and side forces are positive to the left.

Examples
--------
>>> import grouser as gr
>>> wheel = gr.settle("toyoura", "hakuto", load_n=17.0, slip_ratio=[0.1, 0.2, 0.4])
>>> wheel.sinkage_mm.shape
(3,)
>>> run = gr.simulate(slope_deg=10.0)
>>> run.outcome
'completed'
"""

from . import campaign
from ._core import EARTH_GRAVITY, MARS_GRAVITY, MOON_GRAVITY, __version__
from ._attitude_band import AttitudeBand
from ._attitudes import AttitudeMap, Attitudes, attitude, attitude_map
from ._calibration import Calibration, calibrate, calibrate_plates
from ._descriptions import Rover, Scenario, Site, Soil, Wheel
from ._errors import (
    CalibrationError,
    CampaignDiskError,
    CampaignError,
    CampaignLockedError,
    CampaignNotFoundError,
    DocumentError,
    DocumentNotFoundError,
    DocumentUnreadableError,
    GrouserError,
    ParameterError,
    SimulationError,
)
from ._rollouts import Rollout, rollout
from ._simulator import Simulator, SimulatorBatch
from ._studies import Trajectory, simulate
from ._validation import Ranking, Validation, validate, validate_all
from ._wheel_test import SimulatedWheelTest, WheelTest, wheel_test
from ._wheels import Settled, WheelForces, settle, wheel_forces
from .campaign import Campaign

__all__ = [
    "EARTH_GRAVITY",
    "MARS_GRAVITY",
    "MOON_GRAVITY",
    "AttitudeBand",
    "AttitudeMap",
    "Attitudes",
    "Calibration",
    "CalibrationError",
    "Campaign",
    "CampaignDiskError",
    "CampaignError",
    "CampaignLockedError",
    "CampaignNotFoundError",
    "DocumentError",
    "DocumentNotFoundError",
    "DocumentUnreadableError",
    "GrouserError",
    "ParameterError",
    "Ranking",
    "Rollout",
    "Rover",
    "Scenario",
    "Settled",
    "SimulatedWheelTest",
    "SimulationError",
    "Simulator",
    "SimulatorBatch",
    "Site",
    "Soil",
    "Trajectory",
    "Validation",
    "Wheel",
    "WheelForces",
    "WheelTest",
    "__version__",
    "attitude",
    "attitude_map",
    "calibrate",
    "calibrate_plates",
    "campaign",
    "rollout",
    "settle",
    "simulate",
    "validate",
    "validate_all",
    "wheel_forces",
    "wheel_test",
]

# One canonical path for each name, in messages and in documentation.
for _name in __all__:
    _thing = globals()[_name]
    if hasattr(_thing, "__module__"):
        _thing.__module__ = __name__
del _name, _thing

"""Predicts how a wheeled rover moves on loose soil.

`Soil`, `Wheel`, `Rover`, `Site`, `Scenario`, `Mission` and `Design` describe the inputs, `Terrain` is a map
of heights to drive on. `settle` and
`wheel_forces` compute the forces of the soil on wheels, for whole arrays. `simulate`,
`rollout`, `heading`, `heading_map` and `wheel_speeds` compute the motion of a rover, `mission`
drives it through legs with limits at which it stops, `wheel_test` simulates a wheel on a test
stand, and `validate` and `calibrate` compare models with measurements, which
`import_wheel_tests` converts. `map` says where on a `Terrain` a rover can go,
`route` which way over it is the cheapest. `SlipEstimator` reads slip from motor currents,
`Learner` learns the soil from the telemetry of a drive. `card` is the operator's card, `design` finds the best numbers of a rover, `forecast` predicts under another
gravity, and `check` checks documents. `Run` and ``grouser.gym``, which is imported by itself,
are for step-by-step control. `serve` opens the console, a page to try things on. `Campaign` and `grouser.campaign` are for Monte Carlo campaigns,
on one machine or on many.

Names end with units: ``load_n``, ``sinkage_mm``, ``slope_deg``. Frames and signs are defined in
``docs/conventions.md``: slopes rise along +y, yaw is positive where the nose
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

from typing import TYPE_CHECKING as _TYPE_CHECKING

from . import campaign, style
from ._core import EARTH_GRAVITY, MARS_GRAVITY, MOON_GRAVITY, __version__
from ._animations import Animation
from ._calibration import Calibration, calibrate, calibrate_plates, calibrate_shear
from ._descriptions import Design, Mission, Rover, Scenario, Site, Soil, Wheel
from ._errors import present_name as _present_name
from ._errors import refusing_vary as _refusing_vary
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
    InternalError,
    OutsideDomainError,
    ParameterError,
    SimulationError,
)
from ._card import Card, CardCourses, card
from ._check import Checked, check
from ._console import Console, serve
from ._designs import BestDesign, design
from ._forecast import Forecast, forecast
from ._gradients import Gradient
from ._heading_band import HeadingBand, HeadingMapBand
from ._headings import HeadingMap, Headings, heading, heading_map
from ._learning import Learner, learn
from ._maps import map
from ._measurements import ImportedWheelTests, import_wheel_tests
from ._missions import Alternatives, DrivenMission, Legs, mission
from ._outcomes import OUTCOMES
from ._replay import replay
from ._rollouts import Rollout, rollout
from ._routes import route
from ._models import MODELS, ByModel
from ._linear import LinearStep
from ._runs import Run, RunBatch, RunState
from ._slip_from_current import SlipEstimator
from ._studies import Trajectory, TraverseBand, simulate
from ._sweeps import Sweep
from ._telemetry import ImportedTelemetry, import_telemetry
from ._terrain import Terrain
from ._validation import (
    DriveValidation,
    Ranking,
    SlopeValidation,
    Validation,
    validate,
    validate_all,
    validate_drives,
    validate_slopes,
)
from ._validity import FLAGS, require_inside
from ._wheel_speeds import WheelSpeedLimits, WheelSpeeds, wheel_speeds
from ._wheel_test import SimulatedWheelTest, WheelTest, WheelTestBand, wheel_test
from ._wheels import Settled, WheelForces, range_of, settle, wheel_forces
from .campaign import Campaign

__all__ = [
    "DriveValidation",
    "EARTH_GRAVITY",
    "MARS_GRAVITY",
    "MODELS",
    "MOON_GRAVITY",
    "Alternatives",
    "Animation",
    "BestDesign",
    "ByModel",
    "Calibration",
    "CalibrationError",
    "Campaign",
    "CampaignDiskError",
    "CampaignError",
    "CampaignLockedError",
    "CampaignNotFoundError",
    "Card",
    "CardCourses",
    "Checked",
    "Console",
    "Design",
    "DocumentError",
    "DocumentNotFoundError",
    "DocumentUnreadableError",
    "DrivenMission",
    "FLAGS",
    "Forecast",
    "GrouserError",
    "Gradient",
    "HeadingBand",
    "HeadingMap",
    "HeadingMapBand",
    "Headings",
    "ImportedTelemetry",
    "ImportedWheelTests",
    "InternalError",
    "Learner",
    "Legs",
    "LinearStep",
    "Mission",
    "OUTCOMES",
    "OutsideDomainError",
    "ParameterError",
    "Ranking",
    "Rollout",
    "Rover",
    "Run",
    "RunBatch",
    "RunState",
    "Scenario",
    "Settled",
    "SimulatedWheelTest",
    "SimulationError",
    "Site",
    "SlipEstimator",
    "Soil",
    "Sweep",
    "Terrain",
    "Trajectory",
    "TraverseBand",
    "Validation",
    "Wheel",
    "WheelForces",
    "WheelSpeedLimits",
    "WheelSpeeds",
    "WheelTest",
    "WheelTestBand",
    "__version__",
    "calibrate",
    "calibrate_plates",
    "calibrate_shear",
    "campaign",
    "card",
    "check",
    "design",
    "forecast",
    "heading",
    "heading_map",
    "import_telemetry",
    "import_wheel_tests",
    "learn",
    "map",
    "mission",
    "range_of",
    "replay",
    "require_inside",
    "rollout",
    "route",
    "serve",
    "settle",
    "simulate",
    "style",
    "validate",
    "validate_all",
    "validate_drives",
    "validate_slopes",
    "wheel_forces",
    "wheel_speeds",
    "wheel_test",
]

# Calls whose keywords make no description refuse `vary` here, others where that is read.
for _name in ("calibrate", "calibrate_plates", "calibrate_shear", "validate"):
    globals()[_name] = _refusing_vary(globals()[_name])

# One canonical path for each name, in messages and in documentation.
for _name in __all__:
    _thing = globals()[_name]
    if hasattr(_thing, "__module__"):
        _thing.__module__ = __name__
del _name, _thing

# Type checkers see the present names only, and so find misspelt ones.
if not _TYPE_CHECKING:

    def __getattr__(name: str) -> object:
        """Refuses a name, with the present one where it is withdrawn."""
        meant = _present_name(name, __all__)
        raise AttributeError(f"module 'grouser' has no attribute {name!r}{meant}")

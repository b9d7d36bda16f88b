"""Forces of the soil on the wheels of MuJoCo models.

`SoilContact` applies the forces of the soil to the wheels of a model, in place of MuJoCo's own
contact. `rover_xml` writes a model of a `grouser.Rover`. Needs MuJoCo: ``pip install
mujoco``.
"""

try:
    import mujoco as _mujoco  # noqa: F401
except ImportError as _missing:
    raise ImportError(
        "grouser.mujoco needs MuJoCo: pip install mujoco", name=_missing.name
    ) from _missing

from ._contact import SoilContact
from ._rover import rover_xml

__all__ = ["SoilContact", "rover_xml"]

# One canonical path for each name.
SoilContact.__module__ = rover_xml.__module__ = __name__

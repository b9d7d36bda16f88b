"""The wheels of wheel.c by Python's ctypes. (The package `grouser` has more: use it if you can.)

python3 wheel.py ../../../target/release/libgrouser_c.so
"""

import ctypes
import sys

Doubles = ctypes.POINTER(ctypes.c_double)


class WheelTest(ctypes.Structure):
    _fields_ = [("id", ctypes.c_uint64)]


class Reaction(ctypes.Structure):
    _fields_ = [
        (name, ctypes.c_double)
        for name in (
            "sinkage_m drawbar_pull_n side_force_n normal_force_n torque_nm overturning_moment_nm "
            "aligning_moment_nm thrust_n motion_resistance_n side_force_from_shear_n "
            "bulldozing_load_n max_normal_stress_pa entry_angle_rad exit_angle_rad "
            "max_stress_angle_rad"
        ).split()
    ]


class Settled(ctypes.Structure):
    _fields_ = [
        ("carried", ctypes.c_int),
        ("capacity_n", ctypes.c_double),
        ("reaction", Reaction),
    ]


library = ctypes.CDLL(sys.argv[1])
library.grouser_last_error.restype = ctypes.c_char_p
library.grouser_settle.argtypes = [WheelTest, ctypes.c_size_t, *[Doubles] * 3, ctypes.c_void_p]
library.grouser_forces.argtypes = library.grouser_settle.argtypes


def check(status):
    if status != 0:
        raise RuntimeError(library.grouser_last_error().decode())


COUNT = 4
Numbers = ctypes.c_double * COUNT
load_n = Numbers(*[17.0] * COUNT)
slip_ratio = Numbers(0.0, 0.1, 0.2, 0.4)
slip_angle_rad = Numbers(0.0, 0.0, 0.1, 0.1)
sinkage_m = Numbers(*[0.01] * COUNT)
settled = (Settled * COUNT)()
forces = (Reaction * COUNT)()
test = WheelTest()

check(
    library.grouser_wheel_test_new(
        b"toyoura", b"hakuto", None, b"soil.cohesion_kpa=0.1", ctypes.byref(test)
    )
)
check(library.grouser_settle(test, COUNT, load_n, slip_ratio, slip_angle_rad, settled))
check(library.grouser_forces(test, COUNT, sinkage_m, slip_ratio, slip_angle_rad, forces))
for one, at_sinkage in zip(settled, forces):
    print("sinkage_m", repr(one.reaction.sinkage_m))
    print("drawbar_pull_n", repr(one.reaction.drawbar_pull_n))
    print("side_force_n", repr(one.reaction.side_force_n))
    print("drawbar_pull_n", repr(at_sinkage.drawbar_pull_n))
check(library.grouser_wheel_test_free(test))

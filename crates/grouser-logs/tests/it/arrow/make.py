"""Writes the files of this folder, by pyarrow: a drive of five rows in all types that are read."""

from pathlib import Path

import pyarrow
from pyarrow import feather, ipc

FOLDER = Path(__file__).parent
TIMES = [0, 100, 200, 300, 400]
TABLE = pyarrow.table(
    {
        "time_s": pyarrow.array(TIMES, pyarrow.timestamp("ms")),
        "roll_deg": pyarrow.array([1.5, None, 2.5, float("nan"), 0.1]),
        "pitch_deg": pyarrow.array([0, -1, 2, -3, 4], pyarrow.int8()),
        "wheel_speed_rad_s_front-left": pyarrow.array([0.5] * 5, pyarrow.float32()),
        "vo_dx_m": pyarrow.array(["0.01", "0.02", None, "0.03", "0.04"]),
        "remark, not used": pyarrow.array(["a,b", '"', "", None, "# c"]),
        "scans": pyarrow.array([[1, 2], [], None, [3], [4]]),
        "place": pyarrow.array([{"x": 1.0, "y": "one"}] * 5),
        "kind": pyarrow.array(["one", "two", "one", "one", "two"]).dictionary_encode(),
        "yaw_deg": pyarrow.array([10.0, 11.0, 12.0, 13.0, 14.0], pyarrow.float16()),
    }
)

for compression in ("uncompressed", "lz4", "zstd"):
    feather.write_feather(TABLE, FOLDER / f"{compression}.feather", compression, chunksize=2)
with ipc.new_stream(FOLDER / "stream.arrows", TABLE.schema) as writer:
    writer.write_table(TABLE, max_chunksize=3)

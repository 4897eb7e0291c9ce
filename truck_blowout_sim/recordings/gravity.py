"""What a recording says of gravity in its accelerations, and how much of it a leaning body feels.

The line `accelerometers: gravity removed` of the metadata speaks of all units,
`tractor_accelerometers` and `trailer_accelerometers` of one. Without such a line accelerations are
specific force: they contain gravity.

Validated with: test/recordings/test_gravity.py.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.recordings.recording import Recording

FloatArray = NDArray[np.float64]
ACCELERATIONS: Final = ("ax_mps2", "ay_mps2", "az_mps2")
AT_REST_MPS2: Final = 9.81  # what a vertical accelerometer reads at rest, on shipped roads too
_REMOVED = "gravity removed"
_INCLUDED = "strapdown: gravity included"


def gravity_is_removed(recording: Recording, unit: str) -> bool:
    """Whether the accelerations of a unit are said to be free of gravity."""
    said = recording.metadata
    return _REMOVED in said.get(f"{unit}_accelerometers", said.get("accelerometers", "")).lower()


def with_gravity_stated(recording: Recording, unit: str, *, removed: bool) -> Recording:
    """The recording, saying of one unit's accelerations that they are free of gravity or not."""
    return recording.with_metadata(
        **{f"{unit}_accelerometers": _REMOVED if removed else _INCLUDED})


def gravity_felt(stem: str, roll_rad: FloatArray, pitch_rad: FloatArray) -> FloatArray:
    """Gravity in an acceleration [m/s^2] of a body that leans.

    The vertical seen from a body rolled by phi and pitched by theta (intrinsic z-y-x, nose down
    positive) is (-sin theta, sin phi cos theta, cos phi cos theta).

    Args:
        stem: of the channel's name, one of :data:`ACCELERATIONS`.
    """
    vertical = {
        "ax_mps2": -np.sin(pitch_rad),
        "ay_mps2": np.sin(roll_rad) * np.cos(pitch_rad),
        "az_mps2": np.cos(roll_rad) * np.cos(pitch_rad),
    }[stem]
    return np.asarray(AT_REST_MPS2 * vertical)

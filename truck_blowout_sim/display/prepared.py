"""A message of fixed layout, serialised once and refilled with numbers.

References: OMG CDR, as `recordings/cdr.py` takes it apart.
Known limits: texts and lengths of sequences stay as they were prepared.
Validated with: test/display/test_scene.py, against `rosbags`' own reading.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from truck_blowout_sim.recordings.cdr import walk
from truck_blowout_sim.recordings.message_types import typestore


class Prepared:
    """Refills one message.

    Args:
        ros_type: message type.
        message: it, as `rosbags` builds messages.
        fields: paths of float64 fields that `fill` sets, in its order.
    """

    def __init__(self, ros_type: str, message: object, fields: Sequence[str]) -> None:
        self.ros_type = ros_type
        data = bytes(typestore().serialize_cdr(message, ros_type))
        self._numbers = walk(data, ros_type).numbers
        self._bytes = np.frombuffer(data, dtype=np.uint8).copy()
        starts = np.array([self._numbers[path][0] for path in fields], dtype=np.intp)
        self._at = starts[:, None] + np.arange(8)
        stamps = [at for path, (at, _) in self._numbers.items() if path.endswith("stamp.sec")]
        self._stamps = np.array(stamps, dtype=np.intp)[:, None] + np.arange(8)

    def fill(self, stamp_ns: int, values: ArrayLike) -> bytes:
        """The message with all its stamps and `fields` set."""
        stamp = np.array(divmod(stamp_ns, 1_000_000_000), dtype="<u4").view(np.uint8)
        self._bytes[self._stamps] = stamp
        numbers: NDArray[np.float64] = np.ascontiguousarray(values, dtype="<f8")
        self._bytes[self._at] = numbers.view(np.uint8).reshape(-1, 8)
        return self._bytes.tobytes()

    def put(self, path: str, value: float) -> None:
        """Set one number of any kind; it stays until it is set again."""
        at, code = self._numbers[path]
        data = np.array([value], dtype=f"<{code}").view(np.uint8)
        self._bytes[at : at + data.size] = data

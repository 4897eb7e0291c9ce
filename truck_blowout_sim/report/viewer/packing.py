"""Numbers for a page: rounded to a quantum, differenced, compressed, as base64 text.

Each series is rounded to whole quanta; second differences of those whole numbers are written as
four planes of bytes (first the lowest byte of every number), so that smooth signals become mostly
zeros; all series of a run are compressed together. page/data.js undoes it.

Known limits: rounding of half a quantum; a series spans at most 2^31 quanta.
Validated with: test/report/test_viewer_packing.py.
"""

from __future__ import annotations

import base64
import zlib
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

_LEVELS = 60_000.0
_LARGEST = 2.0**28  # second differences reach four times as far, their code eight times


class Packer:
    """Collects series and gives them out as one text."""

    def __init__(self) -> None:
        self._parts: list[bytes] = []
        self._at = 0

    def add(self, values: ArrayLike, quantum: float | None = None) -> dict[str, Any]:
        """Pack a series; returns what a reader needs to find and restore it.

        Args:
            values: finite numbers.
            quantum: step they are rounded to; 1/60,000 of their range by default.
        """
        array = np.asarray(values, dtype=np.float64).ravel()
        low = float(array.min()) if array.size else 0.0
        span = float(array.max()) - low if array.size else 0.0
        step = max(quantum or span / _LEVELS, span / _LARGEST)
        if not np.isfinite(step) or step <= 0.0:
            step = 1.0
        whole = np.rint((array - low) / step).astype(np.int64)
        entry = {"at": self._at, "n": int(array.size), "low": low, "step": step}
        planes = _planes(whole)
        self._parts.append(planes)
        self._at += len(planes)
        return entry

    def text(self) -> str:
        """Everything that was added, compressed, as base64."""
        return base64.b64encode(zlib.compress(b"".join(self._parts), 9)).decode("ascii")


def unpacked(entry: Mapping[str, Any], text: str) -> NDArray[np.float64]:
    """The values of one entry again, rounded."""
    data = zlib.decompress(base64.b64decode(text))
    n, at = int(entry["n"]), int(entry["at"])
    planes = np.frombuffer(data[at : at + 4 * n], dtype=np.uint8).reshape(4, n)
    coded = np.ascontiguousarray(planes.T).view("<u4").ravel().astype(np.int64)
    change = np.where(coded % 2 == 0, coded // 2, -(coded // 2) - 1)
    return np.cumsum(np.cumsum(change)) * float(entry["step"]) + float(entry["low"])


def _planes(whole: NDArray[np.int64]) -> bytes:
    change = np.diff(whole, n=2, prepend=[0, 0])
    coded = np.where(change >= 0, 2 * change, -2 * change - 1).astype("<u4")
    return np.ascontiguousarray(coded.view(np.uint8).reshape(-1, 4).T).tobytes()

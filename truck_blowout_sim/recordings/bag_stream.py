"""The fast way into a bag: a fixed list of channels, one row of numbers an instant."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from truck_blowout_sim.recordings.encoder import RowEncoder

FloatArray = NDArray[np.float64]
TimeArray = NDArray[np.int64]


class BagStream:
    """A fixed list of channels of a `BagWriter`, checked and encoded."""

    def __init__(
        self,
        encoder: RowEncoder,
        *,
        stamp_ns: Callable[[float], int],
        accept: Callable[[RowEncoder, TimeArray, FloatArray], None],
    ) -> None:
        self._encoder = encoder
        self._stamp_ns = stamp_ns
        self._accept = accept
        self._last_ns = -1

    @property
    def topics(self) -> tuple[str, ...]:
        """Relative names of the topics that one instant fills."""
        return tuple(slot.topic for slot in self._encoder.slots)

    def write(self, time_s: float, values: ArrayLike) -> None:
        """Write one instant.

        Args:
            time_s: on the recording's clock; not before the last one.
            values: one finite number per channel, in the order of the stream.

        Raises:
            ValueError: time runs backwards, or a value is not finite.
            StorageError: the disk failed.
        """
        times = np.array([self._stamp_ns(time_s)], dtype=np.int64)
        self._write(times, np.asarray(values, dtype=np.float64).reshape(1, -1))

    def write_many(self, times_ns: TimeArray, values: FloatArray) -> None:
        """Write n instants: stamps of shape (n,) from 0 on, values of shape (n, channels)."""
        if len(times_ns):
            self._write(times_ns, values)

    def _write(self, times_ns: TimeArray, values: FloatArray) -> None:
        if not np.isfinite(values).all():
            column = int(np.flatnonzero(~np.isfinite(values).all(axis=0))[0])
            name = self._encoder.channels[column].name
            raise ValueError(f"{name} is not finite at stamp {times_ns[0]} ns")
        if times_ns[0] < self._last_ns or (len(times_ns) > 1 and (np.diff(times_ns) < 0).any()):
            raise ValueError(f"time runs backwards: stamp {times_ns[0]} after {self._last_ns} ns")
        self._last_ns = int(times_ns[-1])
        self._accept(self._encoder, times_ns, values)

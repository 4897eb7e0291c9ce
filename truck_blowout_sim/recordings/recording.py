"""A recording in memory: channels on their own time bases, blowouts, metadata.

References: the recording formats of the project's interface description.
Known limits: one clock for all channels; times are seconds as float64 (0.1 microsecond over a
year).
Validated with: test/recordings/test_recording_in_memory.py.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from truck_blowout_sim.errors import nearest
from truck_blowout_sim.recordings.channels import INPUT_NAMES

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

FloatArray = NDArray[np.float64]

_GAP_FACTOR = 2.5
INPUTS_KEY = "inputs"
"""Metadata key that says what an input is between two samples."""
# Times are sums of steps: a sample at the very instant counts.
_SAME_INSTANT_S = 1e-7


@dataclass(frozen=True, eq=False, repr=False)
class Series:
    """Samples of one channel: strictly increasing times and finite values, same length.

    A gap is simply an absence of samples; there is no NaN inside.
    """

    time_s: FloatArray
    value: FloatArray

    def __post_init__(self) -> None:
        object.__setattr__(self, "time_s", _frozen(self.time_s))
        object.__setattr__(self, "value", _frozen(self.value))
        if self.time_s.ndim != 1 or self.time_s.shape != self.value.shape:
            raise ValueError(f"time {self.time_s.shape} and value {self.value.shape} differ")
        if not (np.isfinite(self.time_s).all() and np.isfinite(self.value).all()):
            raise ValueError("a series holds finite numbers only: leave missing samples out")
        if self.time_s.size > 1 and not (np.diff(self.time_s) > 0).all():
            raise ValueError("times of a series must increase strictly")

    def __len__(self) -> int:
        return int(self.time_s.size)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Series):
            return NotImplemented
        return np.array_equal(self.time_s, other.time_s) and np.array_equal(self.value, other.value)

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        span = f", {self.time_s[0]:g} to {self.time_s[-1]:g} s" if len(self) else ""
        return f"<Series: {len(self)} samples{span}>"

    @property
    def period_s(self) -> float:
        """Median sampling interval, NaN with fewer than two samples."""
        return float(np.median(np.diff(self.time_s))) if len(self) > 1 else float("nan")

    def gaps(self, longer_than_s: float | None = None) -> tuple[tuple[float, float], ...]:
        """Intervals (last sample before, first after) without samples.

        Args:
            longer_than_s: shortest silence that counts; 2.5 sampling intervals by default.
        """
        if len(self) < 2:
            return ()
        limit_s = _GAP_FACTOR * self.period_s if longer_than_s is None else longer_than_s
        at = np.flatnonzero(np.diff(self.time_s) > limit_s)
        return tuple((float(self.time_s[i]), float(self.time_s[i + 1])) for i in at)

    def between(self, start_s: float, end_s: float) -> Series:
        """Samples with start_s <= time <= end_s."""
        first = np.searchsorted(self.time_s, start_s, side="left")
        last = np.searchsorted(self.time_s, end_s, side="right")
        return Series(self.time_s[first:last], self.value[first:last])

    def at(self, times_s: ArrayLike, *, max_gap_s: float | None = None) -> FloatArray:
        """Values by linear interpolation; NaN before the first and after the last sample.

        Args:
            times_s: instants, any shape.
            max_gap_s: give NaN inside silences longer than this instead of bridging them.
        """
        times = np.asarray(times_s, dtype=np.float64)
        if not len(self):
            return np.full(times.shape, np.nan)
        out = np.interp(times, self.time_s, self.value, left=np.nan, right=np.nan)
        if max_gap_s is not None:
            for start_s, end_s in self.gaps(max_gap_s):
                out = np.where((times > start_s) & (times < end_s), np.nan, out)
        return np.asarray(out, dtype=np.float64)


@dataclass(frozen=True)
class Blowout:
    """Tires that lose their air at one instant."""

    time_s: float
    tires: tuple[str, ...]


@dataclass(frozen=True, repr=False)
class Recording:
    """What was measured (or simulated): channels, events, metadata.

    Attributes:
        name: short name, usually the file's stem.
        channels: series by channel name (CSV column), SI units, pressures gauge.
        blowouts: events in order of time.
        metadata: free text by key (test name, sensor positions, notes).
        notes: what a reader had to assume or leave out, for a person to see.
    """

    name: str
    channels: Mapping[str, Series]
    blowouts: tuple[Blowout, ...] = ()
    metadata: Mapping[str, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "channels", MappingProxyType(dict(self.channels)))
        object.__setattr__(self, "metadata", MappingProxyType(dict(self.metadata)))
        in_order = tuple(sorted(self.blowouts, key=lambda blowout: blowout.time_s))
        object.__setattr__(self, "blowouts", in_order)

    def __contains__(self, name: object) -> bool:
        return name in self.channels

    def __getitem__(self, name: str) -> Series:
        if name not in self.channels:
            near = nearest(str(name), self.channels, "no channel is like it")
            raise KeyError(f"{name!r} was not recorded; {near}")
        return self.channels[name]

    def __repr__(self) -> str:
        span = f", {self.start_s:g} to {self.end_s:g} s" if self.channels else ""
        blown = "".join(f", {'+'.join(b.tires)} blown at {b.time_s:g} s" for b in self.blowouts)
        return f"<Recording {self.name!r}: {len(self.channels)} channels{span}{blown}>"

    def __reduce__(self) -> tuple[object, ...]:
        # mapping proxies do not pickle; batches send recordings to other processes
        parts = (self.name, dict(self.channels), self.blowouts, dict(self.metadata), self.notes)
        return Recording, parts

    @property
    def start_s(self) -> float:
        """Earliest sample, without channels the earliest event; NaN for an empty recording.

        A tire that burst before the first sample is flat from there on.
        """
        firsts = [float(s.time_s[0]) for s in self.channels.values() if len(s)]
        return min(firsts or [b.time_s for b in self.blowouts], default=float("nan"))

    @property
    def end_s(self) -> float:
        """Latest sample or event; NaN for an empty recording."""
        lasts = [float(s.time_s[-1]) for s in self.channels.values() if len(s)]
        return max([*lasts, *(b.time_s for b in self.blowouts)], default=float("nan"))

    @property
    def duration_s(self) -> float:
        """From the first sample to the last sample or event."""
        return self.end_s - self.start_s

    @property
    def missing_inputs(self) -> tuple[str, ...]:
        """Inputs that were not recorded."""
        return tuple(name for name in INPUT_NAMES if name not in self.channels)

    @property
    def inputs_are_held(self) -> bool:
        """Whether inputs are commands to a simulator, which holds each until the next one."""
        return self.metadata.get(INPUTS_KEY, "").startswith("held")

    def at(self, name: str, times_s: ArrayLike, *, max_gap_s: float | None = None) -> FloatArray:
        """Channel at given instants, see :meth:`Series.at`; KeyError if it was not recorded."""
        return self[name].at(times_s, max_gap_s=max_gap_s)

    def inputs_at(self, times_s: ArrayLike) -> FloatArray:
        """The five inputs at given instants.

        Linear between samples; of commands to a simulator, which holds each until the next one
        (metadata ``inputs: held``), the last one. Held before the first and after the last one.

        Returns:
            Shape (n, 5) in the order of ``INPUT_NAMES``; a column of NaN where an input was not
            recorded (``missing_inputs`` lists them).
        """
        times = np.atleast_1d(np.asarray(times_s, dtype=np.float64))
        out = np.full((times.size, len(INPUT_NAMES)), np.nan)
        held = self.inputs_are_held
        for column, name in enumerate(INPUT_NAMES):
            series = self.channels.get(name)
            if series is not None and len(series):
                out[:, column] = _held(times, series) if held else _linear(times, series)
        return out

    def gaps(
        self, name: str, longer_than_s: float | None = None
    ) -> tuple[tuple[float, float], ...]:
        """Silences of a channel, see :meth:`Series.gaps`."""
        return self[name].gaps(longer_than_s)

    def between(self, start_s: float, end_s: float) -> Recording:
        """The part with start_s <= time <= end_s; channels left without samples are dropped.

        What lasts goes along: a tire that burst earlier in the same run keeps its instant, and
        held inputs have the value that still applies at start_s.
        """
        cut = {name: series.between(start_s, end_s) for name, series in self.channels.items()}
        if self.inputs_are_held:
            cut |= {n: _with_what_holds(cut[n], self.channels[n], start_s)
                    for n in INPUT_NAMES if n in cut}  # fmt: skip
        kept = {name: series for name, series in cut.items() if len(series)}
        return replace(self, channels=kept, blowouts=self._blown_until(start_s, end_s))

    def _blown_until(self, start_s: float, end_s: float) -> tuple[Blowout, ...]:
        """Blowouts up to end_s, from the last reset before start_s on."""
        from truck_blowout_sim.recordings.resets import reset_times_s, run_at

        events = tuple(b for b in self.blowouts if b.time_s <= end_s)
        if not any(b.time_s < start_s for b in events):
            return events
        resets_s = reset_times_s(self.channels)
        run = run_at(start_s, resets_s)
        return tuple(b for b in events if b.time_s >= start_s or run_at(b.time_s, resets_s) == run)

    def shifted(self, by_s: float) -> Recording:
        """The same recording on a clock that reads by_s more."""
        moved = {n: Series(s.time_s + by_s, s.value) for n, s in self.channels.items()}
        events = tuple(Blowout(b.time_s + by_s, b.tires) for b in self.blowouts)
        return replace(self, channels=moved, blowouts=events)

    def to_pandas(self) -> pd.DataFrame:
        """A frame with one column a channel, see :func:`frames.to_pandas`."""
        from truck_blowout_sim.recordings.frames import to_pandas

        return to_pandas(self)

    def to_xarray(self) -> xr.Dataset:
        """A dataset with one variable a channel, see :func:`frames.to_xarray`."""
        from truck_blowout_sim.recordings.frames import to_xarray

        return to_xarray(self)

    @staticmethod
    def from_pandas(frame: pd.DataFrame) -> Recording:
        """The recording that a frame holds, see :func:`frames.from_pandas`."""
        from truck_blowout_sim.recordings.frames import from_pandas

        return from_pandas(frame)

    @staticmethod
    def from_xarray(dataset: xr.Dataset) -> Recording:
        """The recording that a dataset holds, see :func:`frames.from_xarray`."""
        from truck_blowout_sim.recordings.frames import from_xarray

        return from_xarray(dataset)

    def with_channels(self, channels: Mapping[str, Series]) -> Recording:
        """A copy in which the given channels are added or replaced."""
        return replace(self, channels={**self.channels, **channels})

    def without_channels(self, names: Iterable[str]) -> Recording:
        """A copy that lacks the given channels."""
        dropped = set(names)
        return replace(self, channels={n: s for n, s in self.channels.items() if n not in dropped})

    def only_channels(self, names: Sequence[str]) -> Recording:
        """A copy that has the given channels only, as far as they exist."""
        return replace(self, channels={n: self.channels[n] for n in names if n in self.channels})

    def with_metadata(self, **entries: str) -> Recording:
        """A copy with metadata entries added or replaced."""
        return replace(self, metadata={**self.metadata, **entries})


def _linear(times_s: FloatArray, series: Series) -> FloatArray:
    return np.interp(times_s, series.time_s, series.value)


def _held(times_s: FloatArray, series: Series) -> FloatArray:
    last = np.searchsorted(series.time_s, times_s + _SAME_INSTANT_S, side="right") - 1
    return series.value[np.maximum(last, 0)]


def _with_what_holds(cut: Series, whole: Series, start_s: float) -> Series:
    """A part of a held input, led by the value that was given before it and still applies."""
    before = int(np.searchsorted(whole.time_s, start_s, side="left")) - 1
    if before < 0 or (len(cut) and cut.time_s[0] <= start_s + _SAME_INSTANT_S):
        return cut
    return Series(np.append(start_s, cut.time_s), np.append(whole.value[before], cut.value))


def _frozen(values: ArrayLike) -> FloatArray:
    array = np.array(values, dtype=np.float64)
    array.setflags(write=False)
    return array

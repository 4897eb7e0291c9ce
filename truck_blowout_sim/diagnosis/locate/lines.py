"""Lines in what the model leaves: power over background at each pace or distance that is tried.

Spectra of measured - model at the full rate of the recording, channel by channel: over distance for
what a wheel does once a turn and for what swings as the truck goes on, over time for a steady tone.
Where nothing beats, power over background is exponential with mean one. The background is the
median of the neighbors, never below the instrument's noise, and, for what swings, never below a
share of what the model itself does there: a driver who swings his wheel at even distances makes
every model err at them.

References: order tracking (Fyfe and Munck 1997); McArthur et al. 2016 (the wake of a heavy vehicle
pumps and sheds at Strouhal numbers of 0.08 and 0.17, by its width).
Known limits: fast channels only (20 Hz and more); a run counts up to the first tire blown on
command, which beats by itself.
Validated with: test/diagnosis/test_periodic.py (false alarms on noise, lines that were put in).
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import median_filter

from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.locate.beat import HARMONICS
from truck_blowout_sim.diagnosis.sensors import believable, channel_noise
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.simulation.drive import names_of, run_drive
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
Term = tuple[str, int, Floats, Floats]
_SHAKEN = ("_ax_mps2", "_ay_mps2", "_az_mps2", "_roll_rate_radps", "_pitch_rate_radps")
_ALONG = ("_ax_mps2",)
_SWUNG = ("_yaw_rate_radps",)
_LEAST_RATE_HZ = 20.0
_SHORTEST_S = 5.0
_ROLLING_SPEED_MPS = 5.0
_TRIES = 400  # paces or distances tried
PACES_HZ = np.linspace(1.2, 8.0, _TRIES)
# per meter: vehicles 1.5 to 2.6 m wide at those Strouhal numbers, 9 to 32 m, and some more
WAVES_PER_M = np.linspace(1.0 / 40.0, 1.0 / 8.0, _TRIES)
_RADII = (0.93, 1.02)  # of the unloaded radius: what a loaded tire rolls on
_PARTS = 3
_PADDED = 4
_NEIGHBORS = 30  # resolution cells to either side that make the background
_CLOSE = 7  # the same where a unit sways at its own frequency on any road: damped by 0.1 and more
_MEDIAN_OF_EXPONENTIAL = float(np.log(2.0))
_MODELS_DIFFER = 0.25  # of what a model does at a distance, at most: a judgment


@dataclass(frozen=True, eq=False)
class Signal:
    """A fast channel of a run.

    Attributes:
        time_s, left, model: [n] times, measured - model, model.
        noise: 1 sigma of the instrument.
    """

    time_s: Floats
    left: Floats
    model: Floats
    noise: float


Signals = Mapping[str, Signal]  # by channel


@dataclass(frozen=True, eq=False)
class Lines:
    """Power over background, and squared amplitude, at the frequencies tried; rows are terms.

    Attributes:
        channels, harmonics: of each term.
        ratios, squares: [terms, tries].
        baseline: whether of a baseline run; ``speed_mps`` of the run.
    """

    channels: tuple[str, ...]
    harmonics: tuple[int, ...]
    ratios: Floats
    squares: Floats
    baseline: bool = False
    speed_mps: float = 0.0

    def only(self, channels: Collection[str]) -> Lines:
        """Those of some channels."""
        kept = [i for i, name in enumerate(self.channels) if name in channels]
        return replace(self, channels=tuple(self.channels[i] for i in kept),
                       harmonics=tuple(self.harmonics[i] for i in kept),
                       ratios=self.ratios[kept], squares=self.squares[kept])


def turns_per_m(packed: Packed) -> Floats:
    """Wheel turns a meter that are tried."""
    radius = float(np.median([packed[n] for n in packed.index
                              if n.endswith(".unloaded_radius_m")]))
    slowest, fastest = (1.0 / (2.0 * np.pi * radius * share) for share in (_RADII[1], _RADII[0]))
    return np.linspace(slowest, fastest, _TRIES)


def measured_less_model(run: Run, truck: Packed) -> Signals:
    """What the model leaves of each fast channel, up to the first tire blown on command."""
    recording, names = run.recording, names_of(truck.vehicle)
    start = float(run.edges_s[0])
    end = min(run.lost_s, float(run.edges_s[-1]))
    out, found = run_drive(truck, run.drive), {}
    fast = [n for n in names if n.endswith((*_SHAKEN, *_SWUNG)) and n in recording]
    noise = believable(channel_noise(recording.only_channels(fast)))
    for name in (n for n in fast if n in noise):
        series = recording[name].between(start, max(start, end))
        if len(series) < _LEAST_RATE_HZ * _SHORTEST_S or (
                series.time_s[-1] - series.time_s[0] < _SHORTEST_S):
            continue
        model = np.interp(series.time_s, run.drive.times_s, out[:, names.index(name)])
        if np.isfinite(model).all() and series.period_s <= 1.0 / _LEAST_RATE_HZ:
            found[name] = Signal(series.time_s, series.value - model, model, noise[name].sigma)
    return found


def turn_lines(signals: Signals, recording: Recording, per_m: Floats) -> Lines:
    """Lines over distance at the first harmonics of each number of turns a meter."""
    terms: list[Term] = []
    for name, way, one in _over_distance(signals, recording, _SHAKEN):
        frequency, ratio, square = _spectrum(way, one.left, one.noise)
        terms += [(name, k, np.interp(k * per_m, frequency, ratio),
                   np.interp(k * per_m, frequency, square))
                  for k in HARMONICS if k * per_m.max() < frequency[-1]]
    return _lines(terms, per_m.size)


def wave_lines(signals: Signals, recording: Recording, per_m: Floats) -> Lines:
    """Lines over distance in the yaw rates, beside what the model itself does there."""
    terms: list[Term] = []
    for name, way, one in _over_distance(signals, recording, _SWUNG):
        frequency, ratio, square = _spectrum(way, one.left, one.noise, _CLOSE,
                                             _MODELS_DIFFER * one.model)
        terms.append((name, 1, np.interp(per_m, frequency, ratio),
                      np.interp(per_m, frequency, square)))
    return _lines(terms, per_m.size)


def tone_lines(signals: Signals, paces_hz: Floats) -> Lines:
    """Lines over time along the course, in each part of the run."""
    terms: list[Term] = []
    for name, one in _of_channels(signals, _ALONG).items():
        parts = [_spectrum(one.time_s[part], one.left[part], one.noise)
                 for part in np.array_split(np.arange(one.time_s.size), _PARTS)]
        ratios, squares = (np.array([np.interp(paces_hz, p[0], p[k]) for p in parts])
                           for k in (1, 2))
        terms.append((name, 1, _PARTS * ratios.min(axis=0), squares.mean(axis=0)))
    return _lines(terms, paces_hz.size)


def _of_channels(signals: Signals, endings: tuple[str, ...]) -> Signals:
    return {name: one for name, one in signals.items() if name.endswith(endings)}


def _over_distance(signals: Signals, recording: Recording, endings: tuple[str, ...]
                   ) -> Iterator[tuple[str, Floats, Signal]]:
    """Channels, distance covered, and the signal there, where the vehicle rolls for long enough."""
    for name, one in _of_channels(signals, endings).items():
        way, rolling = _way(recording, one.time_s)
        if rolling.sum() >= _LEAST_RATE_HZ * _SHORTEST_S:
            yield name, way[rolling], Signal(one.time_s[rolling], one.left[rolling],
                                             one.model[rolling], one.noise)


def _way(recording: Recording, time_s: Floats) -> tuple[Floats, NDArray[np.bool_]]:
    """Distance covered at each time, and whether the vehicle rolls; it does not without a speed."""
    speed = next((series for name, series in recording.channels.items()
                  if name.endswith("_vx_mps")), None)
    if speed is None:
        return np.zeros_like(time_s), np.zeros(time_s.size, dtype=np.bool_)
    v = np.interp(time_s, speed.time_s, speed.value)
    return (np.concatenate(([0.0], np.cumsum(0.5 * (v[1:] + v[:-1]) * np.diff(time_s)))),
            v > _ROLLING_SPEED_MPS)


def _lines(terms: Sequence[Term], tries: int) -> Lines:
    return Lines(tuple(name for name, *_ in terms), tuple(k for _, k, _, _ in terms),
                 np.array([r for *_, r, _ in terms]).reshape(-1, tries),
                 np.array([a for *_, a in terms]).reshape(-1, tries))


def _spectrum(x: Floats, y: Floats, noise: float, neighbors: int = _NEIGHBORS,
              usual: Floats | None = None) -> tuple[Floats, Floats, Floats]:
    """Frequencies, power over background, squared amplitude above background; any even axis.

    The background is never below that of the instrument: what a computed record leaves of another
    step's rounding beats clearly, at a size that nothing measures. Nor below that of ``usual``.
    """
    even, window = np.linspace(x[0], x[-1], x.size), np.hanning(x.size)
    power = _power(even, np.interp(even, x, y), window)
    background = median_filter(power, size=2 * neighbors * _PADDED + 1,
                               mode="mirror") / _MEDIAN_OF_EXPONENTIAL
    background = np.maximum(background, noise**2 * float(window @ window))
    if usual is not None:
        background = np.maximum(background, _power(even, np.interp(even, x, usual), window))
    frequency = np.fft.rfftfreq(_PADDED * x.size, even[1] - even[0])
    square = 4.0 * np.maximum(power - background, 0.0) / window.sum() ** 2
    return frequency, power / background, square


def _power(even: Floats, values: Floats, window: Floats) -> Floats:
    """Of what a slow bend leaves of the values."""
    values = (values - np.polyval(np.polyfit(even, values, 2), even)) * window
    return np.asarray(np.abs(np.fft.rfft(values, _PADDED * even.size)) ** 2)

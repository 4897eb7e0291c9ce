"""What beats: a force once per wheel turn, or at a steady pace, faster than the bins can show.

Spectra of measured - model, channel by channel, over distance and over time. A line is a frequency
at which the power stands far above its neighbors', in many channels, harmonics and runs at once.
Where nothing beats, power over background is exponential with mean one, the sum of n terms follows
the gamma law, and the smallest of n parts' ratios times n is exponential, too: a tone must last
through the run. The course itself has slow waves that no model has, in baseline runs as well: of
the greatest of N exponential powers in training and of N others, the one exceeds c times the other
with chance N^(1-c) Gamma(1+c), however strong these are. What strikes once a turn has several
harmonics; the tone of an engine has one, wherever the wheels' pace meets it.

References: order tracking (Fyfe and Munck 1997); Fisher's test for a hidden periodicity (1929).
Known limits: fast channels only (20 Hz and more); once per turn says which unit, not which wheel,
and a pure sine once a turn (imbalance alone) is taken for a tone; a steady tone is looked for along
the course alone, because a truck rolls and bounces at its own frequencies on any road, and beside
baseline runs only; a run counts up to the first tire blown on command, which beats by itself.
Validated with: test/diagnosis/test_periodic.py (false alarms on noise, lines that were put in).
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import median_filter
from scipy.optimize import brentq
from scipy.special import gammaln
from scipy.stats import gamma

from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.models import with_effects
from truck_blowout_sim.diagnosis.locate.beat import HARMONICS, Beat
from truck_blowout_sim.diagnosis.result.evidence import BeatScores
from truck_blowout_sim.diagnosis.sensors import believable, channel_noise
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.simulation.drive import names_of, run_drive
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
Term = tuple[str, int, Floats, Floats]
Signals = Mapping[str, tuple[Floats, Floats, float]]  # times, measured - model, noise; by channel
FAST = ("_ax_mps2", "_ay_mps2", "_az_mps2", "_roll_rate_radps", "_pitch_rate_radps")
ALONG = ("_ax_mps2",)
_LEAST_RATE_HZ = 20.0
_SHORTEST_S = 5.0
_ROLLING_SPEED_MPS = 5.0
_RADII = (0.93, 1.02)  # of the unloaded radius: what a loaded tire rolls on
_TRIES = 400  # frequencies tried
_PACES = np.linspace(1.2, 8.0, _TRIES)  # a second
_SHAKES = ("_az_mps2",)  # vertical: a wheel shakes the unit that stands on it
_PARTS = 3
_CELLS = 32  # paces that a third of a run of 14 s resolves
_PADDED = 4
_NEIGHBORS = 30  # resolution cells to either side that make the background
_MEDIAN_OF_EXPONENTIAL = float(np.log(2.0))
_BY_ITSELF = 2.0  # standard errors in each run: an engine's tone meets a wheel's pace in one only
_ALWAYS = 0.3  # of the training runs' lines: from here on the baseline has them too


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


def find_beat(study: Study, named: Sequence[Hypothesis] = ()) -> Beat | None:
    """The clearest beat in the training runs that the baseline runs do not have.

    Without baseline runs, a steady pace is not asked for.
    """
    per_m, rules = _turns_per_m(study.packed), study.settings
    turning, steady = [], []
    for run in study.runs:
        truck = with_effects(study.packed, named if run.role == "train" else (),
                             run.recording.name)
        signals = measured_less_model(run, truck)
        about = (run.role == "baseline", run.drive.initial.speed_mps)
        turning.append(_of(turn_lines(signals, run.recording, per_m), *about))
        steady.append(_of(tone_lines(signals, _PACES), *about))
    # engine and frame of every sound vehicle have a tone: only its baseline tells a new one
    found = (clearest(turning, 1.0 / per_m, True, rules.alarms_by_sign),
             clearest(steady, 1.0 / _PACES, False, rules.alarms_by_sign) if study.baseline
             else None)
    return max((b for b in found if b), key=lambda b: b.evidence, default=None)


def _of(lines: Lines, baseline: bool, speed_mps: float) -> Lines:
    return replace(lines, baseline=baseline, speed_mps=speed_mps)


def _turns_per_m(packed: Packed) -> Floats:
    """Wheel turns a meter that are tried."""
    radius = float(np.median([packed[n] for n in packed.index
                              if n.endswith(".unloaded_radius_m")]))
    slowest, fastest = (1.0 / (2.0 * np.pi * radius * share) for share in (_RADII[1], _RADII[0]))
    return np.linspace(slowest, fastest, _TRIES)


def measured_less_model(run: Run, truck: Packed) -> Signals:
    """What the model leaves of each fast channel, up to the first tire blown on command."""
    recording, names = run.recording, names_of(truck.vehicle)
    start = float(run.edges_s[0])
    end = min([b.time_s for b in recording.blowouts] + [float(run.edges_s[-1])])
    out, found = run_drive(truck, run.drive), {}
    fast = [n for n in names if n.endswith(FAST) and n in recording]
    noise = believable(channel_noise(recording.only_channels(fast)))
    for name in (n for n in fast if n in noise):
        series = recording[name].between(start, max(start, end))
        if len(series) < _LEAST_RATE_HZ * _SHORTEST_S or (
                series.time_s[-1] - series.time_s[0] < _SHORTEST_S):
            continue
        model = np.interp(series.time_s, run.drive.times_s, out[:, names.index(name)])
        if np.isfinite(model).all() and series.period_s <= 1.0 / _LEAST_RATE_HZ:
            found[name] = (series.time_s, series.value - model, noise[name].sigma)
    return found


def turn_lines(signals: Signals, recording: Recording, per_m: Floats) -> Lines:
    """Lines over distance at the first harmonics of each number of turns a meter."""
    terms: list[Term] = []
    speed = next((series for name, series in recording.channels.items()
                  if name.endswith("_vx_mps")), None)
    if speed is None:
        return _lines(terms, per_m.size)
    for name, (time_s, left, noise) in signals.items():
        v = np.interp(time_s, speed.time_s, speed.value)
        rolling = v > _ROLLING_SPEED_MPS
        if rolling.sum() < _LEAST_RATE_HZ * _SHORTEST_S:
            continue
        way = np.concatenate(([0.0], np.cumsum(0.5 * (v[1:] + v[:-1]) * np.diff(time_s))))[rolling]
        frequency, ratio, square = _spectrum(way, left[rolling], noise)
        terms += [(name, k, np.interp(k * per_m, frequency, ratio),
                   np.interp(k * per_m, frequency, square))
                  for k in HARMONICS if k * per_m.max() < frequency[-1]]
    return _lines(terms, per_m.size)


def tone_lines(signals: Signals, paces_hz: Floats) -> Lines:
    """Lines over time along the course, in each part of the run."""
    terms: list[Term] = []
    for name, (time_s, left, noise) in signals.items():
        if not name.endswith(ALONG):
            continue
        parts = [_spectrum(time_s[part], left[part], noise)
                 for part in np.array_split(np.arange(time_s.size), _PARTS)]
        ratios, squares = (np.array([np.interp(paces_hz, p[0], p[k]) for p in parts])
                           for k in (1, 2))
        terms.append((name, 1, _PARTS * ratios.min(axis=0), squares.mean(axis=0)))
    return _lines(terms, paces_hz.size)


def _lines(terms: Sequence[Term], tries: int) -> Lines:
    return Lines(tuple(name for name, *_ in terms), tuple(k for _, k, _, _ in terms),
                 np.array([r for *_, r, _ in terms]).reshape(-1, tries),
                 np.array([a for *_, a in terms]).reshape(-1, tries))


def _spectrum(x: Floats, y: Floats, noise: float) -> tuple[Floats, Floats, Floats]:
    """Frequencies, power over background, squared amplitude above background; any even axis.

    The background is never below that of the instrument: what a computed record leaves of another
    step's rounding beats clearly, at a size that nothing measures.
    """
    even = np.linspace(x[0], x[-1], x.size)
    window = np.hanning(x.size)
    values = np.interp(even, x, y)
    values = (values - np.polyval(np.polyfit(even, values, 2), even)) * window
    power = np.abs(np.fft.rfft(values, _PADDED * x.size)) ** 2
    background = median_filter(power, size=2 * _NEIGHBORS * _PADDED + 1,
                               mode="mirror") / _MEDIAN_OF_EXPONENTIAL
    background = np.maximum(background, noise**2 * float(window @ window))
    frequency = np.fft.rfftfreq(_PADDED * x.size, even[1] - even[0])
    square = 4.0 * np.maximum(power - background, 0.0) / window.sum() ** 2
    return frequency, power / background, square


def clearest(lines: Sequence[Lines], every: Floats, turning: bool, rate: float) -> Beat | None:
    """The highest score among those tried, if in every training run, new there, and no chance.

    What a wheel does is looked for in all channels, in those of each unit, and in its vertical
    ones: a small blow shows only where the wheel stands.

    ``rate``: how often chance may reach it where nothing beats.
    """
    views = _views(lines) if turning else [lines]
    found = [_clearest(view, every, turning, rate, every.size * len(views)) for view in views]
    return max((one for one in found if one), key=lambda b: b.evidence, default=None)


def _views(lines: Sequence[Lines]) -> list[list[Lines]]:
    """The same lines, of all channels or of some."""
    names = sorted({name for part in lines for name in part.channels})
    units = sorted({name.split("_", 1)[0] for name in names})
    groups = [names, *([n for n in names if n.startswith(f"{unit}_") and n.endswith(ending)]
                       for ending in ("", *_SHAKES) for unit in units)]
    different = dict.fromkeys(tuple(group) for group in groups if group)
    return [[part.only(group) for part in lines] for group in different] or [list(lines)]


def _clearest(lines: Sequence[Lines], every: Floats, turning: bool, rate: float, tries: int
              ) -> Beat | None:
    """The same of some channels, the best of so many ``tries``."""
    train = [part for part in lines if part.channels and not part.baseline]
    if not train:
        return None
    ratios = np.concatenate([part.ratios for part in train])
    score, least = _scores(ratios), by_chance(len(ratios), tries, rate)
    k = int(np.argmax(score))
    excess = float(ratios[:, k].mean()) - 1.0
    if score[k] < least or any(part.ratios[:, k].mean() - 1.0 > _ALWAYS * excess
                               for part in lines if part.channels and part.baseline):
        return None
    if min(_scores(part.ratios)[k] for part in train) < min(_BY_ITSELF, least):
        return None
    if turning and _is_a_tone(train, k, rate):
        return None
    if not turning and excess + 1.0 < times_as_strong(_CELLS, rate) * max(
            (float(part.ratios.mean(axis=0).max()) for part in lines
             if part.channels and part.baseline), default=0.0):
        return None
    channel, amplitude = _shaken_most(train, k, turning)
    r = np.maximum(ratios[:, k], 1.0)
    return Beat(turning, float(every[k]), float(score[k]),
                float(2.0 * np.sum(r - 1.0 - np.log(r))), channel.split("_", 1)[0], channel,
                amplitude, float(np.mean([part.speed_mps for part in train])),
                BeatScores(turning, every, score, least))


def _is_a_tone(lines: Sequence[Lines], k: int, rate: float) -> bool:
    """Whether all but one harmonic stands no higher than chance, at a pace that was chosen."""
    ratios = np.concatenate([part.ratios[:, k] for part in lines])
    harmonic = np.concatenate([part.harmonics for part in lines])
    strongest = max(HARMONICS, key=lambda h: float(ratios[harmonic == h].sum()))
    others = ratios[harmonic != strongest]
    return not others.size or float(_scores(others)) < by_chance(others.size, 1, rate)


def _scores(ratios: Floats) -> Floats:
    """Standard errors by which the lines [terms, tries] stand above what chance gives."""
    return np.asarray((ratios.sum(axis=0) - len(ratios)) / np.sqrt(len(ratios)))


def by_chance(terms: int, tries: int, rate: float) -> float:
    """Score that the best of so many tries reaches by chance in a share ``rate`` of cases."""
    return float((gamma.isf(min(rate / tries, 1.0), terms) - terms) / np.sqrt(terms))


def times_as_strong(cells: int, rate: float) -> float:
    """Factor by which the greatest of so many powers exceeds that of as many others by chance."""
    def above(c: float) -> float:
        return float((1.0 - c) * np.log(cells) + gammaln(1.0 + c) - np.log(min(rate, 1.0)))
    return 1.0 if above(1.0) <= 0.0 else float(brentq(above, 1.0, 0.5 * cells))


def _shaken_most(lines: Sequence[Lines], k: int, turning: bool) -> tuple[str, float]:
    """Channel with the largest amplitude, vertical ones first for what a wheel does."""
    squares: dict[str, float] = {}
    for part in lines:
        for name, square in zip(part.channels, part.squares[:, k], strict=True):
            squares[name] = squares.get(name, 0.0) + float(square) / len(lines)
    best = max(squares, key=lambda n: (turning and n.endswith(_SHAKES), n.endswith("_mps2"),
                                       squares[n]))
    return best, float(np.sqrt(squares[best]))

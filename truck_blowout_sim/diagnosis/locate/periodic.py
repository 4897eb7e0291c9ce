"""What beats: a force once per wheel turn, at a steady pace, or at an even distance.

The bins are too wide for what is fast. A line is a frequency at which the power of measured - model
stands far above its neighbors', in many channels, harmonics and runs at once (`lines.py`). The sum
of n such powers follows the gamma law; the smallest of n parts' ratios times n is exponential, too:
a tone must last through the run. The course itself has slow waves that no model has, in baseline
runs as well: of the greatest of N exponential powers in training and of N others, the one exceeds c
times the other with chance N^(1-c) Gamma(1+c), however strong these are. What strikes once a turn
has several harmonics; the tone of an engine has one, wherever the wheels' pace meets it.

References: order tracking (Fyfe and Munck 1997); Fisher's test for a hidden periodicity (1929).
Known limits: see `lines.py`; once per turn says which unit, not which wheel, and a pure sine once a
turn (imbalance alone) is taken for a tone; a steady tone is looked for along the course alone,
because a truck rolls and bounces at its own frequencies on any road, and what swings in the yaw
rates alone; both beside baseline runs only. An uneven road swings a truck at even distances, too.
Validated with: test/diagnosis/test_periodic.py (false alarms on noise, lines that were put in).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq
from scipy.special import gammaln
from scipy.stats import gamma

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.models import jobs_with
from truck_blowout_sim.diagnosis.locate.beat import HARMONICS, Beat, Kind
from truck_blowout_sim.diagnosis.locate.lines import (
    PACES_HZ,
    WAVES_PER_M,
    Lines,
    measured_less_model,
    tone_lines,
    turn_lines,
    turns_per_m,
    wave_lines,
)
from truck_blowout_sim.diagnosis.result.evidence import BeatScores

Floats = NDArray[np.float64]
_SHAKES = ("_az_mps2",)  # vertical: a wheel shakes the unit that stands on it
# paces that a third of a run of 14 s resolves, and distances that one of 300 m does; in a run of
# 10 s they are 23, and chance reaches as much four times as often
_CELLS = 32
_BY_ITSELF = 2.0  # standard errors in each run: an engine's tone meets a wheel's pace in one only
_ALWAYS = 0.3  # of the training runs' lines: from here on the baseline has them too


def find_beat(study: Study, named: Sequence[Hypothesis] = ()) -> Beat | None:
    """The clearest beat in the training runs that the baseline runs do not have.

    Without baseline runs, neither a steady pace nor a swing is asked for.
    """
    per_m, rate = turns_per_m(study.packed), study.settings.alarms_by_sign
    turning, steady, swinging = [], [], []
    for run, truck in jobs_with(study, study.packed, named):
        signals = measured_less_model(run, truck)
        about = (run.role == "baseline", run.drive.initial.speed_mps)
        turning.append(_of(turn_lines(signals, run.recording, per_m), *about))
        if study.baseline:
            steady.append(_of(tone_lines(signals, PACES_HZ), *about))
            swinging.append(_of(wave_lines(signals, run.recording, WAVES_PER_M), *about))
    found = [clearest(turning, 1.0 / per_m, "turning", rate)]
    if study.baseline:  # every sound vehicle has tones and swings: only its baseline tells new ones
        found += [clearest(steady, 1.0 / PACES_HZ, "steady", rate),
                  clearest(swinging, 1.0 / WAVES_PER_M, "swinging", rate)]
    return max((b for b in found if b), key=lambda b: b.evidence, default=None)


def _of(lines: Lines, baseline: bool, speed_mps: float) -> Lines:
    return replace(lines, baseline=baseline, speed_mps=speed_mps)


def clearest(lines: Sequence[Lines], every: Floats, kind: Kind, rate: float) -> Beat | None:
    """The highest score among those tried, if in every training run, new there, and no chance.

    What a wheel does is looked for in all channels, in those of each unit, and in its vertical
    ones: a small blow shows only where the wheel stands. What swings, in all units and in each.

    ``rate``: how often chance may reach it where nothing beats.
    """
    views = [lines] if kind == "steady" else _views(lines)
    found = [_clearest(view, every, kind, rate, every.size * len(views)) for view in views]
    return max((one for one in found if one), key=lambda b: b.evidence, default=None)


def _views(lines: Sequence[Lines]) -> list[list[Lines]]:
    """The same lines, of all channels or of some."""
    names = sorted({name for part in lines for name in part.channels})
    units = sorted({name.split("_", 1)[0] for name in names})
    groups = [names, *([n for n in names if n.startswith(f"{unit}_") and n.endswith(ending)]
                       for ending in ("", *_SHAKES) for unit in units)]
    different = dict.fromkeys(tuple(group) for group in groups if group)
    return [[part.only(group) for part in lines] for group in different] or [list(lines)]


def _clearest(lines: Sequence[Lines], every: Floats, kind: Kind, rate: float, tries: int
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
    if kind == "turning" and _is_a_tone(train, k, rate):
        return None
    if kind != "turning" and excess + 1.0 < times_as_strong(_CELLS, rate) * max(
            (float(part.ratios.mean(axis=0).max()) for part in lines
             if part.channels and part.baseline), default=0.0):
        return None
    channel, amplitude = _shaken_most(train, k, kind)
    r = np.maximum(ratios[:, k], 1.0)
    return Beat(kind, float(every[k]), float(score[k]),
                float(2.0 * np.sum(r - 1.0 - np.log(r))), channel.split("_", 1)[0], channel,
                amplitude, float(np.mean([part.speed_mps for part in train])),
                BeatScores(kind, every, score, least))


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
    furthest = 0.5 * cells
    if above(1.0) <= 0.0:
        return 1.0
    return furthest if above(furthest) > 0.0 else float(brentq(above, 1.0, furthest))


def _shaken_most(lines: Sequence[Lines], k: int, kind: Kind) -> tuple[str, float]:
    """Channel with the largest amplitude, vertical ones first for what a wheel does."""
    squares: dict[str, float] = {}
    for part in lines:
        for name, square in zip(part.channels, part.squares[:, k], strict=True):
            squares[name] = squares.get(name, 0.0) + float(square) / len(lines)
    best = max(squares, key=lambda n: (kind == "turning" and n.endswith(_SHAKES),
                                       n.endswith("_mps2"), squares[n]))
    return best, float(np.sqrt(squares[best]))

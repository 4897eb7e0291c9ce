"""Whether noise of one channel, in a regressor and in what is left over alike, makes a fault.

A gain error is regressed on a motion that was measured. Where the noise of a channel c enters both
the slopes J and the residual e = J a + g n, least squares finds an amount without a fault: J'e is
not zero, because n stands in both. How large n is, is known where instruments are as quiet as they
seem; in a rough log, the worst is assumed for each channel in turn: that all that is left over is
its noise, as far as it is not larger than what the channel shows. Slopes without that noise are

    J_c = J - (dJ/dc) / (de/dc) e

and the amount that they give, as instruments of the regression, is

    a_c = (J_c' J)^-1 J_c' e .

Truth lies between a and a_c if c alone is noisy. A fault is doubtful if a' V^-1 a_c is less than
half of a' V^-1 a: noise explains more of it then than the fault does. Where instruments are quiet,
a_c is a.

References: Frisch 1934 (Statistical confluence analysis: direct and reversed regression enclose the
truth); Reiersol 1941 (instrumental variables).
Known limits: noise that enters through a derivative is at right angles to the channel and is left
out; two noisy channels may do together what none does alone.
Validated with: test/diagnosis/test_sensors_reversal.py.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.sensors.case import Applied, Case, Hypothesis, undone
from truck_blowout_sim.diagnosis.sensors.rows import (
    Rows,
    fault_slopes,
    smoothed_signals,
)
from truck_blowout_sim.diagnosis.sensors.signals import Signals
from truck_blowout_sim.diagnosis.sensors.slow import SlowRows
from truck_blowout_sim.diagnosis.sensors.solve import Estimate, Unknowns, solve, unknowns_of
from truck_blowout_sim.diagnosis.sensors.system import (
    assemble,
    normal_equations,
    whitened_parts,
)

FloatArray = NDArray[np.float64]
_R = TypeVar("_R", Rows, SlowRows)

_STEP = 1e-3
# where an identity reads a channel by less than this share of its most, noise there explains little
_WEAK = 0.05
_TINY = 1e-300


def doubtful(
    case: Case, chosen: Sequence[Hypothesis], amounts: Sequence[Sequence[float]],
    inflation: Mapping[str, float],
) -> list[bool]:  # fmt: skip
    """For each chosen fault, whether noise of a single channel explains more of it than it does.

    Args:
        case: the recordings.
        chosen: accepted faults.
        amounts: of each, as estimated, in full.
        inflation: factor on the noise of each identity.
    """
    taken = [Applied(h, tuple(a)) for h, a in zip(chosen, amounts, strict=True)]
    left = _Left.of(case, chosen, taken, inflation)
    return [left.made(k, np.array(amount)) for k, amount in enumerate(amounts)]


@dataclass(frozen=True, eq=False)
class _Recording:
    """One recording with the faults taken out.

    Attributes:
        rows: their residual is what nothing explains; ``slow`` likewise.
        smooth: what regressors are made of.
        acts: of each unknown, whether it acts in this recording.
    """

    rows: Rows
    slow: tuple[SlowRows, ...]
    smooth: Signals
    acts: FloatArray

    def freed(self, hypothesis: Hypothesis, channel: str) -> FloatArray | None:
        """A fault's slopes without the worst noise of a channel; None if they do not read it."""
        columns = [(hypothesis.distortion, k)
                   for k in range(len(hypothesis.distortion.parameters))]
        plain = fault_slopes(self.smooth, self.rows, columns)
        moved = self.smooth.with_values({channel: self.smooth[channel] + _STEP})
        reads = (fault_slopes(moved, self.rows, columns) - plain) / _STEP
        if not reads.any():
            return None
        return np.asarray(plain - reads * self._noise(channel)[:, :, None])

    def _noise(self, channel: str) -> FloatArray:
        """Noise of a channel under each bump, were it all that each identity leaves over."""
        shown, out = float(np.nanstd(self.smooth[channel])), np.zeros_like(self.rows.residual)
        for a, gain in enumerate(self.rows.gains_of(self.smooth, channel)):
            most = float(np.abs(gain).max(initial=0.0))
            if most > 0.0:
                noise = self.rows.residual[:, a] * gain / (gain**2 + (_WEAK * most) ** 2)
                size = float(np.sqrt(np.mean(noise[self.rows.valid[:, a]] ** 2)))
                out[:, a] = noise * min(1.0, shown / max(size, _TINY))
        return out


@dataclass(frozen=True, eq=False)
class _Left:
    """All recordings, and the unknowns of the solution with the chosen faults alone."""

    recordings: Sequence[_Recording]
    chosen: Sequence[Hypothesis]
    unknowns: Unknowns
    inflation: Mapping[str, float]

    @classmethod
    def of(cls, case: Case, chosen: Sequence[Hypothesis], taken: Sequence[Applied],
           inflation: Mapping[str, float]) -> _Left:  # fmt: skip
        """With the faults taken out of the log and the normal errors out of the residuals."""
        system = assemble(case, taken, [h.distortion for h in chosen])
        unknowns = unknowns_of(case, system.faults, chosen)
        estimate = solve(case, normal_equations(system, inflation), chosen)
        found = []
        for k, rows in enumerate(system.rows):
            if rows is None:
                continue
            is_baseline = case.is_baseline[k]
            clean = undone(case.signals[k], taken, baseline=is_baseline)
            acts = unknowns.in_baseline if is_baseline else unknowns.in_recordings
            normal = _normal(estimate, unknowns) * acts
            found.append(_Recording(
                _less(rows, unknowns, normal, acts),
                tuple(_less(s, unknowns, normal, acts) for s in system.slow[k]),
                smoothed_signals(clean, case.noise[k]), acts))
        return cls(found, chosen, unknowns, inflation)

    def made(self, which: int, amount: FloatArray) -> bool:
        """Whether some channel's noise makes more than half of the amount of one fault."""
        for channel in self._channels():
            found = self._without(which, channel)
            if found is not None:
                shift, precision = found
                if float(amount @ precision @ (0.5 * amount + shift)) < 0.0:
                    return True
        return False

    def _channels(self) -> list[str]:
        return sorted({c for r in self.recordings for i in r.rows.identities
                       for c in i.channels if c in r.smooth})  # fmt: skip

    def _without(self, which: int, channel: str) -> tuple[FloatArray, FloatArray] | None:
        """How far the amount moves, and its precision; None if its slopes do not read it."""
        own = self._own(which)
        size = self.unknowns.column.size
        gram, right = self.unknowns.prior.copy(), np.zeros(size)
        plain, any_freed = self.unknowns.prior.copy(), False
        for recording in self.recordings:
            freed = (recording.freed(self.chosen[which], channel)
                     if channel in recording.smooth else None)
            any_freed |= freed is not None
            for e, j, z in _whitened(recording, own, freed, self.inflation):
                gram += z.T @ j
                plain += j.T @ j
                right += z.T @ e
        if not any_freed:
            return None
        return (np.linalg.solve(gram, right)[own],
                np.linalg.inv(np.linalg.inv(plain)[own, own]))

    def _own(self, which: int) -> slice:
        sizes = [len(h.distortion.parameters) for h in self.chosen]
        start = self.unknowns.first_fault + sum(sizes[:which])
        return slice(start, start + sizes[which])


def _normal(estimate: Estimate, unknowns: Unknowns) -> FloatArray:
    """Normal errors as estimated, nothing for the faults, which were taken out."""
    usual = [estimate.usual]
    if unknowns.first_fault > estimate.usual.size:
        usual.append(estimate.usual_in_baseline)
    out = np.zeros(unknowns.column.size)
    out[:unknowns.first_fault] = np.concatenate(usual)
    return out


def _less(rows: _R, unknowns: Unknowns, normal: FloatArray, acts: FloatArray) -> _R:
    """Rows of the unknowns, without what normal errors explain."""
    slopes = rows.slopes[..., unknowns.column] * acts
    return replace(rows, residual=rows.residual - slopes @ normal, slopes=slopes)


def _whitened(
    recording: _Recording, own: slice, freed: FloatArray | None, inflation: Mapping[str, float]
) -> Iterator[tuple[FloatArray, FloatArray, FloatArray]]:
    """Residual, slopes and instruments of the whitened rows."""
    rows, count = recording.rows, recording.rows.slopes.shape[2]
    instead = rows.slopes[:, :, own] if freed is None else freed * recording.acts[own]
    rows = replace(rows, slopes=np.concatenate([rows.slopes, instead], axis=2))
    slow = [replace(s, slopes=np.concatenate([s.slopes, s.slopes[:, own]], axis=1))
            for s in recording.slow]
    for _, e, both in whitened_parts(rows, slow, inflation):
        slopes, instruments = both[:, :count], both[:, :count].copy()
        instruments[:, own] = both[:, count:]
        yield e, slopes, instruments

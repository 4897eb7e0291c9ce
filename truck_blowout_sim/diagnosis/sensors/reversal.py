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
from functools import cached_property
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.sensors.case import (
    Applied,
    Case,
    Hypothesis,
    undone,
    with_amounts,
)
from truck_blowout_sim.diagnosis.sensors.distortions import Distortion
from truck_blowout_sim.diagnosis.sensors.identities import with_kinematic_accelerations
from truck_blowout_sim.diagnosis.sensors.rows import (
    Rows,
    channel_gains,
    fault_slopes,
    smoothed_signals,
)
from truck_blowout_sim.diagnosis.sensors.signals import Signals
from truck_blowout_sim.diagnosis.sensors.slow import SlowRows
from truck_blowout_sim.diagnosis.sensors.solve import Unknowns, slices_of, solve, unknowns_of
from truck_blowout_sim.diagnosis.sensors.system import (
    assemble,
    normal_equations,
    whitened_parts,
)
from truck_blowout_sim.diagnosis.sensors.windows import make_windows

FloatArray = NDArray[np.float64]
_R = TypeVar("_R", Rows, SlowRows)
_Columns = Sequence[tuple[Distortion, int]]

_STEP = 1e-3
# where an identity reads a channel by less than this share of its most, noise there explains little
_WEAK = 0.05
_TINY = 1e-300


def made_by_noise(
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
    taken = with_amounts(chosen, amounts)
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

    def slopes(self, columns: _Columns) -> FloatArray:
        """Of a fault, by the regressors as they are, (bumps, identities, parameters)."""
        return fault_slopes(self.smooth, self.rows, columns)

    def freed(self, columns: _Columns, plain: FloatArray, channel: str) -> FloatArray | None:
        """A fault's slopes without the worst noise of a channel; None if they do not read it.

        ``plain``: with it.
        """
        if channel not in self.smooth:
            return None
        moved = self.smooth.with_values({channel: self.smooth[channel] + _STEP})
        reads = (fault_slopes(moved, self.rows, columns) - plain) / _STEP
        if not reads.any():
            return None
        return np.asarray(plain - reads * self._noise(channel)[:, :, None])

    @cached_property
    def _gains(self) -> list[dict[str, FloatArray]]:
        """By identity and channel, how an identity moves with the channel under each bump."""
        smooth = with_kinematic_accelerations(self.smooth)
        centres = make_windows(smooth.period_s).centres(smooth.time_s.size)
        return [{channel: gain[centres] for channel, gain in channel_gains(smooth, i).items()}
                for i in self.rows.identities]

    def _noise(self, channel: str) -> FloatArray:
        """Noise of a channel under each bump, were it all that each identity leaves over."""
        shown, out = float(np.nanstd(self.smooth[channel])), np.zeros_like(self.rows.residual)
        for a, gains in enumerate(self._gains):
            gain = gains.get(channel, np.zeros(1))
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
        errors = np.zeros(unknowns.column.size)  # nothing for the faults, which were taken out
        errors[:unknowns.first_fault] = estimate.normal_errors(unknowns)
        found = []
        for k, rows in enumerate(system.rows):
            if rows is None:
                continue
            is_baseline = case.is_baseline[k]
            clean = undone(case.signals[k], taken, baseline=is_baseline)
            acts = unknowns.in_baseline if is_baseline else unknowns.in_recordings
            found.append(_Recording(
                _less(rows, unknowns, errors, acts),
                tuple(_less(s, unknowns, errors, acts) for s in system.slow[k]),
                smoothed_signals(clean, case.noise[k]), acts))
        return cls(found, chosen, unknowns, inflation)

    def made(self, which: int, amount: FloatArray) -> bool:
        """Whether some channel's noise makes more than half of the amount of one fault."""
        own, fault = self._own[which], self.chosen[which].distortion
        columns = [(fault, k) for k in range(len(fault.parameters))]
        plain = [one.slopes(columns) for one in self.recordings]
        precision = np.linalg.inv(np.linalg.inv(self._gram)[own, own])
        for channel in self._channels:
            freed = [one.freed(columns, slopes, channel)
                     for one, slopes in zip(self.recordings, plain, strict=True)]
            if any(one is not None for one in freed) and float(
                    amount @ precision @ (0.5 * amount + self._shift(own, freed))) < 0.0:
                return True
        return False

    @cached_property
    def _channels(self) -> list[str]:
        return sorted({c for r in self.recordings for i in r.rows.identities
                       for c in i.channels if c in r.smooth})  # fmt: skip

    @cached_property
    def _own(self) -> list[slice]:
        return slices_of(self.chosen, self.unknowns.first_fault)

    @cached_property
    def _gram(self) -> FloatArray:
        """Sums of squares and products of the slopes, priors included."""
        return np.asarray(self.unknowns.prior + sum(
            j.T @ j for one in self.recordings
            for _, _, j in whitened_parts(one.rows, one.slow, self.inflation)))

    def _shift(self, own: slice, freed: Sequence[FloatArray | None]) -> FloatArray:
        """How far the amount of a fault moves with freed slopes as instruments."""
        gram, right = self.unknowns.prior.copy(), np.zeros(self.unknowns.column.size)
        for recording, instead in zip(self.recordings, freed, strict=True):
            for e, j, z in _whitened(recording, own, instead, self.inflation):
                gram += z.T @ j
                right += z.T @ e
        return np.asarray(np.linalg.solve(gram, right)[own])


def _less(rows: _R, unknowns: Unknowns, errors: FloatArray, acts: FloatArray) -> _R:
    """Rows of the unknowns, without what normal errors explain."""
    slopes = rows.slopes[..., unknowns.column] * acts
    return replace(rows, residual=rows.residual - slopes @ errors, slopes=slopes)


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

"""Least squares with priors on sums of squares, and how much noise the identities really have.

Validated with: test/diagnosis/test_sensors_solve.py.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve

from truck_blowout_sim.diagnosis.sensors.case import Case, Hypothesis, with_amounts
from truck_blowout_sim.diagnosis.sensors.distortions import Distortion
from truck_blowout_sim.diagnosis.sensors.judgement import farthest
from truck_blowout_sim.diagnosis.sensors.rows import Rows
from truck_blowout_sim.diagnosis.sensors.system import Normal, System, assemble, normal_equations

FloatArray = NDArray[np.float64]

# How large a fault of each kind could conceivably be; keeps undetermined directions finite.
_CONCEIVABLE = {"rad/s": 0.1, "1": 1.0, "s": 0.5, "m": 3.0}
# Correlation of a normal error between the baseline runs and the others: it may change by its
# own size from one day to the next.
_REPEATS = 0.5
_STEPS = 6
_CONVERGED = 0.02  # of the parameter's own standard error
_BLOCK = 10  # bumps of a block mean that shows coloured misfit


@dataclass(frozen=True)
class Estimate:
    """Solution for one set of hypotheses.

    Attributes:
        chi2: penalised sum of squares that is left.
        amounts: of each hypothesis.
        covariance: of all amounts, in order.
        usual: estimates of the normal imperfections.
        usual_in_baseline: the same in the baseline recordings.
        usual_sigma: standard errors of ``usual``.
    """

    chi2: float
    amounts: tuple[tuple[float, ...], ...]
    covariance: FloatArray
    usual: FloatArray
    usual_in_baseline: FloatArray
    usual_sigma: FloatArray

    def normal_errors(self, unknowns: Unknowns) -> FloatArray:
        """Those of the recordings, and of the baseline if any, in the order of the unknowns."""
        if unknowns.first_fault > self.usual.size:
            return np.concatenate([self.usual, self.usual_in_baseline])
        return self.usual


def solve(case: Case, normal: Normal, hypotheses: Sequence[Hypothesis]) -> Estimate:
    """Estimate amounts of the given faults together with all normal imperfections.

    Args:
        case: names the columns.
        normal: sums of squares.
        hypotheses: faults allowed, without priors.
    """
    unknowns = unknowns_of(case, normal.faults, hypotheses)
    index = unknowns.column
    gram = gram_of(normal, unknowns)
    right = (normal.right[0][index] * unknowns.in_recordings
             + normal.right[1][index] * unknowns.in_baseline)  # fmt: skip
    factor = cho_factor(gram, lower=True)
    solution = cho_solve(factor, right)
    inverse = cho_solve(factor, np.eye(index.size))
    usual, first = case.prior_precision.size, unknowns.first_fault
    amounts = [tuple(float(v) for v in solution[own]) for own in slices_of(hypotheses, first)]
    return Estimate(
        chi2=normal.energy - float(right @ solution),
        amounts=tuple(amounts),
        covariance=inverse[first:, first:],
        usual=solution[:usual],
        usual_in_baseline=solution[first - usual : first],
        usual_sigma=np.sqrt(np.diag(inverse)[:usual]),
    )


def gram_of(normal: Normal, unknowns: Unknowns) -> FloatArray:
    """Sums of squares and products of the unknowns' columns, priors included."""
    gram, at = unknowns.prior.copy(), np.ix_(unknowns.column, unknowns.column)
    for own, acts in zip(normal.gram, (unknowns.in_recordings, unknowns.in_baseline), strict=True):
        gram += own[at] * np.outer(acts, acts)
    return gram


def refine(
    case: Case, hypotheses: Sequence[Hypothesis], inflation: Mapping[str, float],
    start: Sequence[tuple[float, ...]] | None = None,
) -> Estimate:  # fmt: skip
    """Gauss-Newton: take the faults out, estimate what is left of them, repeat.

    Returns:
        The estimate; amounts in full, not increments.
    """
    amounts: list[FloatArray] = [np.zeros(len(h.distortion.parameters)) for h in hypotheses]
    if start is not None:
        amounts = [_held(h, np.array(s)) for h, s in zip(hypotheses, start, strict=True)]
    for _ in range(_STEPS):
        taken = with_amounts(hypotheses, amounts)
        system = assemble(case, taken, [h.distortion for h in hypotheses])
        estimate = solve(case, normal_equations(system, inflation), hypotheses)
        steps = [np.array(step) for step in estimate.amounts]
        amounts = [_held(h, a + h.distortion.grown(a) * step)
                   for h, a, step in zip(hypotheses, amounts, steps, strict=True)]
        sigma = np.sqrt(np.diag(estimate.covariance))
        if not hypotheses or np.all(np.abs(np.concatenate(steps)) <= _CONVERGED * sigma):
            break
    full = tuple(tuple(float(v) for v in a) for a in amounts)
    return replace(estimate, amounts=full, covariance=in_full(hypotheses, full, estimate))


def in_full(hypotheses: Sequence[Hypothesis], amounts: Sequence[tuple[float, ...]],
            estimate: Estimate) -> FloatArray:
    """Covariance of amounts in full, of which the estimate has the last step."""
    grown = np.concatenate([h.distortion.grown(np.array(a))
                            for h, a in zip(hypotheses, amounts, strict=True)] or [np.zeros(0)])
    return estimate.covariance * np.outer(grown, grown)


def _held(hypothesis: Hypothesis, amounts: FloatArray) -> FloatArray:
    """Amounts kept within what an instrument can do."""
    limits = farthest(hypothesis)
    return np.asarray(np.clip(amounts, -limits, limits), dtype=np.float64)


def noise_inflation(system: System) -> dict[str, float]:
    """Factor by which each identity scatters more than its channels' noise explains.

    Every candidate fault may act at once here, so a fault does not count as noise; what remains
    is the identity's own misfit. Block means of a second catch misfit that is coloured.
    """
    inflation: dict[str, float] = {}
    both = list(system.case.hypotheses)
    for _ in range(2):
        normal = normal_equations(system, inflation)
        estimate = solve(system.case, normal, both)
        inflation = _scatter(system, both, estimate)
    return inflation


@dataclass(frozen=True)
class Unknowns:
    """Unknowns of one solution: normal errors, those of the baseline if any, then faults."""

    column: NDArray[np.int64]
    in_recordings: FloatArray
    in_baseline: FloatArray
    prior: FloatArray
    first_fault: int


def unknowns_of(
    case: Case, faults: Sequence[Distortion], hypotheses: Sequence[Hypothesis]
) -> Unknowns:
    """Where each unknown's column is, where it acts, and what is known of it beforehand."""
    usual = case.prior_precision
    groups = 2 if any(case.is_baseline) else 1
    start, at = {}, usual.size
    for fault in faults:
        start[fault] = at
        at += len(fault.parameters)
    column = list(range(usual.size)) * groups
    everywhere, conceivable = [], []
    for hypothesis in hypotheses:
        for j, (_, si_unit) in enumerate(hypothesis.distortion.parameters):
            column.append(start[hypothesis.distortion] + j)
            everywhere.append(1.0 if hypothesis.everywhere else 0.0)
            conceivable.append(1.0 / _CONCEIVABLE[si_unit] ** 2)
    own = np.ones(usual.size)
    first = groups * usual.size
    prior = np.diag(np.concatenate([np.zeros(first), conceivable]))
    between = np.linalg.inv(np.array([[1.0, _REPEATS], [_REPEATS, 1.0]])) if groups == 2 else [[1]]
    prior[:first, :first] = np.kron(between, np.diag(usual))
    return Unknowns(
        column=np.array(column),
        in_recordings=np.concatenate(
            [own, *([0.0 * own] * (groups - 1)), np.ones(len(everywhere))]
        ),
        in_baseline=np.concatenate([*([0.0 * own] * (groups - 1)), own, everywhere]),
        prior=prior,
        first_fault=first,
    )


def slices_of(hypotheses: Sequence[Hypothesis], first: int = 0) -> list[slice]:
    """Unknowns of each fault, where those of the first begin at ``first``."""
    ends = first + np.cumsum([0, *(len(h.distortion.parameters) for h in hypotheses)])
    return [slice(*both) for both in pairwise(ends.tolist())]


def _scatter(
    system: System, hypotheses: Sequence[Hypothesis], estimate: Estimate
) -> dict[str, float]:
    total: dict[str, list[FloatArray]] = {}
    blocks: dict[str, list[FloatArray]] = {}
    unknowns = unknowns_of(system.case, system.faults, hypotheses)
    amounts = [np.array(a) for a in estimate.amounts]
    theta = np.concatenate([estimate.normal_errors(unknowns), *amounts])
    for rows, is_baseline in zip(system.rows, system.case.is_baseline, strict=True):
        if rows is None:
            continue
        active = theta * (unknowns.in_baseline if is_baseline else unknowns.in_recordings)
        left = rows.residual - rows.slopes[:, :, unknowns.column] @ active
        variance = rows.variance
        block_variance = _block_variance(rows)
        for a, identity in enumerate(rows.identities):
            valid = rows.valid[:, a]
            if valid.sum() < 2 * _BLOCK:
                continue
            total.setdefault(identity.name, []).append(left[valid, a] ** 2 / variance[valid, a])
            z = _block_means(left[:, a], valid)
            blocks.setdefault(identity.name, []).append(z**2 / block_variance[a])
    out = {}
    for name, values in total.items():
        square = float(np.mean(np.concatenate(values)))
        slow = np.concatenate(blocks[name])
        if slow.size >= 8:
            square = max(square, float(np.mean(slow)) * (1.0 - 2.0 / np.sqrt(slow.size)))
        out[name] = float(np.sqrt(max(1.0, square)))
    return out


def _block_variance(rows: Rows) -> FloatArray:
    """Variance of the mean of consecutive rows of each identity."""
    out = np.zeros(len(rows.identities))
    for lag, block in enumerate(rows.blocks):
        both = rows.valid[: block.shape[0]] & rows.valid[lag:]
        own = np.where(both, np.einsum("kaa->ka", block), np.nan)
        for a in np.flatnonzero(both.any(axis=0)):
            out[a] += (1.0 if lag == 0 else 2.0) * (_BLOCK - lag) * float(np.nanmedian(own[:, a]))
    return np.asarray(np.maximum(out / _BLOCK**2, 1e-30))


def _block_means(left: FloatArray, valid: NDArray[np.bool_]) -> FloatArray:
    count = left.size // _BLOCK
    cut = slice(0, count * _BLOCK)
    whole = valid[cut].reshape(count, _BLOCK).all(axis=1)
    return np.asarray(left[cut].reshape(count, _BLOCK).mean(axis=1)[whole])

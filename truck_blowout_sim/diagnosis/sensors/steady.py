"""Whether a fault shows alike in every part of the log, or its amount wanders from part to part.

A channel's noise is measured where the log is quiet; what colors and drifts over seconds is not
seen there. So an amount is taken apart into what each stretch of five seconds says of it,
``u_b = A J_b'(e_b - J_b a)`` with ``a = A J'e``, and its covariance is learned from these parts,

    V_own = n/(n-1) sum_b u_b u_b' ,   n = (sum w)^2 / sum w^2  stretches that carry information.

A few stretches tell it badly. How far such a figure goes astray in this log, all candidates tell
together: their ratios of V_own over V_rows scatter as ``s^2 F(n, m)``. So

    V = V_prior + (m s^2 V_rows + n V_own) / (m + n) ,   a' V^-1 a / k ~ F(k, m + n - k) ,

with the modeled covariance V_rows + V_prior: what noise of the rows and what normal errors make.

The rows are first freed of what their own past foretells, so that neither a memory of seconds nor a
tone that all channels hear passes for a fault. In long logs the stretches are also taken 4 and 16
times as long, and the largest chance counts: an instrument may drift over minutes. And the amount
must stand out both where it was taken out and at none, by the slopes there: a late fit of a noisy
channel is steep wherever it ends.

A log whose noise is as modeled has many degrees of freedom m, and the model stands; a rough log has
few, and only what its stretches agree on counts. A fault is stated where chance reaches this in
less than the rate of false alarms among all independent candidates.

References: Liang and Zeger, Biometrika 73 (1986) 13-22 (covariance from clusters); Smyth, Stat.
Appl. Genet. Mol. Biol. 3 (2004) 3 (variances moderated by those of all questions; his equations for
m and s are used); Li and Ji, Heredity 95 (2005) 221-227 (independent among correlated candidates);
Cochrane and Orcutt 1949 (least squares with autoregressive errors); Rao 1948 (score test).
Known limits: an error that is alike in all stretches (a noisy channel that is its own regressor, a
zero that drifted away and stays) passes; in a rough log, a fault that shows in one stretch alone
does not.
Validated with: test/diagnosis/test_sensors_steady.py.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq
from scipy.special import polygamma, psi
from scipy.stats import f as f_law

from truck_blowout_sim.diagnosis.algebra.color import Color, autocovariance
from truck_blowout_sim.diagnosis.algebra.independent import independent_among
from truck_blowout_sim.diagnosis.sensors.case import Applied, Case, Hypothesis, with_amounts
from truck_blowout_sim.diagnosis.sensors.solve import Unknowns, gram_of, slices_of, unknowns_of
from truck_blowout_sim.diagnosis.sensors.system import (
    Normal,
    System,
    assemble,
    whitened_parts,
)

FloatArray = NDArray[np.float64]

# Longer than what instruments remember (0.05 to 2 s), short enough for a few in each run.
_STRETCH_S = 5.0
_REMEMBERS = 20  # bumps of 0.1 s: as far back as a row is foretold from
_ROWS_A_LAG = 20  # rows, as many at least for each lag
_TIMES = (4, 16)  # stretches of long logs are longer, too: an instrument may drift over minutes
_ENOUGH = 6  # stretches
_FEWEST = 1.5  # stretches that carry a figure before its scatter says anything
_CERTAIN = 1e6  # degrees of freedom of a variance that is known
_LEAST = 1e-2
_SEEN = 1e-10  # of its own sum of squares must be left of a column beside the others


@dataclass(frozen=True)
class Usual:
    """How far covariances from stretches lie from the modeled one in this log.

    Attributes:
        factor: variance over what the noise of the rows makes, at least 1.
        degrees: of freedom, ``m``.
    """

    factor: float
    degrees: float


@dataclass(frozen=True, eq=False)
class _Rows:
    """Whitened rows of all recordings, each with the stretch that it lies in.

    Attributes:
        left: of each row; ``slopes``: [rows, unknowns].
        key: [rows, 2] recording, and number of the stretch in it; ``stretch``: number in all.
        series: rows of each identity in each recording, by the identity's name.
    """

    left: FloatArray
    slopes: FloatArray
    key: NDArray[np.int64]
    series: Mapping[str, Sequence[NDArray[np.int64]]]

    @cached_property
    def stretch(self) -> NDArray[np.int64]:
        """Number of each row's stretch, over all recordings."""
        return np.asarray(np.unique(self.key, axis=0, return_inverse=True)[1].ravel())

    @property
    def many(self) -> bool:
        """Whether the stretches are enough to show how an amount drifts."""
        return int(self.stretch.max()) >= _ENOUGH - 1

    def grouped(self, times: int) -> _Rows:
        """The same rows in stretches so many times as long."""
        return replace(self, key=self.key // np.array([1, times]))

    def whitened(self, noise: FloatArray) -> _Rows:
        """The same rows, with what the color of ``noise`` lets foretell taken out.

        Instruments that remember and tones that all of them hear look like faults otherwise.
        """
        left, slopes = self.left.copy(), self.slopes.copy()
        for parts in self.series.values():
            color = color_of([noise[part] for part in parts])
            for part in parts:
                left[part] = color.whitened(left[part][:, None])[:, 0]
                slopes[part] = color.whitened(slopes[part][:, None])[:, 0]
        return replace(self, left=left, slopes=slopes)

    def sums(self, values: FloatArray) -> FloatArray:
        """Sums over each stretch, (stretches, ...)."""
        out = np.zeros((int(self.stretch.max()) + 1, *values.shape[1:]))
        np.add.at(out, self.stretch, values)
        return out


def chances(
    case: Case, chosen: Sequence[Hypothesis], amounts: Sequence[Sequence[float]],
    inflation: Mapping[str, float],
) -> list[float]:  # fmt: skip
    """For each chosen fault the chance that its scatter over the log alone makes its amount.

    Args:
        case: the recordings.
        chosen: accepted faults.
        amounts: of each, as estimated, in full.
        inflation: factor on the noise of each identity.
    """
    if not chosen:
        return []
    taken = with_amounts(chosen, amounts)
    fitted, found = _Fit.of(case, chosen, taken, inflation), []
    for k, amount in enumerate(amounts):
        none = _Fit.of(case, chosen, [*taken[:k], *taken[k + 1:]], inflation)
        found.append(max(fitted.chance(k, np.array(amount)),
                         none.chance(k, np.zeros(len(amount)))))
    return found


@dataclass(frozen=True, eq=False)
class _Fit:
    """The chosen faults beside the normal errors, by the slopes of a log as it was cleaned.

    Attributes:
        rows: freed of color, in stretches of each length that the log has enough of, with how far
            covariances lie from the modeled one there.
        slopes: of the unknowns; ``inverse``: of their sums of squares.
        away: each unknown as estimated, from what was taken out; ``left``: what they leave over.
        own: unknowns of each chosen fault.
    """

    rows: Sequence[tuple[_Rows, Usual]]
    slopes: FloatArray
    inverse: FloatArray
    away: FloatArray
    left: FloatArray
    own: Sequence[slice]

    @staticmethod
    def of(case: Case, chosen: Sequence[Hypothesis], taken: Sequence[Applied],
           inflation: Mapping[str, float]) -> _Fit:  # fmt: skip
        """With the given faults taken out of the log."""
        system = assemble(case, taken)
        every = unknowns_of(case, system.faults, case.hypotheses)
        rows = _rows(system, every, inflation)
        gram = every.prior + rows.slopes.T @ rows.slopes
        rows = rows.whitened(
            rows.left - rows.slopes @ np.linalg.solve(gram, rows.slopes.T @ rows.left))
        gram = every.prior + rows.slopes.T @ rows.slopes
        kept = _columns_of(case, chosen, every)
        inverse = np.linalg.inv(gram[np.ix_(kept, kept)])
        slopes = rows.slopes[:, kept]
        away = inverse @ (slopes.T @ rows.left)
        left = rows.left - slopes @ away
        longer = (rows.grouped(times) for times in _TIMES)
        return _Fit([(one, _usual(one, gram, kept, inverse, left))
                     for one in (rows, *(one for one in longer if one.many))],
                    slopes, inverse, away, left, slices_of(chosen, every.first_fault))

    def chance(self, which: int, start: FloatArray) -> float:
        """Of one fault's amount; ``start``: what was taken out of it."""
        own = self.own[which]
        weight, model = self.slopes @ self.inverse[:, own], self.inverse[own, own]
        return max(_chance(rows, weight, self.left, model, start + self.away[own], usual)
                   for rows, usual in self.rows)


def _chance(
    rows: _Rows, weight: FloatArray, left: FloatArray, model: FloatArray, amount: FloatArray,
    usual: Usual,
) -> float:  # fmt: skip
    size = amount.size
    says = rows.sums(weight * left[:, None])
    share = (rows.sums(weight**2) / np.diag(model)).sum(axis=1)
    count = float(share.sum() ** 2 / np.sum(share**2))
    degrees = usual.degrees + count - size
    if degrees <= _LEAST:
        return 1.0
    own = count / max(count - 1.0, _LEAST) * says.T @ says
    by_rows = weight.T @ weight
    covariance = model - by_rows + (
        usual.degrees * usual.factor * by_rows + count * own) / (usual.degrees + count)
    return float(f_law.sf(amount @ np.linalg.solve(covariance, amount) / size, size, degrees))


def _usual(
    rows: _Rows, gram: FloatArray, kept: list[int], inside: FloatArray, left: FloatArray
) -> Usual:
    """Scatter of every candidate's figure from stretch to stretch, each beside those kept.

    ``inside`` is the inverse of the kept columns' sums of squares, ``left`` what they leave over.
    """
    others = [k for k in range(gram.shape[0]) if k not in kept]
    free = rows.slopes[:, others] - rows.slopes[:, kept] @ (inside @ gram[np.ix_(kept, others)])
    own = np.diag(gram)[others]
    square = own - np.einsum("ij,jk,ki->i", gram[np.ix_(others, kept)], inside,
                             gram[np.ix_(kept, others)])  # fmt: skip
    seen = square > _SEEN * own
    free, square = free[:, seen], square[seen]
    amount = free.T @ left / square
    says = rows.sums(free * (left[:, None] - free * amount))
    share = rows.sums(free**2)
    count = share.sum(axis=0) ** 2 / np.maximum(np.sum(share**2, axis=0), 1e-300)
    tells = count > _FEWEST
    degrees = count[tells] - 1.0
    ratio = (says[:, tells]**2).sum(axis=0) / share[:, tells].sum(axis=0) * count[tells] / degrees
    return moderated(ratio, degrees)


def moderated(ratio: FloatArray, degrees: FloatArray) -> Usual:
    """Factor and degrees of freedom that ratios of variances have in common (Smyth 2004, 6.2).

    Args:
        ratio: estimated over modeled variances.
        degrees: of freedom of each.
    """
    ratio, degrees = ratio[ratio > 0.0], degrees[ratio > 0.0]
    if ratio.size < 2:
        return Usual(1.0, _CERTAIN)
    logs = np.log(ratio) - psi(degrees / 2.0) + np.log(degrees / 2.0)
    spread = float(np.var(logs, ddof=1) - np.mean(polygamma(1, degrees / 2.0)))
    m = _CERTAIN
    if spread > float(polygamma(1, _CERTAIN / 2.0)):
        m = 2.0 * float(brentq(lambda x: polygamma(1, x) - spread, 1e-3, _CERTAIN))
    factor = float(np.exp(np.mean(logs) + psi(m / 2.0) - np.log(m / 2.0)))
    return Usual(max(factor, 1.0), m)


def color_of(series: Sequence[FloatArray]) -> Color:
    """Autoregression of a noise seen in several pieces, as long as it pays (Akaike 1974)."""
    count = sum(one.size for one in series)
    lags = min(_REMEMBERS, count // _ROWS_A_LAG)
    covariance = np.sum([autocovariance(one, lags) for one in series], axis=0)
    if covariance[0] <= 0.0:
        return Color.white(1)
    covariance = covariance / covariance[0]
    surprise = Color.of(covariance[None]).surprise[0]
    order = int(np.argmin(2.0 * count * np.log(surprise) + 2.0 * np.arange(lags + 1)))
    return Color.of(covariance[None, :order + 1])


def _columns_of(case: Case, chosen: Sequence[Hypothesis], every: Unknowns) -> list[int]:
    """Unknowns of a solution with the chosen faults alone, among those with all candidates."""
    first, columns = every.first_fault, range(every.column.size)
    own = dict(zip(case.hypotheses, slices_of(case.hypotheses, first), strict=True))
    return [*columns[:first], *(k for one in chosen for k in columns[own[one]])]


def _rows(system: System, unknowns: Unknowns, inflation: Mapping[str, float]) -> _Rows:
    residuals, slopes, keys = [], [], []
    series: dict[str, list[NDArray[np.int64]]] = {}
    for k, is_baseline in enumerate(system.case.is_baseline):
        acts = unknowns.in_baseline if is_baseline else unknowns.in_recordings
        for time_s, e, j in whitened_parts(system.rows[k], system.slow[k], inflation):
            residuals.append(e)
            slopes.append(j[:, unknowns.column] * acts)
            keys += [(k, int(number)) for number in time_s // _STRETCH_S]
        rows = system.rows[k]
        if rows is not None:  # the last part
            first, width = len(keys) - rows.residual.size, len(rows.identities)
            for a, identity in enumerate(rows.identities):
                series.setdefault(identity.name, []).append(
                    np.arange(first + a, len(keys), width, dtype=np.int64))
    return _Rows(np.concatenate(residuals), np.concatenate(slopes), np.array(keys), series)


def independent_candidates(case: Case, normal: Normal) -> float:
    """How many independent questions the candidates ask, normal imperfections taken out."""
    unknowns = unknowns_of(case, normal.faults, case.hypotheses)
    gram = gram_of(normal, unknowns)
    first = unknowns.first_fault
    usual = gram[:first, :first]
    own = gram[first:, first:] - gram[first:, :first] @ np.linalg.solve(usual, gram[:first, first:])
    return min(independent_among(own), float(len(case.hypotheses)))

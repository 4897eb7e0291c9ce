"""How visible an effect is in a world: sigma_b = (s' C^-1 s)^1/2, measured on nulls of that world.

s is the effect's signature in all recorded channels of all training runs, zero in baseline runs; C
the covariance of nulls on the same commands, baseline and training together, so that what a
baseline run shows of a truck is known in training too. It has three parts:

- what trucks differ by on an even road, shrunk towards its diagonal in time and frequency
  (variances smoothed over neighbouring frequencies); how far, is chosen by the likelihood of trucks
  left out;
- what a road of its own changes of each: bumps shake all channels at once, so at each frequency the
  channels have a covariance, but frequencies and runs have none;
- what instruments and logger of the case add (`reading_noise.py`).

The figure returned is the separation of that linear detector as *measured* on trucks left out, each
on its own road: s'w over the spread of w'r, instruments' noise included.

References: O. Ledoit, M. Wolf, J. Multivariate Analysis 88 (2004) 365-411 (shrinkage).
Known limits: one run stands for its class of manoeuvres; linear detectors; identities between
channels are only seen as far as the shrinkage leaves them, so faults of instruments are not given.
Validated with: test/proving_ground/test_sigma_b.py.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.ndimage import uniform_filter1d

from proving_ground.layout import FloatArray

SHRINKAGES = (0.02, 0.05, 0.1, 0.2, 0.4, 0.7)
FOLDS = 5
SMOOTH = 9
TINY = 1e-300   # power of a signature that is none


@dataclass(frozen=True)
class Stack:
    """Runs one behind the other, of fault-free trucks on the same commands.

    Attributes:
        even: [trucks, all] what trucks differ by on an even road; ``roads``: what a road of its own
            changes of each.
        noise: [all] variance of the instruments.
        shapes: channels and coefficients of each run.
    """

    even: FloatArray
    roads: FloatArray
    noise: FloatArray
    shapes: tuple[tuple[int, int], ...]

    def runs(self, rows: FloatArray) -> Iterator[FloatArray]:
        """Of rows [k, all] each run's part, [k, channels, coefficients]."""
        at = 0
        for channels, count in self.shapes:
            yield rows[:, at:at + channels * count].reshape(len(rows), channels, count)
            at += channels * count

    def target(self, rows: FloatArray) -> FloatArray:
        """Variances, smoothed over neighbouring frequencies of a channel."""
        return np.concatenate([_smooth(part.var(axis=0, ddof=1)).ravel()
                               for part in self.runs(rows)])

    def bumps(self, rows: FloatArray) -> list[FloatArray]:
        """Of each run the covariances of its channels, [coefficients, channels, channels].

        Bumps shake all channels at once, and every run anew.
        """
        return [np.moveaxis(_smooth(np.einsum("tik,tjk->ijk", part, part) / len(part)), 2, 0)
                for part in self.runs(rows)]


def _smooth(values: FloatArray) -> FloatArray:
    """Means over neighbouring frequencies, the last axis."""
    return np.asarray(uniform_filter1d(values, SMOOTH, axis=-1, mode="nearest"))


class Detector:
    """The linear detector of a stack of runs, of each signature alike."""

    def __init__(self, stack: Stack) -> None:
        self.stack, self.trucks = stack, len(stack.even)
        even, roads = (rows - rows.mean(axis=0) for rows in (stack.even, stack.roads))
        folds = [np.arange(self.trucks) % FOLDS == k for k in range(FOLDS)]
        bumps = [stack.bumps(roads[~fold]) for fold in folds]
        first = folds[0]     # shares hardly differ from fold to fold, and each fit takes long
        share = max(SHRINKAGES, key=lambda s: _fit(
            stack, even[~first], bumps[0], s).likelihood(even[first] + roads[first]))
        self.parts = [(even[fold] + roads[fold], _fit(stack, even[~fold], shaken, share))
                      for fold, shaken in zip(folds, bumps, strict=True)]

    def amount(self, signature: FloatArray, of: FloatArray) -> float:
        """How much `of` another signature explains this one best, mean over the folds."""
        shares = []
        for _, fit in self.parts:
            weight = fit.solve(of)
            shares.append(float(signature @ weight) / max(float(of @ weight), TINY))
        return float(np.mean(shares))

    def separation(self, signature: FloatArray, beside: FloatArray | None = None) -> float:
        """sigma_b of a signature, measured on trucks left out.

        Where another signature may be there, too, in any amount (`beside`): of what it leaves.
        """
        signal, spread = 0.0, 0.0
        for left_out, fit in self.parts:
            weight = fit.solve(signature)
            if beside is not None:
                other = fit.solve(beside)
                weight = weight - other * (float(beside @ weight) / max(float(beside @ other),
                                                                        TINY))
            scale = float(signature @ weight)
            if scale <= 0.0:
                continue
            weight = weight / np.sqrt(scale)
            signal += float(signature @ weight) / FOLDS
            spread += (float(np.sum((left_out @ weight) ** 2)) / self.trucks
                       + float(weight**2 @ self.stack.noise) / FOLDS)
        return float(signal / np.sqrt(spread)) if spread > 0.0 else 0.0


@dataclass(frozen=True)
class _Covariance:
    """blocks + low' low, by the matrix inversion lemma; a block a run and coefficient."""

    stack: Stack
    inverses: list[FloatArray]     # of each run, coefficients x channels x channels
    low: FloatArray                # few x all
    inner: FloatArray              # inverse of 1 + low blocks^-1 low'
    logdet: float

    def solve(self, vector: FloatArray) -> FloatArray:
        plain = _blockwise(self.stack, self.inverses, vector[None])[0]
        behind = self.low.T @ (self.inner @ (self.low @ plain))
        return np.asarray(plain - _blockwise(self.stack, self.inverses, behind[None])[0])

    def likelihood(self, rows: FloatArray) -> float:
        return float(sum(-0.5 * (row @ self.solve(row)) - 0.5 * self.logdet for row in rows))


def _blockwise(stack: Stack, blocks: list[FloatArray], rows: FloatArray) -> FloatArray:
    """Rows [k, all], each run and coefficient multiplied by its block."""
    return np.concatenate([np.einsum("kij,tjk->tik", block, part).reshape(len(rows), -1)
                           for block, part in zip(blocks, stack.runs(rows), strict=True)], axis=1)


def _fit(stack: Stack, rows: FloatArray, bumps: list[FloatArray], share: float) -> _Covariance:
    plain = (stack.noise + share * stack.target(rows))[None]
    inverses, logdet = [], 0.0
    for shaken, part in zip(bumps, stack.runs(plain), strict=True):
        block = shaken + np.eye(part.shape[1]) * part[0].T[:, :, None]
        inverses.append(np.linalg.inv(block))
        logdet += float(np.linalg.slogdet(block)[1].sum())
    low = np.sqrt((1.0 - share) / (len(rows) - 1.0)) * rows
    gram = np.eye(len(rows)) + low @ _blockwise(stack, inverses, low).T
    return _Covariance(stack, inverses, low, np.linalg.inv(gram),
                       logdet + float(np.linalg.slogdet(gram)[1]))

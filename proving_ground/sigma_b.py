"""How visible an effect is in a world: sigma_b = (s' C^-1 s)^1/2, measured on nulls of that world.

s is the effect's signature in all recorded channels of all training runs, zero in baseline runs; C
the covariance of nulls on the same commands, baseline and training together, so that what a
baseline run shows of a truck is known in training too. C is shrunk towards its diagonal in time and
frequency (variances smoothed over neighbouring frequencies); how far, is chosen by the likelihood
of trucks left out. The figure returned is the separation of that linear detector as *measured* on
trucks left out: s'w over the spread of w'r, instruments' noise included.

References: O. Ledoit, M. Wolf, J. Multivariate Analysis 88 (2004) 365-411 (shrinkage).
Known limits: one run stands for its class of manoeuvres; linear detectors; identities between
channels are only seen as far as the shrinkage leaves them, so faults of instruments are not given.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from proving_ground.detect import constant_sigma
from proving_ground.instruments import noise_of
from proving_ground.layout import FloatArray
from proving_ground.roughness import Roughness

SHRINKAGES = (0.02, 0.05, 0.1, 0.2, 0.4, 0.7)
FOLDS = 5
SMOOTH = 9
TINY = 1e-300   # power of a signature that is none


@dataclass(frozen=True)
class Stack:
    """Runs one behind the other: nulls (trucks x all), noise variance (all)."""

    nulls: FloatArray
    noise: FloatArray
    shapes: tuple[tuple[int, int], ...]        # channels, coefficients of each run

    def target(self, rows: FloatArray) -> FloatArray:
        """Variances of nulls, smoothed over neighbouring frequencies of a channel."""
        raw, out, at = rows.var(axis=0, ddof=1), [], 0
        kernel = np.ones(SMOOTH) / SMOOTH
        for channels, count in self.shapes:
            block = raw[at:at + channels * count].reshape(channels, count)
            padded = np.pad(block, ((0, 0), (SMOOTH // 2, SMOOTH // 2)), mode="edge")
            out.append(np.array([np.convolve(row, kernel, "valid") for row in padded]).ravel())
            at += channels * count
        return np.concatenate(out)


def noise_variance(channel: str, level: float, count: int, duration_s: float,
                   rough: Roughness | None = None) -> FloatArray:
    """Variance of each cosine coefficient from the instrument: white, a constant, rough colour."""
    noise = noise_of(channel)
    white = noise.sigma**2 + (noise.relative * level) ** 2 + noise.quantum**2 / 12.0
    out = np.full(count, white)
    out[0] += duration_s * 100.0 * constant_sigma(channel) ** 2
    if rough is not None:
        keep = np.exp(-1.0 / (100.0 * rough.memory_s))
        turn = np.pi * np.arange(count) / (duration_s * 100.0)
        colour = (1.0 - keep**2) / (1.0 - 2.0 * keep * np.cos(turn) + keep**2)
        out += white * rough.noise**2 * colour + white * rough.rounding**2 / 12.0
    return np.asarray(out)


class Detector:
    """The linear detector of a stack of runs, of each signature alike."""

    def __init__(self, stack: Stack) -> None:
        self.stack, self.trucks = stack, len(stack.nulls)
        rows = stack.nulls - stack.nulls.mean(axis=0)
        folds = [np.arange(self.trucks) % FOLDS == k for k in range(FOLDS)]
        share = max(SHRINKAGES, key=lambda s: sum(
            _fit(stack, rows[~fold], s).likelihood(rows[fold]) for fold in folds))
        self.parts = [(rows[fold], _fit(stack, rows[~fold], share)) for fold in folds]

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
    """diagonal + low' low, by the matrix inversion lemma."""

    diagonal: FloatArray
    low: FloatArray                # few x all
    inner: FloatArray              # inverse of 1 + low diagonal^-1 low'
    logdet: float

    def solve(self, vector: FloatArray) -> FloatArray:
        plain = vector / self.diagonal
        return np.asarray(plain - (self.low.T @ (self.inner @ (self.low @ plain)))
                          / self.diagonal)

    def likelihood(self, rows: FloatArray) -> float:
        return float(sum(-0.5 * (row @ self.solve(row)) - 0.5 * self.logdet for row in rows))


def _fit(stack: Stack, rows: FloatArray, share: float) -> _Covariance:
    diagonal = stack.noise + share * stack.target(rows)
    low = np.sqrt((1.0 - share) / (len(rows) - 1.0)) * rows
    gram = np.eye(len(rows)) + (low / diagonal) @ low.T
    sign, logdet = np.linalg.slogdet(gram)
    return _Covariance(diagonal, low, np.linalg.inv(gram),
                       float(sign * logdet + np.sum(np.log(diagonal))))

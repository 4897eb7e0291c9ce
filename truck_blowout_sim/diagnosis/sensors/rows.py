"""One recording as rows of a linear system: identity residuals, their slopes, their covariance.

A residual row is ``E = J theta + noise``: E the identity under one bump, J how it moves with each
distortion, noise that of the channels it reads. The covariance between identities that share a
channel and between bumps that overlap is kept, banded in time.

Validated with: test/diagnosis/test_sensors_windows.py (covariance against Monte Carlo).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg.lapack import dtbtrs

from truck_blowout_sim.diagnosis.sensors.covariance import (
    Covariances,
    cholesky_factor,
    noise_blocks,
    white_equivalent,
)
from truck_blowout_sim.diagnosis.sensors.distortions import Distortion
from truck_blowout_sim.diagnosis.sensors.identities import (
    Identity,
    with_kinematic_accelerations,
)
from truck_blowout_sim.diagnosis.sensors.noise import Noise
from truck_blowout_sim.diagnosis.sensors.signals import Signals
from truck_blowout_sim.diagnosis.sensors.windows import Windows, make_windows

FloatArray = NDArray[np.float64]

_STEP = 1e-4


@dataclass(frozen=True)
class Rows:
    """Raw rows of one recording, bump by bump.

    Attributes:
        identities: asked in this recording, axis 1 of the arrays.
        time_s: middle of each bump, axis 0.
        residual: (bumps, identities), 0 where not valid.
        slopes: (bumps, identities, columns).
        valid: (bumps, identities).
        blocks: covariance of the bumps ``lag`` apart: lag -> (bumps - lag, identities, identities).
        factor: banded Cholesky factor of the whole covariance.
    """

    identities: tuple[Identity, ...]
    time_s: FloatArray
    residual: FloatArray
    slopes: FloatArray
    valid: NDArray[np.bool_]
    blocks: tuple[FloatArray, ...]
    factor: FloatArray

    @property
    def variance(self) -> FloatArray:
        """Variance of each row, (bumps, identities)."""
        return np.asarray(np.einsum("kaa->ka", self.blocks[0]))


def build_rows(
    signals: Signals,
    identities: Sequence[Identity],
    columns: Sequence[tuple[Distortion, int]],
    noise: Mapping[str, Noise],
    known: Covariances | None = None,
) -> Rows:
    """Rows of one recording.

    Args:
        signals: measured, with known distortions taken out.
        identities: those that the recording can be asked.
        columns: distortion and parameter index of each unknown.
        noise: of each channel.
        known: covariances computed before for the same recording; extended here. They depend on
            which rows are valid, and hardly on a fault that was taken out.
    """
    windows = make_windows(signals.period_s)
    smooth = with_kinematic_accelerations(smoothed_signals(signals, noise))
    centres = windows.centres(signals.time_s.size)
    shape = (centres.size, len(identities))
    residual = np.full(shape, np.nan)
    slopes = np.zeros((*shape, len(columns)))
    names = sorted({c for i in identities for c in i.channels if c in signals})
    weights = np.zeros((*shape, len(names)))
    slope_of = channel_slopes(smooth, columns, signals.period_s)
    for a, identity in enumerate(identities):
        residual[:, a] = identity.under(windows, signals)
        gains = channel_gains(smooth, identity)
        for channel, gain in gains.items():
            weights[:, a, names.index(channel)] = gain[centres]
        slopes[:, a, :] = _identity_slopes(
            windows, identity, gains, slope_of, (shape[0], len(columns))
        )
    valid = np.isfinite(residual)
    key = (tuple(i.name for i in identities), valid.tobytes())
    memory = {} if known is None else known
    if key not in memory:
        blocks = noise_blocks(windows, identities, weights, names, noise, valid)
        memory[key] = blocks, cholesky_factor(blocks, valid)
    return Rows(
        identities=tuple(identities),
        time_s=signals.time_s[centres],
        residual=np.where(valid, residual, 0.0),
        slopes=np.where(valid[:, :, None], slopes, 0.0),
        valid=valid,
        blocks=memory[key][0],
        factor=memory[key][1],
    )


def smoothed_signals(signals: Signals, noise: Mapping[str, Noise]) -> Signals:
    """What regressors are made of: signals freed of as much noise as can be."""
    return signals.smooth({name: white_equivalent(n) for name, n in noise.items()})


def fault_slopes(
    smooth: Signals, rows: Rows, columns: Sequence[tuple[Distortion, int]]
) -> FloatArray:
    """Slopes of some unknowns for other smooth signals, (bumps, identities, columns)."""
    windows, smooth = make_windows(smooth.period_s), with_kinematic_accelerations(smooth)
    slope_of = channel_slopes(smooth, columns, smooth.period_s)
    shape = (rows.residual.shape[0], len(columns))
    slopes = [_identity_slopes(windows, i, channel_gains(smooth, i), slope_of, shape)
              for i in rows.identities]
    return np.where(rows.valid[:, :, None], np.stack(slopes, axis=1), 0.0)


def whiten(rows: Rows, inflation: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Residual and slopes with unit white noise.

    Args:
        rows: of one recording.
        inflation: factor on the noise of each identity, at least 1.

    Returns:
        Shapes (rows,) and (rows, columns); rows that are not valid are zero.
    """
    count, width = rows.residual.shape
    # Inflating the noise of an identity is dividing its rows: the factor stays the same.
    residual = (rows.residual / inflation).reshape(-1, 1)
    slopes = (rows.slopes / inflation[:, None]).reshape(count * width, -1)
    solved, info = dtbtrs(rows.factor, np.column_stack([residual, slopes]), uplo="L")
    if info != 0:
        raise ArithmeticError(f"covariance of the identities is singular at row {info}")
    return solved[:, 0], solved[:, 1:]


def channel_gains(smooth: Signals, identity: Identity) -> dict[str, FloatArray]:
    """d(algebraic part) / d(channel), sample by sample, by central differences."""
    gains = {}
    for channel in identity.channels:
        if channel not in smooth:
            continue
        base = smooth[channel]
        up = identity.algebraic(smooth.with_values({channel: base + _STEP}))
        down = identity.algebraic(smooth.with_values({channel: base - _STEP}))
        gains[channel] = _known((up - down) / (2.0 * _STEP))
    for channel, _ in identity.rates:
        gains.setdefault(channel, np.zeros_like(smooth.time_s))
    return gains


def _known(values: FloatArray) -> FloatArray:
    """The values, 0 where nothing was measured."""
    return np.where(np.isfinite(values), values, 0.0)


def channel_slopes(
    smooth: Signals, columns: Sequence[tuple[Distortion, int]], period_s: float
) -> dict[str, list[tuple[int, FloatArray]]]:
    """By channel: the columns that touch it and how."""
    out: dict[str, list[tuple[int, FloatArray]]] = {}
    for index, (distortion, parameter) in enumerate(columns):
        for channel in distortion.channels:
            if channel in smooth:
                slope = distortion.slope(parameter, channel, smooth.__getitem__, period_s)
                out.setdefault(channel, []).append((index, _known(slope)))
    return out


def _identity_slopes(
    windows: Windows, identity: Identity, gains: Mapping[str, FloatArray],
    slope_of: Mapping[str, list[tuple[int, FloatArray]]], shape: tuple[int, int],
) -> FloatArray:  # fmt: skip
    factors = dict(identity.rates)
    mean_part: dict[int, FloatArray] = {}
    derivative_part: dict[int, FloatArray] = {}
    for channel, gain in gains.items():
        for index, slope in slope_of.get(channel, ()):
            mean_part[index] = mean_part.get(index, np.zeros_like(gain)) + gain * slope
            if channel in factors:
                moved = factors[channel] * slope
                derivative_part[index] = derivative_part.get(index, np.zeros_like(gain)) + moved
    out = np.zeros(shape)
    if mean_part:
        order = list(mean_part)
        out[:, order] = windows.mean(np.stack([mean_part[i] for i in order])).T
    if derivative_part:
        order = list(derivative_part)
        out[:, order] -= windows.derivative(np.stack([derivative_part[i] for i in order])).T
    return out

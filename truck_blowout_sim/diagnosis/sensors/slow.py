"""Relations that hold over seconds rather than at every instant.

Two are asked: the hitch has one position, whichever unit it is computed from (satellite positions
wander over seconds, so bumps of 4 s say all there is); and, where the trailer's heading was not
recorded, the two yaw rates integrate to the same turn but for the change of the bend between the
units, which follows from the curvature at both ends (``towed``).

Known limits: the second is geometry plus the knowledge that the truck did not jackknife.
Validated with: test/diagnosis/test_sensors_identities.py.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve_triangular

from truck_blowout_sim.diagnosis.sensors.covariance import WANDER_M, WANDER_S
from truck_blowout_sim.diagnosis.sensors.distortions import Distortion
from truck_blowout_sim.diagnosis.sensors.geometry import Geometry
from truck_blowout_sim.diagnosis.sensors.identities import Identity, channel_names
from truck_blowout_sim.diagnosis.sensors.rows import channel_gains, channel_slopes
from truck_blowout_sim.diagnosis.sensors.signals import Signals
from truck_blowout_sim.diagnosis.sensors.towed import bend_change

FloatArray = NDArray[np.float64]

_BLOCK_S = 4.0
_BOTH_WANDER_M = float(np.hypot(WANDER_M["tractor"], WANDER_M["trailer"]))
_FEWEST = 100  # samples; judgement: a second of a common log
_WHITE_M = 0.006


@dataclass(frozen=True)
class SlowRows:
    """Whitened rows of one slow relation in one recording.

    Attributes:
        identity: the relation.
        time_s: middle of each block.
        value: residual of each block, not whitened.
        sigma: of each block.
        residual: whitened residual.
        slopes: whitened slopes, (blocks, columns).
        raw_slopes: not whitened.
    """

    identity: Identity
    time_s: FloatArray
    value: FloatArray
    sigma: FloatArray
    residual: FloatArray
    slopes: FloatArray
    raw_slopes: FloatArray


@dataclass(frozen=True)
class _Moves:
    """How each unknown moves each channel, made once for all relations of a recording.

    Attributes:
        smooth: channels without their noise.
        by_channel: column and slope of each unknown that moves it; ``columns``: how many unknowns.
    """

    smooth: Signals
    by_channel: Mapping[str, Sequence[tuple[int, FloatArray]]]
    columns: int


def slow_rows(
    signals: Signals, geometry: Geometry, columns: Sequence[tuple[Distortion, int]]
) -> tuple[SlowRows, ...]:
    """Rows of the slow relations that a recording can be asked."""
    found, smooth = [], signals.smooth()
    moves = _Moves(smooth, channel_slopes(smooth, columns, signals.period_s), len(columns))
    for identity in hitch_position(geometry):
        if identity.available(signals):
            found.append(_block_rows(signals, identity, moves, _BLOCK_S, _wander))
    closure = yaw_closure()
    if closure.available(signals) and channel_names("trailer")["yaw"] not in signals:
        change, sigma = bend_change(signals, geometry)
        lasted = float(signals.time_s[-1] - signals.time_s[0])
        expected, spread = change / lasted, (sigma / lasted) ** 2
        found.append(
            _block_rows(
                signals, yaw_closure(expected), moves, np.inf,
                lambda time_s, length_s: np.full((1, 1), spread),
            )
        )  # fmt: skip
    return tuple(row for row in found if row is not None)


def hitch_position(geometry: Geometry) -> tuple[Identity, ...]:
    """Hitch position from the trailer minus that from the tractor, in the tractor's axes."""
    if not geometry.knows_hitch:
        return ()
    a, b = channel_names("tractor"), channel_names("trailer")
    needs = tuple(n[key] for n in (a, b) for key in ("x", "y", "yaw"))
    uses = tuple(n[key] for n in (a, b) for key in ("roll", "pitch"))

    def difference(s: Signals, component: int) -> FloatArray:
        ax, ay = _hitch_point(s, a, geometry.tractor_to_hitch_m)
        bx, by = _hitch_point(s, b, geometry.trailer_to_hitch_m)
        c, w = np.cos(s[a["yaw"]]), np.sin(s[a["yaw"]])
        dx, dy = bx - ax, by - ay
        return np.asarray(c * dx + w * dy if component == 0 else c * dy - w * dx)

    text = "x_tractor + R l = x_trailer + R l"
    return (
        Identity("hitch position forward", "m", text + " (forward)", needs, uses,
                 lambda s: difference(s, 0)),
        Identity("hitch position sideways", "m", text + " (sideways)", needs, uses,
                 lambda s: difference(s, 1)),
    )  # fmt: skip


def yaw_closure(expected_radps: float = 0.0) -> Identity:
    """Mean yaw rates of both units differ by the change of the bend, over a whole recording.

    Args:
        expected_radps: change of the bend over the length of the recording.
    """
    a, b = channel_names("tractor"), channel_names("trailer")
    return Identity(
        "yaw rates of both units", "rad/s", "mean(r_trailer) = mean(r_tractor) over a run",
        (a["r"], b["r"]), (),
        lambda s: np.asarray(s[b["r"]] - s[a["r"]] - expected_radps),
    )  # fmt: skip


def _hitch_point(
    s: Signals, n: dict[str, str], arm_m: tuple[float, float, float]
) -> tuple[FloatArray, FloatArray]:
    x, _, z = arm_m
    c, w = np.cos(s[n["yaw"]]), np.sin(s[n["yaw"]])
    along = x + z * s[n["pitch"]]
    across = -z * s[n["roll"]]
    return s[n["x"]] + c * along - w * across, s[n["y"]] + w * along + c * across


def _block_rows(
    signals: Signals, identity: Identity, moves: _Moves, block_s: float,
    covariance: Callable[[FloatArray, FloatArray], FloatArray],
) -> SlowRows | None:  # fmt: skip
    value = identity.algebraic(signals)
    known = np.isfinite(value)
    if known.sum() < _FEWEST:
        return None
    slopes = np.zeros((value.size, moves.columns))
    for channel, gain in channel_gains(moves.smooth, identity).items():
        for index, slope in moves.by_channel.get(channel, ()):
            slopes[:, index] += gain * slope
    count = max(1, int(value.size * signals.period_s / block_s))
    parts = [part for part in np.array_split(np.arange(value.size), count) if known[part].any()]
    kept = [part[known[part]] for part in parts]
    time_s = np.array([signals.time_s[part].mean() for part in kept])
    mean = np.array([value[part].mean() for part in kept])
    mean_slopes = np.stack([slopes[part].mean(axis=0) for part in kept])
    cov = covariance(time_s, np.array([part.size for part in kept]) * signals.period_s)
    factor = np.linalg.cholesky(cov)
    white = solve_triangular(factor, np.column_stack([mean, mean_slopes]), lower=True)
    return SlowRows(
        identity, time_s, mean, np.sqrt(np.diag(cov)), np.asarray(white[:, 0]),
        np.asarray(white[:, 1:]), mean_slopes,
    )  # fmt: skip


def _wander(time_s: FloatArray, length_s: FloatArray) -> FloatArray:
    apart = np.abs(time_s[:, None] - time_s[None, :])
    cov = _BOTH_WANDER_M**2 * np.exp(-apart / WANDER_S)
    return np.asarray(cov + np.diag(_WHITE_M**2 / np.maximum(length_s, 1e-3)))

"""Hand-wheel zero: the angle at which the truck runs straight.

No kinematic identity reads the hand wheel. What there is: over a run, the wheel angle is
proportional to front slip geometry (from measured velocity and yaw rate), lateral acceleration
and yaw acceleration, plus a constant. The gains are free and shared by all runs; the constant of
each run is its zero. Play in the steering, the driver's wander and tire non-linearity scatter it
by a degree or two of hand wheel, which is why only several degrees are named here; a vehicle
model with the right play can do better and gets the figures.

References: single-track steering geometry, e.g. T. D. Gillespie, Fundamentals of Vehicle
Dynamics, chapter 6.
Known limits: a turned axle, a banked road or a steady side wind needs a held wheel as well; they
also change sideslip, bend or roll on the straight, and then no sensor is blamed.
Validated with: test/diagnosis/test_sensors_steering.py.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.stats import norm

from truck_blowout_sim.diagnosis.sensors.distortions import Bias
from truck_blowout_sim.diagnosis.sensors.findings import Amount, SensorFinding, SteeringZero
from truck_blowout_sim.diagnosis.sensors.identities import channel_names
from truck_blowout_sim.diagnosis.sensors.signals import WHEEL, Signals, smoothed
from truck_blowout_sim.diagnosis.sensors.wheel_delay import Steered, late_wheel
from truck_blowout_sim.diagnosis.sensors.words import equation, next_test, sentence

FloatArray = NDArray[np.float64]

_SMOOTH_S = 0.2
_SMOOTH_LITTLE_S = 0.1
_STRIDE_S = 0.25
_BRAKE_FREE_PA = 8000.0
_SLOWEST_MPS = 4.0
# At the road wheels; the hand wheel shows them times the ratio.
_SCATTER_RAD = float(np.radians(0.064))  # between runs of one sound truck, from play and wander
_NORMAL_ZERO_RAD = float(np.radians(0.05))  # toe and straight-ahead setting of a sound axle
_SIGNIFICANT = 4.0
_SAME_STANCE_RAD = float(np.radians(0.15))
_LEAST_SAMPLES = 8


@dataclass(frozen=True)
class _Run:
    """What is used of one run: wheel angle, motion that needs it, how the truck stands."""

    name: str
    is_baseline: bool
    wheel: FloatArray
    motion: FloatArray  # columns: r/vx, lateral and yaw acceleration, vy/vx
    stance: FloatArray  # columns: sideslip, bend, roll


def steering_zero(
    signals: Sequence[Signals], is_baseline: Sequence[bool], ratio: float = 22.0
) -> tuple[SteeringZero | None, SensorFinding | None, tuple[str, ...]]:
    """Estimate the hand-wheel zero and say whether its sensor is to blame.

    Args:
        signals: corrected for other sensor faults.
        is_baseline: flag of each.
        ratio: hand-wheel angle per road-wheel angle.

    Returns:
        The zero, a finding if it is far off, and notes.
    """
    runs = [
        run
        for s, b in zip(signals, is_baseline, strict=True)
        for run in (_run(s, b),)
        if run is not None
    ]
    if not any(not run.is_baseline for run in runs):
        return None, None, ("hand-wheel zero: too little free rolling with the wheel measured",)
    offsets = _intercepts([run.wheel for run in runs], [run.motion for run in runs])
    here = [offsets[k] for k, run in enumerate(runs) if not run.is_baseline]
    there = [offsets[k] for k, run in enumerate(runs) if run.is_baseline]
    scatter = _scatter(ratio, here, there)
    zero = SteeringZero(
        offset_rad=float(np.mean(here)),
        sigma_rad=scatter / float(np.sqrt(len(here))),
        baseline_rad=float(np.mean(there)) if there else None,
        baseline_sigma_rad=scatter / float(np.sqrt(len(there))) if there else None,
        by_recording={run.name: float(o) for run, o in zip(runs, offsets, strict=True)},
    )
    finding, notes = _judge(zero, runs, ratio)
    return zero, finding, notes


def _scatter(ratio: float, *groups: Sequence[float]) -> float:
    """Scatter of the zero between runs of one kind: at least the usual one.

    A sensor is off by the same angle in every run; where runs disagree, the truck is at fault.
    """
    squares = sum(float(np.sum(np.square(np.array(g) - np.mean(g)))) for g in groups if g)
    freedom = sum(len(g) - 1 for g in groups if g)
    return max(ratio * _SCATTER_RAD, float(np.sqrt(squares / freedom)) if freedom else 0.0)


def _judge(
    zero: SteeringZero, runs: Sequence[_Run], ratio: float
) -> tuple[SensorFinding | None, tuple[str, ...]]:
    if zero.baseline_rad is not None and zero.baseline_sigma_rad is not None:
        offset = zero.offset_rad - zero.baseline_rad
        sigma = float(np.hypot(zero.sigma_rad, zero.baseline_sigma_rad))
    else:
        offset = zero.offset_rad
        sigma = float(np.hypot(zero.sigma_rad, ratio * _NORMAL_ZERO_RAD))
    if abs(offset) < _SIGNIFICANT * sigma:
        return None, ()
    moved = _stance_change(runs)
    if moved > _SAME_STANCE_RAD:
        return None, (
            f"the hand wheel is held {np.degrees(offset):.1f} deg off, but the vehicle also "
            f"stands {np.degrees(moved):.2f} deg differently on the straight: not the sensor",
        )
    return _finding(offset, sigma), ()


def _finding(offset: float, sigma: float) -> SensorFinding:
    distortion = Bias("steering_angle_offset", "", "hand wheel", (WHEEL,), "offset", "rad")
    aliases = ("steering_angle_offset", "axle_misalignment")
    return SensorFinding(
        name="steering_angle_offset",
        body="tractor",
        instrument="hand wheel",
        channels=(WHEEL,),
        parameters={"offset": Amount.about(offset, "rad", sigma)},
        delta_chi2=(offset / sigma) ** 2,
        p_value=float(2.0 * norm.sf(abs(offset) / sigma)),
        aliases=aliases,
        in_baseline=False,
        sentence=sentence(distortion, (offset,), (sigma,)),
        equation=equation("steering_angle_offset"),
        next_test=next_test("steering_angle_offset", aliases[:1]),
        distortion=distortion,
    )


def _run(signals: Signals, is_baseline: bool) -> _Run | None:
    moves = _motion(signals, _SMOOTH_S)
    if signals.wheel_rad is None or moves is None:
        return None
    motion, used = moves
    stride = max(1, round(_STRIDE_S / signals.period_s))
    chosen = np.flatnonzero(used)[::stride]
    if chosen.size < _LEAST_SAMPLES:
        return None
    width = _SMOOTH_S / signals.period_s
    wheel = smoothed(signals.wheel_rad, width)
    n, m = channel_names("tractor"), channel_names("trailer")
    both = m["yaw"] in signals and n["yaw"] in signals
    bend = (smoothed(signals[m["yaw"]] - signals[n["yaw"]], width) if both
            else np.zeros_like(signals.time_s))  # fmt: skip
    stance = np.column_stack([motion[:, 3], bend, smoothed(signals[n["roll"]], width)])[chosen]
    return _Run(signals.name, is_baseline, wheel[chosen], motion[chosen], np.nan_to_num(stance))


def _motion(signals: Signals, smooth_s: float) -> tuple[FloatArray, NDArray[np.bool_]] | None:
    """Motion that needs a wheel angle, columns as of a run, and the samples that count.

    None where speed, side speed or yaw rate was not recorded.
    """
    n = channel_names("tractor")
    if any(n[key] not in signals for key in ("vx", "vy", "r")):
        return None
    vx, vy, r = (smoothed(signals[n[key]], smooth_s / signals.period_s)
                 for key in ("vx", "vy", "r"))  # fmt: skip
    fast = vx > _SLOWEST_MPS
    along = np.where(fast, vx, np.nan)
    lateral = np.gradient(vy, signals.period_s) + vx * r
    turning = np.gradient(r, signals.period_s)
    motion = np.column_stack([r / along, lateral, turning, vy / along])
    return motion, _quiet(signals) & fast


def late_hand_wheel(
    signals: Sequence[Signals], is_baseline: Sequence[bool]
) -> SensorFinding | None:
    """The finding that the hand wheel reads late; arguments as in :func:`steering_zero`."""
    runs = []
    for s, baseline in zip(signals, is_baseline, strict=True):
        moves = _motion(s, _SMOOTH_LITTLE_S)
        if baseline or s.wheel_rad is None or moves is None:
            continue
        wheel = smoothed(s.wheel_rad, _SMOOTH_LITTLE_S / s.period_s)
        runs.append(Steered(wheel, *moves, s.period_s))
    return late_wheel(runs)


def _quiet(signals: Signals) -> NDArray[np.bool_]:
    """Before any blowout, brakes off, away from the ends."""
    quiet = np.ones(signals.time_s.size, dtype=bool)
    edge = max(1, round(3.0 * _SMOOTH_S / signals.period_s))
    quiet[:edge] = quiet[-edge:] = False
    for since in signals.blown_since_s.values():
        quiet &= signals.time_s < since
    for name in signals.values:
        if name.startswith("brake_pressure_"):
            quiet &= signals[name] < _BRAKE_FREE_PA
    return quiet


def _intercepts(targets: Sequence[FloatArray], motions: Sequence[FloatArray]) -> FloatArray:
    """Constant of each run; gains shared, long runs do not outweigh short ones."""
    weights = [1.0 / np.sqrt(target.size) for target in targets]
    wanted = np.concatenate([t * w for t, w in zip(targets, weights, strict=True)])
    motion = np.vstack([m * w for m, w in zip(motions, weights, strict=True)])
    which = np.concatenate([np.full(t.size, k) for k, t in enumerate(targets)])
    own = (which[:, None] == np.arange(len(targets))) * np.array(weights)[which][:, None]
    # A tiny ridge: straight runs alone do not determine the gains.
    spread = motion.std(axis=0) + 1e-12
    ridge = np.diag(1e-3 * np.concatenate([spread, np.zeros(len(targets))]))
    a = np.vstack([np.hstack([motion, own]), ridge])
    b = np.concatenate([wanted, np.zeros(ridge.shape[0])])
    solution, *_ = np.linalg.lstsq(a, b, rcond=None)
    return np.asarray(solution[motion.shape[1] :])


def _stance_change(runs: Sequence[_Run]) -> float:
    """Largest change of straight-line sideslip, bend or roll against the baseline."""
    before = np.array([run.is_baseline for run in runs])
    if not before.any():
        return 0.0
    motions = [run.motion[:, :3] for run in runs]
    changes = []
    for column in range(runs[0].stance.shape[1]):
        stood = _intercepts([run.stance[:, column] for run in runs], motions)
        changes.append(abs(float(stood[~before].mean() - stood[before].mean())))
    return max(changes)

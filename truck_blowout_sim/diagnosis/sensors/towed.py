"""What can be asked of a trailer whose position, heading and velocity were not recorded.

Its gyros and accelerometers remain. The specific force at the hitch is the same from both units;
the roll and the bend between the units that this needs are reckoned from the gyros, which is
honest over the length of a run that begins and ends straight. And both units turn by the same
angle, apart from the bend that their curvature at either end accounts for.

Known limits: weaker than the identities it stands in for; the bend at the ends assumes that the
trailer tracks without much slip, within 40 %.
Validated with: test/diagnosis/test_sensors_towed.py.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.sensors.geometry import Geometry
from truck_blowout_sim.diagnosis.sensors.identities import Identity, channel_names
from truck_blowout_sim.diagnosis.sensors.signals import Signals
from truck_blowout_sim.recordings.gravity import AT_REST_MPS2

FloatArray = NDArray[np.float64]

ROLL, BEND = "trailer_roll_reckoned", "bend_reckoned"
_END_S = 0.5
_SLOWEST_MPS = 3.0  # judgement: keeps the curvature of a truck that stands finite
# Reckoned roll is good to about 0.2 deg over a run: 0.03 m/s2, slow, so worth more per bump.
_FORCE_SIGMA_MPS2 = 0.08
_TRAILER_LENGTH_M = 11.0
_TRACKING_ERROR = 0.4
_STRAIGHT_RAD = float(np.radians(0.3))
_UNKNOWN_BEND_RAD = float(np.radians(3.0))


def with_reckoned(signals: Signals) -> Signals:
    """Signals with the trailer's roll and the bend integrated from rates where not recorded."""
    a, b = channel_names("tractor"), channel_names("trailer")
    added = {}
    if b["roll"] not in signals and b["p"] in signals:
        added[ROLL] = _integrated(signals[b["p"]], signals.period_s)
    if b["yaw"] not in signals and a["r"] in signals and b["r"] in signals:
        added[BEND] = _integrated(signals[b["r"]] - signals[a["r"]], signals.period_s)
    return signals.with_values(added) if added else signals


def hitch_force(signals: Signals, geometry: Geometry) -> tuple[Identity, ...]:
    """Sideways specific force at the hitch, where the trailer's velocity was not recorded."""
    a, b = channel_names("tractor"), channel_names("trailer")
    if not geometry.knows_hitch or b["vy"] in signals:
        return ()
    roll = b["roll"] if b["roll"] in signals else ROLL
    x, _, z = geometry.tractor_to_hitch_m
    x_trailer, _, _ = geometry.trailer_to_hitch_m

    def residual(s: Signals) -> FloatArray:
        bend = s[b["yaw"]] - s[a["yaw"]] if b["yaw"] in s and a["yaw"] in s else s[BEND]
        along = s[a["ax"]] - (s[a["r"]] ** 2 + s[a["q"]] ** 2) * x
        across = s[a["ay"]] + s[a["p"]] * s[a["q"]] * x
        leaning = AT_REST_MPS2 * (s.gravity["trailer"] * np.sin(s[roll])
                                  - s.gravity["tractor"] * np.sin(s[a["roll"]]))
        turned = np.cos(bend) * across - np.sin(bend) * along + leaning
        here = s[b["ay"]] + s[b["p"]] * s[b["q"]] * x_trailer
        return np.asarray(here - turned)

    return (
        Identity(
            "hitch force sideways", "m/s2", "a_tractor + dw/dt x l = a_trailer + dw/dt x l",
            (a["ay"], b["ay"], a["r"], b["r"], a["roll"], roll),
            (a["ax"], a["p"], a["q"], b["p"], b["q"], a["yaw"], b["yaw"]),
            residual, ((b["r"], -x_trailer), (a["r"], x), (a["p"], -z)), _FORCE_SIGMA_MPS2,
        ),
    )  # fmt: skip


def bend_change(signals: Signals, geometry: Geometry) -> tuple[float, float]:
    """Expected change of the bend (trailer yaw minus tractor yaw) over a run, and its sigma."""
    n = channel_names("tractor")
    if n["vx"] not in signals or n["r"] not in signals:
        return 0.0, _UNKNOWN_BEND_RAD
    second = max(1, round(1.0 / signals.period_s))
    start, end = (
        _mean(signals[n["r"]][part]) / max(_mean(signals[n["vx"]][part]), _SLOWEST_MPS)
        for part in (slice(None, second), slice(-second, None))
    )
    half = geometry.trailer_behind_kingpin_m
    length = 2.0 * half if half else _TRAILER_LENGTH_M
    sigma = _STRAIGHT_RAD + _TRACKING_ERROR * length * (abs(start) + abs(end))
    return -length * (end - start), min(sigma, _UNKNOWN_BEND_RAD)


def _mean(values: FloatArray) -> float:
    return float(np.nanmean(values)) if np.isfinite(values).any() else 0.0


def _integrated(rate: FloatArray, period_s: float) -> FloatArray:
    """Integral that begins and ends at zero: what drifts is the gyro, not the truck."""
    total = np.cumsum(np.nan_to_num(rate)) * period_s
    ends = max(1, round(_END_S / period_s))
    first, last = float(total[:ends].mean()), float(total[-ends:].mean())
    return np.asarray(total - np.linspace(first, last, total.size))

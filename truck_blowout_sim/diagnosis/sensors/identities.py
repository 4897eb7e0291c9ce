"""Relations between channels that no force can break.

Each is ``algebraic(channels) - d/dt sum(c * channel) = 0`` for a rigid body, written without any
mass, tire or road. Axes: x forward, y left, z up; roll, pitch, yaw are intrinsic z-y-x, pitch
positive nose down. The vertical velocity is not recorded; it follows from pitch, roll and a path
that stays level (its heave part enters the identities below only times a roll or pitch rate).

References: rigid-body kinematics, e.g. R. F. Stengel, Flight Dynamics, section 3.2.
Known limits: bodies are rigid and the hitch is a point; the hub identity holds for wheels that
roll freely on sound tires only, and is masked elsewhere.
Validated with: test/diagnosis/test_sensors_identities.py.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.sensors.geometry import Geometry
from truck_blowout_sim.diagnosis.sensors.signals import Signals
from truck_blowout_sim.diagnosis.sensors.windows import Windows
from truck_blowout_sim.recordings.gravity import AT_REST_MPS2

FloatArray = NDArray[np.float64]
ARTICULATION = "articulation_rad"
# 1 sigma by which relations may be off under a bump, beside noise of their channels. Judgement:
# accelerations and velocities leave out heave, 5 cm/s at a roll rate of 2 deg/s or a tilt of 1 deg.
_ACCELERATION_MPS2, _VELOCITY_MPS = 0.002, 0.001
# Euler's equations are exact; judgement: a seventh of what a good gyro's noise leaves under a bump.
_TURN_RADPS = 1e-5
_HITCH_MPS = 0.002  # judgement: kingpin and frames give a little
# judgement: the angle half of what noise of good headings leaves under a bump, the rate alike
_BEND_RAD, _BEND_RADPS = 1e-4, 1e-4
Algebraic = Callable[[Signals], FloatArray]


@dataclass(frozen=True)
class Identity:
    """One relation.

    Attributes:
        name: e.g. ``tractor lateral acceleration``.
        unit: SI unit of its residual.
        equation: as a person reads it.
        needs: channels without which it cannot be asked.
        uses: further channels it takes into account where they exist.
        algebraic: everything but the differentiated channels.
        rates: channels whose time derivative is subtracted, each with its factor.
        model_sigma: what the relation itself may be off by, white per bump.
    """

    name: str
    unit: str
    equation: str
    needs: tuple[str, ...]
    uses: tuple[str, ...]
    algebraic: Algebraic
    rates: tuple[tuple[str, float], ...] = ()
    model_sigma: float = 0.0

    @property
    def channels(self) -> tuple[str, ...]:
        """Every channel it may read."""
        return self.needs + self.uses

    def available(self, signals: Signals) -> bool:
        """Whether the channels it needs were recorded."""
        return all(name in signals for name in self.needs)

    def under(self, windows: Windows, signals: Signals) -> FloatArray:
        """What it leaves under each bump; NaN where it cannot be asked."""
        out = windows.mean(self.algebraic(signals))
        for channel, factor in self.rates:
            out = out - factor * windows.derivative(signals[channel])
        return out


def body_identities(unit: str) -> tuple[Identity, ...]:
    """Relations between the instruments of one unit (``tractor`` or ``trailer``)."""
    n = channel_names(unit)
    tilt = (n["roll"], n["pitch"])
    return (
        Identity(
            f"{unit} lateral acceleration", "m/s2",
            "ay = dvy/dt + vx r - w p + g sin(roll) cos(pitch)",
            (n["ay"], n["vx"], n["vy"], n["r"]), (*tilt, n["p"]),
            lambda s: _lateral(s, n), ((n["vy"], 1.0),), _ACCELERATION_MPS2),
        Identity(
            f"{unit} longitudinal acceleration", "m/s2",
            "ax = dvx/dt - vy r + w q - g sin(pitch)",
            (n["ax"], n["vx"], n["vy"], n["r"]), (*tilt, n["q"]),
            lambda s: _longitudinal(s, n), ((n["vx"], 1.0),), _ACCELERATION_MPS2),
        Identity(
            f"{unit} heading rate", "rad/s",
            "dyaw/dt = (q sin(roll) + r cos(roll)) / cos(pitch)",
            (n["yaw"], n["r"]), (*tilt, n["q"]),
            lambda s: _heading_rate(s, n), ((n["yaw"], 1.0),), _TURN_RADPS),
        Identity(
            f"{unit} roll rate", "rad/s",
            "droll/dt = p + (q sin(roll) + r cos(roll)) tan(pitch)",
            (n["roll"], n["p"]), (n["pitch"], n["q"], n["r"]),
            lambda s: _roll_rate(s, n), ((n["roll"], 1.0),), _TURN_RADPS),
        Identity(
            f"{unit} pitch rate", "rad/s", "dpitch/dt = q cos(roll) - r sin(roll)",
            (n["pitch"], n["q"]), (n["roll"], n["r"]),
            lambda s: s[n["q"]] * np.cos(s[n["roll"]]) - s[n["r"]] * np.sin(s[n["roll"]]),
            ((n["pitch"], 1.0),), _TURN_RADPS),
        Identity(
            f"{unit} velocity along x", "m/s", "dx/dt = (velocity turned into the map) x",
            (n["x"], n["vx"], n["vy"], n["yaw"]), tilt,
            lambda s: _map_velocity(s, n)[0], ((n["x"], 1.0),), _VELOCITY_MPS),
        Identity(
            f"{unit} velocity along y", "m/s", "dy/dt = (velocity turned into the map) y",
            (n["y"], n["vx"], n["vy"], n["yaw"]), tilt,
            lambda s: _map_velocity(s, n)[1], ((n["y"], 1.0),), _VELOCITY_MPS),
    )  # fmt: skip


def hitch_identities(geometry: Geometry) -> tuple[Identity, ...]:
    """The hitch moves with one velocity, whichever unit it is computed from."""
    if not geometry.knows_hitch:
        return ()
    a, b = channel_names("tractor"), channel_names("trailer")
    needs = tuple(n[key] for n in (a, b) for key in ("vx", "vy", "r", "yaw"))
    uses = tuple(n[key] for n in (a, b) for key in ("p", "q"))

    def difference(s: Signals, component: int) -> FloatArray:
        bend = s[b["yaw"]] - s[a["yaw"]]
        vx, vy = _hitch_velocity(s, b, geometry.trailer_to_hitch_m)
        turned = (
            vx * np.cos(bend) - vy * np.sin(bend),
            vx * np.sin(bend) + vy * np.cos(bend),
        )
        here = _hitch_velocity(s, a, geometry.tractor_to_hitch_m)
        return np.asarray(turned[component] - here[component], dtype=np.float64)

    return (
        Identity(
            "hitch velocity forward", "m/s", "v_tractor + w x l = v_trailer + w x l (forward)",
            needs, uses, lambda s: difference(s, 0), (), _HITCH_MPS),
        Identity(
            "hitch velocity sideways", "m/s", "v_tractor + w x l = v_trailer + w x l (sideways)",
            needs, uses, lambda s: difference(s, 1), (), _HITCH_MPS),
    )  # fmt: skip


def articulation_identities() -> tuple[Identity, ...]:
    """The articulation angle against the headings, or against the yaw rates, of both units."""
    a, b = channel_names("tractor"), channel_names("trailer")
    return (
        Identity(
            "articulation against headings", "rad", "articulation = yaw_trailer - yaw_tractor",
            (ARTICULATION, a["yaw"], b["yaw"]), (),
            lambda s: np.asarray(_wrapped(s[ARTICULATION] - s[b["yaw"]] + s[a["yaw"]])),
            (), _BEND_RAD),
        Identity(
            "articulation rate", "rad/s", "d(articulation)/dt = r_trailer - r_tractor",
            (ARTICULATION, a["r"], b["r"]), (a["roll"], a["pitch"], a["q"], b["roll"], b["pitch"],
                                             b["q"]),
            lambda s: np.asarray(_heading_rate(s, b) - _heading_rate(s, a)),
            ((ARTICULATION, 1.0),), _BEND_RADPS),
    )  # fmt: skip


def _wrapped(angle: FloatArray) -> FloatArray:
    return np.asarray((angle + np.pi) % (2.0 * np.pi) - np.pi)


def with_kinematic_accelerations(smooth: Signals) -> Signals:
    """Smooth signals whose accelerations follow from velocity, rates and tilt where these exist.

    A gain error is regressed on the motion that both sides of an identity share. Were it regressed
    on the accelerometer itself, gain errors of both sides together could shrink any misfit.
    """
    moved = {}
    for unit in ("tractor", "trailer"):
        n = channel_names(unit)
        if not all(n[key] in smooth for key in ("vx", "vy", "r")):
            continue
        still = smooth.with_values({n[key]: np.zeros_like(smooth.time_s) for key in ("ax", "ay")})
        for key, speed, rest in (("ax", "vx", _longitudinal), ("ay", "vy", _lateral)):
            if n[key] in smooth:
                rate = np.gradient(smooth[n[speed]], smooth.period_s)
                moved[n[key]] = np.asarray(rate - rest(still, n), dtype=np.float64)
    return smooth.with_values(moved)


def channel_names(unit: str) -> dict[str, str]:
    """Names of a unit's channels, and its own."""
    return {
        "unit": unit, "x": f"{unit}_x_m", "y": f"{unit}_y_m", "yaw": f"{unit}_yaw_rad",
        "roll": f"{unit}_roll_rad", "pitch": f"{unit}_pitch_rad",
        "vx": f"{unit}_vx_mps", "vy": f"{unit}_vy_mps", "r": f"{unit}_yaw_rate_radps",
        "p": f"{unit}_roll_rate_radps", "q": f"{unit}_pitch_rate_radps",
        "ax": f"{unit}_ax_mps2", "ay": f"{unit}_ay_mps2", "az": f"{unit}_az_mps2",
    }  # fmt: skip


def _vertical(s: Signals, n: dict[str, str]) -> FloatArray:
    """Velocity along the body's z axis of a point on a level path."""
    roll, pitch = s[n["roll"]], s[n["pitch"]]
    return np.asarray(
        (s[n["vx"]] * np.sin(pitch) - s[n["vy"]] * np.sin(roll) * np.cos(pitch))
        / (np.cos(roll) * np.cos(pitch))
    )


def _lateral(s: Signals, n: dict[str, str]) -> FloatArray:
    weight = s.gravity[n["unit"]] * AT_REST_MPS2 * np.sin(s[n["roll"]]) * np.cos(s[n["pitch"]])
    return np.asarray(s[n["ay"]] - s[n["r"]] * s[n["vx"]] + s[n["p"]] * _vertical(s, n) - weight)


def _longitudinal(s: Signals, n: dict[str, str]) -> FloatArray:
    weight = s.gravity[n["unit"]] * AT_REST_MPS2 * np.sin(s[n["pitch"]])
    return np.asarray(s[n["ax"]] + s[n["r"]] * s[n["vy"]] - s[n["q"]] * _vertical(s, n) + weight)


def _heading_rate(s: Signals, n: dict[str, str]) -> FloatArray:
    roll, pitch = s[n["roll"]], s[n["pitch"]]
    return np.asarray((s[n["q"]] * np.sin(roll) + s[n["r"]] * np.cos(roll)) / np.cos(pitch))


def _roll_rate(s: Signals, n: dict[str, str]) -> FloatArray:
    roll, pitch = s[n["roll"]], s[n["pitch"]]
    turning = s[n["q"]] * np.sin(roll) + s[n["r"]] * np.cos(roll)
    return np.asarray(s[n["p"]] + turning * np.tan(pitch))


def _map_velocity(s: Signals, n: dict[str, str]) -> tuple[FloatArray, FloatArray]:
    """Velocity turned into map axes (rotation z-y-x)."""
    cy, sy = np.cos(s[n["yaw"]]), np.sin(s[n["yaw"]])
    cp, sp = np.cos(s[n["pitch"]]), np.sin(s[n["pitch"]])
    cr, sr = np.cos(s[n["roll"]]), np.sin(s[n["roll"]])
    vx, vy, w = s[n["vx"]], s[n["vy"]], _vertical(s, n)
    along = cp * vx + sp * sr * vy + sp * cr * w
    across = cr * vy - sr * w
    return np.asarray(cy * along - sy * across), np.asarray(sy * along + cy * across)


def _hitch_velocity(
    s: Signals, n: dict[str, str], arm_m: tuple[float, float, float]
) -> tuple[FloatArray, FloatArray]:
    x, y, z = arm_m
    p, q, r = s[n["p"]], s[n["q"]], s[n["r"]]
    return s[n["vx"]] + q * z - r * y, s[n["vy"]] + r * x - p * z

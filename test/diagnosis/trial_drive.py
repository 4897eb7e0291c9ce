"""Drives that are kinematically exact by construction: what the sensor gate is tried on.

Attitudes and paths are given functions of time; everything else follows by numerical
differentiation of rotation matrices on a fine grid, then noise is added and samples are kept.
Nothing is shared with the identities that it tries, and no force, mass or tire occurs.

Validated with: test/diagnosis/test_sensors_identities.py.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d
from scipy.signal import lfilter

from truck_blowout_sim.recordings import Recording, Series

FloatArray = NDArray[np.float64]
FINE_S, SAMPLE_S, GRAVITY = 0.001, 0.01, 9.81
ARMS = {"tractor": (-3.08, 0.30), "trailer": (5.6132, 0.0)}
RADIUS_M = {"steer": 0.4985, "trailer": 0.5026}
SIGMA = {
    "x_m": 0.004, "y_m": 0.004, "yaw_rad": np.radians(0.04), "roll_rad": np.radians(0.02),
    "pitch_rad": np.radians(0.02), "vx_mps": 0.012, "vy_mps": 0.012,
    "yaw_rate_radps": np.radians(0.02), "roll_rate_radps": np.radians(0.02),
    "pitch_rate_radps": np.radians(0.02), "ax_mps2": 0.03, "ay_mps2": 0.03, "az_mps2": 0.03,
}  # fmt: skip
METADATA = {
    "tractor_base_link": "2.420 m behind the steer axle, on the centre line, 0.90 m above the road",
    "trailer_base_link": "5.6132 m behind the kingpin, on the centre line, 1.20 m above the road",
    "accelerometers": "strapdown: specific force along the unit's own axes, gravity included",
}


def rotation(yaw: FloatArray, pitch: FloatArray, roll: FloatArray) -> FloatArray:
    """Body to map, intrinsic z-y-x, (n, 3, 3)."""
    cy, sy, cp, sp, cr, sr = (f(a) for a in (yaw, pitch, roll) for f in (np.cos, np.sin))
    rows = [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ]
    return np.asarray(np.moveaxis(np.array(rows), 2, 0))


def body_channels(
    position: FloatArray, yaw: FloatArray, pitch: FloatArray, roll: FloatArray
) -> dict[str, FloatArray]:
    """Every channel of a unit that moves along a level path with the given attitude."""

    def rate(values: FloatArray) -> FloatArray:
        return np.asarray(np.gradient(values, FINE_S, axis=0, edge_order=2))

    turn = rotation(yaw, pitch, roll)
    inverse = np.swapaxes(turn, 1, 2)
    ground = np.column_stack([rate(position), np.zeros(yaw.size)])
    velocity = np.einsum("kij,kj->ki", inverse, ground)
    force = np.einsum("kij,kj->ki", inverse, rate(ground) + np.array([0.0, 0.0, GRAVITY]))
    spin = np.einsum("kij,kjl->kil", inverse, rate(turn))
    return {
        "x_m": position[:, 0], "y_m": position[:, 1], "yaw_rad": yaw, "roll_rad": roll,
        "pitch_rad": pitch, "vx_mps": velocity[:, 0], "vy_mps": velocity[:, 1],
        "yaw_rate_radps": spin[:, 1, 0], "pitch_rate_radps": spin[:, 0, 2],
        "roll_rate_radps": spin[:, 2, 1],
        "ax_mps2": force[:, 0], "ay_mps2": force[:, 1], "az_mps2": force[:, 2],
    }  # fmt: skip


def exact_channels(
    seed: int, duration_s: float, steer: float = 1.0
) -> tuple[FloatArray, dict[str, FloatArray]]:
    """A winding drive of both units: coarse times and noise-free channels."""
    rng = np.random.default_rng(seed)
    t = np.arange(-1.0, duration_s + 1.0, FINE_S)

    def wave(size: float, fastest_hz: float) -> FloatArray:
        hz = rng.uniform(0.08, fastest_hz, 5)
        parts = np.sin(2 * np.pi * hz[:, None] * t + rng.uniform(0, 6.28, 5)[:, None])
        return np.asarray(size * parts.sum(axis=0) / np.sqrt(5.0))

    # Straight at both ends, like a test driver's run.
    ends = np.clip(np.minimum(t - t[0], t[-1] - t) / 3.0, 0.0, 1.0)
    u = np.clip(2.0 * ends - 1.0, 0.0, 1.0)
    envelope = u**4 * (35.0 - 84.0 * u + 70.0 * u**2 - 20.0 * u**3)
    speed = 20.0 + wave(0.8, 0.15)
    yaw = 0.3 + envelope * wave(0.04 * steer, 0.5)
    course = yaw + envelope * wave(0.006 * steer, 0.5)
    roll, pitch = envelope * wave(0.012 * steer, 0.7), wave(0.004, 0.7)
    path = np.cumsum(np.column_stack([speed * np.cos(course), speed * np.sin(course)]), 0) * FINE_S
    tractor = body_channels(path, yaw, pitch, roll)
    hitch = path + _arm("tractor", yaw, pitch, roll)
    towed = _towed_yaw(hitch, yaw[0])
    lean, nod = envelope * wave(0.01 * steer, 0.6), wave(0.003, 0.6)
    trailer = body_channels(hitch - _arm("trailer", towed, nod, lean), towed, nod, lean)
    out = {f"tractor_{k}": v for k, v in tractor.items()}
    out |= {f"trailer_{k}": v for k, v in trailer.items()}
    for side, left in (("left", 1.0), ("right", -1.0)):
        for unit, axles in (("tractor", ("steer",)), ("trailer", ("trailer_1", "trailer_2"))):
            at_hub = out[f"{unit}_vx_mps"] - out[f"{unit}_yaw_rate_radps"] * left * 0.95
            for axle in axles:
                radius = RADIUS_M[axle.split("_")[0]]
                out[f"hub_speed_{axle}_{side}_radps"] = at_hub / radius
    # Wheel angle of a linear truck: slip geometry, understeer, no play.
    lateral = np.gradient(out["tractor_vy_mps"], FINE_S) + speed * out["tractor_yaw_rate_radps"]
    slip = (out["tractor_vy_mps"] + 2.42 * out["tractor_yaw_rate_radps"]) / speed
    out["steering_wheel_angle_rad"] = 22.0 * (slip + 0.02 * lateral / GRAVITY)
    kept = slice(1000, -1000, round(SAMPLE_S / FINE_S))
    time_s: FloatArray = np.asarray(t[kept], dtype=np.float64)
    return time_s, {name: values[kept] for name, values in out.items()}


def make_run(
    seed: int, duration_s: float = 15.0, steer: float = 1.0, noise: float = 1.0, name: str = ""
) -> Recording:
    """A recorded drive of a tractor-semitrailer.

    Args:
        seed: of the drive and of its noise.
        duration_s: length.
        steer: how hard it winds; 1 reaches about 2 m/s2 of lateral acceleration.
        noise: factor on the noise of good test instruments.
        name: of the recording.

    Returns:
        Both units' motion, undriven hub speeds and the hand wheel at 100 Hz.
    """
    time_s, channels = exact_channels(seed, duration_s, steer)
    rng = np.random.default_rng(10_000 + seed)
    out = {}
    for channel, exact in channels.items():
        unit, _, stem = channel.partition("_")
        if stem in SIGMA:
            sigma = SIGMA[stem] * (2.0 if unit == "trailer" and stem[0] not in "xy" else 1.0)
        else:
            sigma = 0.002 * float(np.abs(exact).mean()) if unit == "hub" else 0.0007
        error = sigma * rng.standard_normal(exact.size)
        if stem in ("x_m", "y_m"):
            error += _wander(rng, exact.size, {"tractor": 0.015, "trailer": 0.02}[unit])
        out[channel] = Series(time_s, exact + noise * error)
    return Recording(name or f"run {seed}", out, (), METADATA)


def _wander(rng: np.random.Generator, size: int, sigma: float) -> FloatArray:
    """Satellite wander: correlated over 8 s."""
    keep = float(np.exp(-SAMPLE_S / 8.0))
    steps = rng.standard_normal(size)
    steps[1:] *= np.sqrt(1.0 - keep**2)
    return np.asarray(sigma * lfilter([1.0], [1.0, -keep], steps))


def _arm(unit: str, yaw: FloatArray, pitch: FloatArray, roll: FloatArray) -> FloatArray:
    x, z = ARMS[unit]
    return np.asarray(rotation(yaw, pitch, roll)[:, :2, :] @ np.array([x, 0.0, z]))


def _towed_yaw(hitch: FloatArray, start: float) -> FloatArray:
    """Heading of a trailer whose axles, 11.2 m behind the hitch, do not slip."""
    velocity = np.gradient(hitch, FINE_S, axis=0)
    yaw = np.empty(len(hitch))
    yaw[0] = start
    for k in range(1, yaw.size):
        across = velocity[k, 1] * np.cos(yaw[k - 1]) - velocity[k, 0] * np.sin(yaw[k - 1])
        yaw[k] = yaw[k - 1] + FINE_S * across / 11.2
    return np.asarray(gaussian_filter1d(yaw, 50.0))

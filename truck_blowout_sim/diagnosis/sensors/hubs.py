"""Hub speeds against the body's speed, on wheels that roll freely.

A braked or driven wheel slips, and physics may explain that; so only hubs that neither brake nor
drive are asked, and all hubs of a unit are averaged: a speed sensor's gain moves them together, a
tire's radius moves one. Once a tire of the unit is blown, its load is on the others, whose radii
shrink: from then on nothing is asked. A wheel that is steered by delta rolls at v cos(delta) where
the vehicle slides on straight ahead, and at v / cos(delta) where it does not slide. Both differ
from v by about v delta^2 / 2. It is asked only where this is less than what the radii vary by.

Known limits: without a baseline the rolling radius is unknown to 5 %, so the mean
level says nothing about a gain; only changes against the baseline do. Every axle of the first unit
counts as steered.
Validated with: test/diagnosis/test_sensors_identities.py.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.sensors.geometry import Geometry
from truck_blowout_sim.diagnosis.sensors.identities import Identity, channel_names
from truck_blowout_sim.diagnosis.sensors.signals import Signals, smoothed
from truck_blowout_sim.recordings.channels import hub_of

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]

_BRAKE_FREE_PA = 8000.0
_BRAKE_RELEASE_S = 2.0
_COASTING_MPS2 = 0.6
_SLOWING_S = 0.3  # judgement: leaves 3 mm/s² of a good speed's noise, and is short against braking
_SLOWEST_MPS = 4.0
_HARD_TURN_MPS2 = 2.0
_TURN_S = 0.5
_MODEL_SIGMA_MPS = 0.01
TURNS_RADPS = 1.0  # slower wheels stand, as far as their sensors tell
_FEWEST = 50  # samples for a radius


def hub_channels(signals: Signals, unit: str, geometry: Geometry) -> tuple[str, ...]:
    """Hub-speed channels of undriven hubs of a unit."""
    names = [n for n in signals.values if n.startswith("hub_speed_")]
    mine = [n for n in names if hub_of(n).startswith("trailer") == (unit == "trailer")]
    return tuple(n for n in mine if not geometry.drives(hub_of(n)))


def free_rolling(signals: Signals, unit: str, geometry: Geometry) -> BoolArray:
    """Samples at which the unit's undriven hubs roll freely: not braked, in a hard turn or steered.

    In a hard turn, load makes one radius smaller than the other; a steered wheel points elsewhere.
    """
    circuit, names = "trailer" if unit == "trailer" else "steer", channel_names(unit)
    speed = signals[names["vx"]]
    free = speed > _SLOWEST_MPS
    if names["r"] in signals:
        turning = smoothed(signals[names["r"]], _TURN_S / signals.period_s) * speed
        free &= ~(np.abs(turning) > _HARD_TURN_MPS2)
    if unit == "tractor" and signals.wheel_rad is not None:
        turned = smoothed(signals.wheel_rad, _TURN_S / signals.period_s) / geometry.steering_ratio
        free &= ~(0.5 * speed * turned**2 > _MODEL_SIGMA_MPS)
    pressure = f"brake_pressure_{circuit}_pa"
    if pressure in signals:
        braked = ~(signals[pressure] < _BRAKE_FREE_PA)
        tail = round(_BRAKE_RELEASE_S / signals.period_s)
        lingering = np.convolve(braked, np.ones(tail + 1), mode="full")[: braked.size] > 0
        return np.asarray(free & ~lingering)
    slowing = np.gradient(smoothed(speed, _SLOWING_S / signals.period_s), signals.period_s)
    return np.asarray(free & (np.abs(slowing) < _COASTING_MPS2))


def rolling_radii(all_signals: Sequence[Signals], geometry: Geometry) -> Mapping[str, float]:
    """Median rolling radius of every undriven hub over the given recordings, by channel."""
    ratios: dict[str, list[FloatArray]] = {}
    for signals in all_signals:
        for unit in ("tractor", "trailer"):
            n = channel_names(unit)
            if n["vx"] not in signals:
                continue
            free = free_rolling(signals, unit, geometry)
            for channel in hub_channels(signals, unit, geometry):
                sound = free & _sound(signals, channel)
                speed = signals[n["vx"]] - signals[n["r"]] * geometry.hub_left_m(hub_of(channel))
                usable = sound & (signals[channel] > TURNS_RADPS) & np.isfinite(speed)
                if usable.sum() > _FEWEST:
                    ratio = speed[usable] / signals[channel][usable]
                    ratios.setdefault(channel, []).append(ratio)
    return {channel: float(np.median(np.concatenate(r))) for channel, r in ratios.items()}


def hub_identity(
    signals: Signals, unit: str, radii: Mapping[str, float], geometry: Geometry
) -> Identity | None:
    """Mean of ``radius * hub speed`` equals forward speed at the hubs; ``None`` if not asked."""
    n = channel_names(unit)
    hubs = tuple(c for c in hub_channels(signals, unit, geometry) if c in radii)
    if not hubs or n["vx"] not in signals:
        return None
    masked = np.where(_asked(signals, unit, geometry), 0.0, np.nan)
    left = {c: geometry.hub_left_m(hub_of(c)) for c in hubs}

    def residual(s: Signals) -> FloatArray:
        rolled = sum((radii[c] * s[c] + s[n["r"]] * left[c] for c in hubs), np.zeros(1))
        return np.asarray(rolled / len(hubs) - s[n["vx"]] + masked)

    return Identity(
        f"{unit} hub speeds", "m/s", "R omega = vx (mean of freely rolling hubs)",
        (n["vx"], *hubs), (n["r"],), residual, (), _MODEL_SIGMA_MPS,
    )  # fmt: skip


def axle_pairs(signals: Signals) -> tuple[tuple[str, str], ...]:
    """Hub-speed channels of both ends of each axle, left before right."""
    names = [n for n in signals.values if n.startswith("hub_speed_")]
    axles = sorted({hub_of(n).rpartition("_")[0] for n in names})
    both = [(f"hub_speed_{axle}_left_radps", f"hub_speed_{axle}_right_radps") for axle in axles]
    return tuple(pair for pair in both if set(pair) <= set(names))


def axle_identities(signals: Signals, geometry: Geometry) -> tuple[Identity, ...]:
    """In a turn the outer wheel of an axle rolls faster than the inner one."""
    pairs = {pair: _unit_of(pair) for pair in axle_pairs(signals)}
    asked = {unit: _asked(signals, unit, geometry) for unit in set(pairs.values())}
    found = (_axle_identity(signals, pair, unit, asked[unit], geometry)
             for pair, unit in pairs.items())
    return tuple(one for one in found if one)


def _unit_of(pair: tuple[str, str]) -> str:
    """Unit that an axle carries."""
    return "trailer" if hub_of(pair[0]).startswith("trailer") else "tractor"


def _axle_identity(signals: Signals, pair: tuple[str, str], unit: str, asked: BoolArray,
                   geometry: Geometry) -> Identity | None:
    """None where the axle rolls freely in too few samples; ``asked``: those of its unit."""
    (left, right), axle = pair, hub_of(pair[0]).rpartition("_")[0]
    n = channel_names(unit)
    if n["vx"] not in signals or n["r"] not in signals:
        return None
    track_m = geometry.hub_left_m(hub_of(left)) - geometry.hub_left_m(hub_of(right))
    both = 0.5 * (signals[left] + signals[right])
    asked = asked & (both > TURNS_RADPS) & np.isfinite(signals[n["vx"]])
    if asked.sum() <= _FEWEST:
        return None
    masked = np.where(asked, 0.0, np.nan)
    radius_m = float(np.median(signals[n["vx"]][asked]) / np.median(both[asked]))

    def residual(s: Signals) -> FloatArray:
        return np.asarray(track_m * s[n["r"]] - radius_m * (s[right] - s[left]) + masked)

    return Identity(
        f"{axle} hub speeds, left and right", "m/s",
        "R (omega_right - omega_left) = track r",
        (n["r"], left, right), (), residual, (), _MODEL_SIGMA_MPS)


def _asked(signals: Signals, unit: str, geometry: Geometry) -> BoolArray:
    """Samples at which the unit's wheels roll freely, and on sound tires."""
    return free_rolling(signals, unit, geometry) & (signals.time_s < _blown_since(signals, unit))


def _blown_since(signals: Signals, unit: str) -> float:
    """Instant from which a tire of the unit is blown."""
    return min((t for hub, t in signals.blown_since_s.items()
                if hub.startswith("trailer") == (unit == "trailer")), default=np.inf)


def _sound(signals: Signals, channel: str) -> BoolArray:
    since = signals.blown_since_s.get(hub_of(channel), np.inf)
    return np.asarray(signals.time_s < since)

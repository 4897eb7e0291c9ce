"""Effects in the brakes."""

from __future__ import annotations

import numpy as np

from proving_ground.effects.base import (
    Active,
    EffectKind,
    Place,
    Strength,
    at_axle,
    at_hub,
    group_index,
    hub_index,
    only,
)
from proving_ground.sheet import HUBS

GROUPS = tuple(at_axle(name) for name in ("steer", "drive", "trailer"))


def _lag(s: float, place: Place, sign: float, when: float) -> Active:
    """A second-order line before the chamber, and more dead time."""
    line = max(0.6 * s, 0.006)          # shorter than a few steps would not be a line
    group = group_index(place)
    return Active({"slow_group": only(3, group, 1.8 / line), "slow_delay": only(3, group, 0.1 * s)},
                  Strength("extra lag", line + 0.1 * s, "s"))


def _imbalance(s: float, place: Place, sign: float, when: float) -> Active:
    """One brake gains less (or more) and its shoes touch later."""
    gain = float(np.clip(1.0 + s * (0.5 if sign > 0.0 else -0.85), 0.02, 2.0))
    hub = hub_index(place)
    gains = np.ones(len(HUBS))
    gains[hub] = gain
    hold = 6000.0 * min(s, 1.0) if sign < 0.0 else 0.0
    return Active({"brake_gain": gains, "brake_hold": only(len(HUBS), hub, hold)},
                  Strength("torque ratio to a sound brake", gain, "1"))


def _fade(s: float, place: Place, sign: float, when: float) -> Active:
    """Friction falls with the temperature of the drum."""
    lost = float(np.clip(0.85 * s, 0.0, 0.95))
    return Active({"fade": only(3, group_index(place), lost)},
                  Strength("torque lost when hot", lost, "1"))


def _first_order_lag(s: float, place: Place, sign: float, when: float) -> Active:
    """A dead time and no other change: a longer hose."""
    late = max(0.7 * s, 0.006)
    return Active({"slow_delay": only(3, group_index(place), late)},
                  Strength("extra lag", late, "s"))


def _gain(s: float, place: Place, sign: float, when: float) -> Active:
    """One brake gains less or more by one factor, down to a brake that is dead."""
    gain = float(np.clip(1.0 + s * (0.8 if sign > 0.0 else -0.85), 0.0, 3.0))
    gains = np.ones(len(HUBS))
    gains[hub_index(place)] = gain
    return Active({"brake_gain": gains}, Strength("torque ratio to a sound brake", gain, "1"))


def _early_fade(s: float, place: Place, sign: float, when: float) -> Active:
    """Friction falls with the first warmth of the drum."""
    lost = float(np.clip(0.7 * s, 0.0, 0.95))
    return Active({"fade": only(3, group_index(place), lost), "fade_k": 35.0},
                  Strength("torque lost when hot", lost, "1"))


BRAKES = (
    EffectKind("brake_lag", _lag, GROUPS, "brake", lowest=0.02, guess=400.0,
               others=(_first_order_lag,), end=1.0),
    EffectKind("brake_imbalance", _imbalance, tuple(at_hub(hub) for hub in HUBS), "brake",
               signed=True, guess=90.0, others=(_gain,), end=1.18),
    EffectKind("brake_fade", _fade, GROUPS, "brake", guess=45.0, others=(_early_fade,), end=1.1),
)

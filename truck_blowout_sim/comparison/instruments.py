"""What good instruments of a truck test resolve: differences below it are none to a person.

A computed channel has no noise, so its own says nothing about which differences matter. Held to
what a good instrument of its kind would show, it is judged as the same truck measured.

References: single samples of the proving ground's tractor instruments (docs/proving_ground.md),
whose positions wander by 15 mm and whose other channels are those of its trailer as well; forces:
A&D wheel force sensor, total error 0.1 % of 24 kN.
Known limits: one number a kind of quantity, whatever the instrument that was used.
Validated with: test/comparison/test_instruments.py.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

_BODY = {"_vx_mps": 0.012, "_vy_mps": 0.012, "_mps2": 0.03, "_rate_radps": 3.5e-4,
         "_yaw_rad": 7e-4, "_roll_rad": 3.5e-4, "_pitch_rad": 3.5e-4,
         "_x_m": 0.015, "_y_m": 0.015}  # fmt: skip
# a constant part in SI and a share of the reading
_PARTS = {"hub_speed_": (0.0, 0.002), "tire_pressure_": (0.0, 0.005),
          "brake_chamber_": (500.0, 0.005)}  # fmt: skip
# what a body's quantity of the same unit has: angles between bodies, heights, turned positions
_OTHERS = {"_mps": 0.012, "_radps": 3.5e-4, "_rad": 3.5e-4, "_m": 0.015, "_n": 24.0}


def body_sigma(channel: str) -> float:
    """1 sigma of a good instrument for a motion of a body, SI; 0 for other channels."""
    return _ending(channel, _BODY)


def good_sigma(channel: str, readings: Floats) -> float:
    """1 sigma of a good instrument for any channel, SI, at the level of its readings.

    0 for a channel of a kind that nobody measures.
    """
    for start, (constant, share) in _PARTS.items():
        if channel.startswith(start):
            return float(np.hypot(constant, share * np.sqrt(np.mean(readings**2))))
    return body_sigma(channel) or _ending(channel, _OTHERS)


def _ending(channel: str, sigmas: dict[str, float]) -> float:
    return next((sigma for end, sigma in sigmas.items() if channel.endswith(end)), 0.0)

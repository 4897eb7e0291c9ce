"""What may act on the car beyond the foreign model, as numbers with a neutral value."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from proving_ground.layout import FloatArray
from proving_ground.switches import NEVER_S


class Acts(NamedTuple):
    """Effects at work; forces act at the center of gravity unless told otherwise. SI, y left."""

    drag_area: float
    drag_exponent: float           # with speed over 25 m/s
    grade: float
    bank: float                    # left side up
    slope_x_m: float
    slope_length_m: float
    gust_mps: float
    gust_s: float
    gust_length_s: float
    gust_steady: bool
    retarder_n: float              # at the rear wheels, throttle closed
    retarder_at_mps: float
    brake_gain: FloatArray         # per wheel
    brake_lag_s: FloatArray        # front, rear
    fade: FloatArray               # front, rear
    slippery_x_m: float            # from here on the second set of tires holds
    steer_lag_s: float
    steer_lag_stages: int
    ratio_error: float
    ratio_bend: float
    drag_wheel: int                # a bearing that seizes
    drag_nm: float
    shuffle_n: float
    shuffle_hz: float
    wake_n: float                  # side force that swings, 1.6 m behind
    corner_n: float                # drag at the left rear corner, at 25 m/s


def still() -> Acts:
    """Nothing at work."""
    return Acts(
        drag_area=0.0, drag_exponent=2.0, grade=0.0, bank=0.0, slope_x_m=NEVER_S,
        slope_length_m=20.0, gust_mps=0.0, gust_s=NEVER_S, gust_length_s=3.0, gust_steady=False,
        retarder_n=0.0, retarder_at_mps=0.0, brake_gain=np.ones(4), brake_lag_s=np.zeros(2),
        fade=np.zeros(2), slippery_x_m=NEVER_S, steer_lag_s=0.0, steer_lag_stages=1,
        ratio_error=0.0, ratio_bend=0.0, drag_wheel=-1, drag_nm=0.0, shuffle_n=0.0,
        shuffle_hz=2.3, wake_n=0.0, corner_n=0.0)

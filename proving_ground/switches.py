"""Every concealed effect as numbers with a neutral value: what the compiled code may switch on.

The names say what acts; which effect of which name sets them is told in `effects`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
NEVER_S = 1.0e9


class Switches(NamedTuple):
    """All effects; the defaults of `neutral()` change nothing."""

    flat_drag: float               # extra rolling resistance of a blown tire, times load
    flat_drag_even: bool           # the same from the first turn on, at every speed and load
    flat_cornering: float          # more of its cornering that a blown tire keeps
    hole_scale: float              # size of the hole of a commanded blowout
    hole_growth_s: float           # time for the hole to open fully
    second_tire: int               # tire that fails by itself, or -1
    second_time_s: float
    second_hole_m2: float
    linkage_soft: float            # part of the linkage stiffness lost at small moments
    linkage_harden: float          # relative stiffness gained per rad of wind-up
    ratio_error: float             # steering ratio off, relative: the road wheels turn more
    ratio_bend: float              # and more so away from straight ahead
    steer_lag_s: float             # the gear follows the hand wheel late
    steer_lag_stages: int          # as one or two first-order lags
    lash_half_rad: float           # extra play, half, at the road wheel
    lash_friction: float           # dry friction in the play, N m
    roll_steer: FloatArray         # per axle, rad per rad of axle roll
    relaxation: float              # extra relaxation length, relative
    relaxation_even: bool          # the same at every load
    saturation: FloatArray         # per axle, lost fraction of peak force
    friction_drop: float           # lost fraction of road friction
    friction_x_m: float            # where it begins
    friction_length_m: float       # over which length it falls
    gust_mps: float
    gust_s: float
    gust_length_s: float
    gust_steady: bool              # a wind that lasts, not a 1-cos gust
    gust_body: int                 # 0 tractor, 1 trailer
    gust_x_m: float                # center of the side area behind the unit's frame origin
    drag_area: FloatArray          # extra, tractor and trailer, m2
    grade: float                   # slope, uphill positive
    bank: float                    # cross slope, left side up positive
    slope_x_m: float               # where the slope begins; below zero: all along
    slope_length_m: float
    retarder_n: float
    retarder_at_mps: float         # speed at which it has 3/4 of its force; 0: constant
    slow_group: FloatArray         # per brake group: natural frequency rad/s, 0 neutral
    slow_delay: FloatArray         # per brake group, extra delay, s
    brake_gain: FloatArray         # per hub
    brake_hold: FloatArray         # per hub, pressure lost before the shoes touch, Pa
    fade: FloatArray               # per brake group, lost fraction when hot
    fade_k: float                  # temperature rise that costs 63 % of it
    misalign: FloatArray           # per axle, rad
    shift_m: float
    shift_s: float
    shift_length_s: float
    hitch_friction: float          # extra, N m
    hitch_sticking: float          # how much harder it sticks than it slides
    wake: float                    # side-force coefficient of an oscillating wake
    slosh: FloatArray              # mass kg, natural frequency rad/s, damping ratio
    flap_hub: int
    flap_n: float
    shuffle_n: float               # drive force oscillation
    shuffle_hz: float
    chute_area: float
    chute_y_m: float
    rut: float                     # guidance force per load
    rut_wave_m: float
    bearing_hub: int
    bearing_nm: float
    leak_n: float                  # air lost on the left drive springs


def neutral() -> Switches:
    """Nothing missing."""
    return Switches(
        flat_drag=0.0, flat_drag_even=False, flat_cornering=0.0, hole_scale=1.0, hole_growth_s=0.0,
        second_tire=-1, second_time_s=NEVER_S, second_hole_m2=0.0,
        linkage_soft=0.0, linkage_harden=0.0, ratio_error=0.0, ratio_bend=0.0, steer_lag_s=0.0,
        steer_lag_stages=1, lash_half_rad=0.0, lash_friction=0.0,
        roll_steer=np.zeros(5), relaxation=0.0, relaxation_even=False, saturation=np.zeros(5),
        friction_drop=0.0, friction_x_m=NEVER_S, friction_length_m=6.0,
        gust_mps=0.0, gust_s=NEVER_S, gust_length_s=1.0, gust_steady=False,
        gust_body=1, gust_x_m=6.0,
        drag_area=np.zeros(2), grade=0.0, bank=0.0, slope_x_m=-NEVER_S, slope_length_m=1.0,
        retarder_n=0.0, retarder_at_mps=16.0, slow_group=np.zeros(3), slow_delay=np.zeros(3),
        brake_gain=np.ones(10), brake_hold=np.zeros(10), fade=np.zeros(3), fade_k=90.0,
        misalign=np.zeros(5), shift_m=0.0, shift_s=NEVER_S, shift_length_s=1.0,
        hitch_friction=0.0, hitch_sticking=0.35, wake=0.0,
        slosh=np.array([0.0, 1.0, 0.1]), flap_hub=-1, flap_n=0.0,
        shuffle_n=0.0, shuffle_hz=2.0, chute_area=0.0, chute_y_m=1.2, rut=0.0, rut_wave_m=0.4,
        bearing_hub=-1, bearing_nm=0.0, leak_n=0.0,
    )

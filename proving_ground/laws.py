"""The form of a truck: which law each part follows, and the numbers of that law.

`usual()` is the form of the first world. Other forms are drawn by `proving_ground.forms`; a form is
constant through a case.

References: Rill, Road Vehicle Dynamics (2012), ch. 3 (TMeasy); Pacejka, Tire and Vehicle Dynamics
(2012), ch. 3 (brush) and 4 (Magic Formula, similarity of combined slip).
Known limits: one form for all tires of a truck; numbers of a law do not change with temperature.
"""

from __future__ import annotations

from typing import NamedTuple

TMEASY, MAGIC, BRUSH, DUGOFF, BURCKHARDT = 0, 1, 2, 3, 4
QUADRATIC, POWER, SINE = 0, 1, 2
STRETCH, LENGTH, LOADED = 0, 1, 2
DAHL, SMOOTH, LEAF = 0, 1, 2
POWERED, BLOW_OFF = 0, 1


class Laws(NamedTuple):
    """Laws and their numbers, SI. Loads are newtons, slips radians or relative."""

    family: int                    # TMEASY, MAGIC, BRUSH, DUGOFF, BURCKHARDT
    reference_n: float             # load at which the shares below hold
    slope_law: int                 # cornering stiffness over load: QUADRATIC, POWER, SINE
    slope: float                   # 1/rad: QUADRATIC load * (slope - drop * load)
    slope_drop: float              # 1/(rad N)
    slope_reference: float         # POWER and SINE: N/rad at 26.5 kN
    slope_shape: float             # POWER: exponent; SINE: load of the largest stiffness, N
    soft_gain: float               # stiffness gained per lost fill
    soft_loss: float               # and lost with its square
    slope_x: float                 # longitudinal stiffness over load
    slope_x_drop: float
    peak_x: float                  # friction on a dry road, along and across
    peak_x_drop: float
    peak_y: float
    peak_y_drop: float
    slide_x: float                 # sliding over peak
    slide_y: float
    slip_x: float                  # smallest slip of the peak (TMEASY)
    slip_y: float
    shape: float                   # Magic Formula C and E
    curvature: float
    trail: float                   # pneumatic trail over radius at no load, and its drop
    trail_drop: float
    trail_zero: float              # slip at which the trail is gone
    camber: float                  # camber thrust over load, per rad
    relaxation_law: int            # STRETCH: slope/stiffness; LENGTH: constant; LOADED: power
    relaxation: float              # N/m, or m
    relaxation_exponent: float
    relaxation_shrinks: float      # part of the length lost as the tire slides
    radial: float                  # N/m and N/m2 of one tire
    radial_rise: float
    carcass: float                 # radial stiffness kept without air
    rim_radius_m: float
    rim: float                     # N/m2 of the rim on the folded carcass
    rolling: float                 # rolling resistance, and its growth with speed squared
    rolling_rise: float
    rolling_soft: float            # gained as air is lost
    flat_drag: float               # rolling resistance on the rim
    flat_drag_exponent: float      # with speed over 20 m/s
    flat_keeps: float              # part of its cornering slope that a tire on its rim keeps
    flat_grip_lost: float
    polytropic: float
    hole_m2: float                 # of a commanded blowout
    hole_growth_s: float
    leaf_hardening: float          # steer leaf, 1/m2
    air_exponent: float            # drive air springs
    rebound: float                 # damper in rebound and in bump, over the sheet's
    bump: float
    damper_exponent: float         # force over speed to this power, as the sheet at 0.1 m/s
    damper_law: int                # POWERED so; BLOW_OFF: a valve opens beyond a speed
    blow_off_mps: float
    blow_off_share: float          # of the slope that is left then
    friction_law: int              # DAHL over a travel, SMOOTH over a speed, LEAF: DAHL that
                                   # grows with the load on the spring
    friction_travel_m: float
    friction_speed_mps: float
    unequal: float                 # share of a trailer spring that its partner does not take
    linkage_hardening: float       # linkage stiffness gained per rad of wind-up
    brake_linear: float            # brake torque per psi, and its drop
    brake_drop: float
    drag_exponent: float           # air drag over speed, as the sheet's area at 25 m/s


def usual() -> Laws:
    """The form of the first world; `flat_keeps` was set by a recorded blowout (validate)."""
    return Laws(
        family=TMEASY, reference_n=27.0e3, slope_law=QUADRATIC, slope=7.40, slope_drop=3.604e-5,
        slope_reference=170.8e3, slope_shape=0.9, soft_gain=0.62, soft_loss=0.15,
        slope_x=14.0, slope_x_drop=3.0, peak_x=0.80, peak_x_drop=0.10, peak_y=0.80,
        peak_y_drop=0.06, slide_x=0.74, slide_y=0.76, slip_x=0.13, slip_y=0.27,
        shape=1.4, curvature=0.0, trail=0.102, trail_drop=0.026, trail_zero=0.20, camber=0.12,
        relaxation_law=STRETCH, relaxation=380.0e3, relaxation_exponent=0.5,
        relaxation_shrinks=0.0, radial=900.0e3, radial_rise=1.2e6, carcass=0.087,
        rim_radius_m=0.375, rim=1.39e7, rolling=0.0047, rolling_rise=2.8e-6, rolling_soft=1.2,
        flat_drag=0.15, flat_drag_exponent=0.0, flat_keeps=0.08, flat_grip_lost=0.35,
        polytropic=1.25, hole_m2=0.0026, hole_growth_s=0.0, leaf_hardening=8.0, air_exponent=1.3,
        rebound=0.75, bump=1.25, damper_exponent=1.0, damper_law=POWERED,
        blow_off_mps=0.1, blow_off_share=0.3, friction_law=DAHL, friction_travel_m=0.0028,
        friction_speed_mps=0.02, unequal=0.08, linkage_hardening=0.0, brake_linear=158.0,
        brake_drop=0.12, drag_exponent=2.0)

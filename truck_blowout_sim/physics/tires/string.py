"""The carcass as a stretched string: slip that lags, and how far the string can be stretched.

The lagged slip is the string's stretch over its relaxation length. While the contact slides it may
be as large as the slip of that sliding. Once the motion that sustains it ends, no more than what
adhesion can hold stays stretched: peak force over stiffness, a few centimeters. Without that limit
a wheel locked to the end would keep a whole relaxation length and throw the truck back.

References: sigma ds/dt + |v| s = slip speed (Pacejka, Tire and Vehicle Dynamics, chapter 5); limit
of the deflection at the adhesion limit near standstill (chapter 8).
Known limits: one lag per direction; the limit of a flat tire is that of a whole one.
Validated with: test/physics/test_string.py (limit, direction, friction of a locked wheel, stops).
"""

from __future__ import annotations

import math

from truck_blowout_sim.physics.choose import seldom
from truck_blowout_sim.physics.jit import core

_LEAST_MPS = 1e-3  # of travel, in the slip of a sliding contact


@core
def lag(value: float, speed: float, drive: float, slope_n: float, stiffness_npm: float, dt: float
        ) -> tuple[float, float]:
    """Implicit step of length * ds/dt + |speed| s = drive: numerator and denominator of the new s.

    The relaxation length is the slope of the force over slip, by the stiffness of the carcass.
    """
    return (value * slope_n + dt * drive * stiffness_npm,
            slope_n + dt * abs(speed) * stiffness_npm)


@core
def kept_share(slip: float, slip_tan: float, grip_x: float, grip_y: float,
               slide_x_mps: float, slide_y_mps: float, speed_mps: float) -> float:
    """Share of the lagged slips that the string keeps, 1 up to the adhesion limit.

    ``grip_x, grip_y``: slope of the force over slip, divided by its peak; ``slide_x_mps,
    slide_y_mps``: slip speeds of the contact, of the signs of the slips they lead to.
    """
    x, y = slip * grip_x, slip_tan * grip_y
    square = x * x + y * y
    if not seldom(square > 1.0):
        return 1.0
    square = max(square, 1.0)
    travel = max(abs(speed_mps), _LEAST_MPS)
    # what the sliding of this moment sustains, along the stretch; 1 is what adhesion holds
    sustained = x * slide_x_mps * grip_x + y * slide_y_mps * grip_y
    return min(max(sustained, travel * math.sqrt(square)) / (travel * square), 1.0)

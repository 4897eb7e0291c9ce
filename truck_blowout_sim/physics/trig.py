"""Trigonometry that compiles into the step: polynomials instead of library calls.

Half of a step's time would go into calls of atan, sin and cos. These are as accurate (absolute
error under 1e-13 in their range), and being plain arithmetic they are inlined.

References: Cephes (Moshier), rational atan with two reductions; Taylor series folded to a quarter
turn.
Known limits: ``sine`` and ``cosine`` take angles within +-pi, as sin(C atan(x)) of a tire needs.
Validated with: test/physics/test_trig.py.
"""

from __future__ import annotations

import math

from truck_blowout_sim.physics.jit import core

_HALF_PI = 0.5 * math.pi
_QUARTER_PI = 0.25 * math.pi
_TAN_3_PI_8 = 2.414213562373095
_SMALL = 0.1


@core
def arctan(x: float) -> float:
    """atan(x) for any x."""
    size = abs(x)
    offset = 0.0
    if size > _TAN_3_PI_8:
        offset, size = _HALF_PI, -1.0 / size
    elif size > 0.66:
        offset, size = _QUARTER_PI, (size - 1.0) / (size + 1.0)
    z = size * size
    up = ((((-8.750608600031904122785e-1 * z - 1.615753718733365076637e1) * z
            - 7.500855792314704667340e1) * z - 1.228866684490136173410e2) * z
          - 6.485021904942025371773e1)
    down = (((((z + 2.485846490142306297962e1) * z + 1.650270098316988542046e2) * z
              + 4.328810604912902668951e2) * z + 4.853903996359136964868e2) * z
            + 1.945506571482613964425e2)
    angle = offset + size + size * z * up / down
    return angle if x >= 0.0 else -angle


@core
def sine(angle: float) -> float:
    """Sin of an angle within +-pi."""
    a = angle
    if a > _HALF_PI:
        a = math.pi - a
    elif a < -_HALF_PI:
        a = -math.pi - a
    z = a * a
    series = ((((((((z / 272.0 - 1.0) * z / 210.0 + 1.0) * z / 156.0 - 1.0) * z / 110.0 + 1.0)
                 * z / 72.0 - 1.0) * z / 42.0 + 1.0) * z / 20.0 - 1.0) * z / 6.0 + 1.0)
    return a * series


@core
def cosine(angle: float) -> float:
    """Cos of an angle within +-pi."""
    return sine(_HALF_PI - abs(angle))


@core
def turned(angle: float) -> tuple[float, float]:
    """Cosine and sine of an angle that is mostly small, such as a steer or roll angle."""
    if abs(angle) > _SMALL:
        return math.cos(angle), math.sin(angle)
    z = angle * angle
    c = ((((-z / 90.0 + 1.0) * z / 56.0 - 1.0) * z / 30.0 + 1.0) * z / 12.0 - 1.0) * z / 2.0 + 1.0
    s = ((((z / 72.0 - 1.0) * z / 42.0 + 1.0) * z / 20.0 - 1.0) * z / 6.0 + 1.0) * angle
    return c, s

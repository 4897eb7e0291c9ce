"""Trigonometry that compiles into the step: polynomials instead of library calls, no branches.

Half of a step's time would go into calls of atan, sin and cos. These are accurate to 2e-15, and
being plain arithmetic they are inlined and run on several tires at once.

References: polynomials interpolated at Chebyshev nodes of the reduced range; atan by one division,
reduced to tan(pi/8) as in Cephes (Moshier).
Known limits: ``sine`` and ``cosine`` take angles within +-pi, as sin(C atan(x)) of a tire needs.
Validated with: test/physics/test_trig.py.
"""

from __future__ import annotations

import math

from truck_blowout_sim.physics.choose import any_of, cosine_and_sine, nearest, seldom, where
from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.scalar import two_ratios

_HALF_PI = 0.5 * math.pi
_QUARTER_PI = 0.25 * math.pi
_TAN_PI_8 = math.tan(0.125 * math.pi)
_TAN_3_PI_8 = math.tan(0.375 * math.pi)
_SMALL = 0.1


@core
def arctan(x: float) -> float:
    """atan(x) for any x."""
    x0, rest = 0.0, x
    if seldom(abs(x) > _TAN_PI_8):
        x0, up, down = _reduced(x)
        rest = up / down
    return x0 + _small_arctan(rest)


@core
def arctans(x: float, y: float) -> tuple[float, float]:
    """atan(x) and atan(y), up to 1e150, by one division; small ones by none."""
    x0, x_rest, y0, y_rest = 0.0, x, 0.0, y
    if seldom(max(abs(x), abs(y)) > _TAN_PI_8):
        (x0, up, down), (y0, y_up, y_down) = _reduced(x), _reduced(y)
        x_rest, y_rest = two_ratios(up, down, y_up, y_down)
    return x0 + _small_arctan(x_rest), y0 + _small_arctan(y_rest)


@core
def _reduced(x: float) -> tuple[float, float, float]:
    """The angle from which atan(x) is reckoned, and what remains: the tangent's two parts."""
    size, side = abs(x), where(x >= 0.0, 1.0, -1.0)
    far, near = size > _TAN_3_PI_8, size <= _TAN_PI_8
    offset = side * where(far, _HALF_PI, where(near, 0.0, _QUARTER_PI))
    up = where(far, -side, where(near, x, x - side))
    return offset, up, where(far, size, where(near, 1.0, size + 1.0))


@core
def _small_arctan(t: float) -> float:
    """atan(t) within +-tan(pi/8)."""
    z = t * t
    zz = z * z
    # in pairs, which do not wait for each other
    low = (0.19999999997745024 * z - 0.3333333333333088
           + (0.11111089876389758 * z - 0.14285713934536187) * zz)
    high = (0.07681118384130886 * z - 0.09090261573547978
            + (0.05170740364194833 * z - 0.06551427046701526) * zz
            - 0.027261111235046032 * (zz * zz))
    series = low + high * (zz * zz)
    return t + t * z * series


@core
def sine(angle: float) -> float:
    """Sin of an angle within +-pi."""
    a = max(min(angle, math.pi - angle), -math.pi - angle)
    z = a * a
    zz = z * z
    low = (0.008333333333327423 * z - 0.16666666666666669
           + (2.7557318131656943e-06 * z - 0.00019841269836983394) * zz)
    high = 1.6051158052155064e-10 * z - 2.5051978354290848e-08 - 7.410491691126617e-13 * zz
    series = low + high * (zz * zz)
    return a + a * z * series


@core
def cosine(angle: float) -> float:
    """Cos of an angle within +-pi."""
    return sine(_HALF_PI - abs(angle))


@core
def heading(angle: float) -> tuple[float, float]:
    """Cosine and sine of any angle, such as a yaw angle after many turns."""
    rest = angle - 2.0 * math.pi * nearest(angle / (2.0 * math.pi))
    return cosine(rest), sine(rest)


@core
def turned(angle: float) -> tuple[float, float]:
    """Cosine and sine of an angle that is mostly small, such as a steer or roll angle."""
    z = angle * angle
    c = ((((-z / 90.0 + 1.0) * z / 56.0 - 1.0) * z / 30.0 + 1.0) * z / 12.0 - 1.0) * z / 2.0 + 1.0
    s = ((((z / 72.0 - 1.0) * z / 42.0 + 1.0) * z / 20.0 - 1.0) * z / 6.0 + 1.0) * angle
    far = abs(angle) > _SMALL
    if any_of(far):
        far_c, far_s = cosine_and_sine(angle)
        c, s = where(far, far_c, c), where(far, far_s, s)
    return c, s

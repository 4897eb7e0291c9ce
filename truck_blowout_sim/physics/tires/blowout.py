"""The state of a tire between inflated and flat on the rim, as multipliers and radii.

Two laws. Continuous: two scalars, the gauge pressure fraction q and the rim contact fraction rho,
drive stiffness, radii, cornering, aligning, camber and drag without steps. Steps: the thesis's ten
datasets swapped every 0.05 s (tables 9 and 10).

References: thesis L659-L733; values of the flat tire with their sources in config/blowout/*.yaml.
Known limits: no flailing tread, no bead unseating; the belt keeps driving the rolling radius;
rolling resistance steps by 2 % where pressure leaves a band of 5 % about its reference.
Validated with: test/physics/test_blowout.py (tables to the digit, continuity, non-monotonic
stiffness).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.choose import any_of, power_where, seldom, shared, where
from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import N_STEP_COLUMNS, TIRE, TIRE_S
from truck_blowout_sim.physics.scalar import clip, reached

Floats = NDArray[np.float64]


@core
def step_row(x: Floats, s: int, p: Floats, table: int) -> int:
    """Position of the step-table row in force; row 0 is the inflated tire."""
    blown, row = x[s + TIRE_S.blown_time_s] <= x[0], 0
    if any_of(blown):
        since = where(blown, x[0] - x[s + TIRE_S.blown_time_s], -1.0)
        for k in range(1, int(shared(p[table]))):
            row = where(reached(since, p[table + 1 + k * N_STEP_COLUMNS]), k, row)
    return table + 1 + row * N_STEP_COLUMNS


@core
def free_radius_m(p: Floats, t: int, row_radius_m: float, row_stiffness_npm: float) -> float:
    """Unloaded radius [m] by a row of a step table, whose radius is that under reference load."""
    return row_radius_m + p[t + TIRE.reference_load_n] / row_stiffness_npm


@core
def vertical_load(p: Floats, t: int, gauge_pa: float, height_m: float, sink_mps: float,
                  stepped: bool, row_free_m: float, row_stiffness_npm: float
                  ) -> tuple[float, float]:
    """Load [N] and deflection [m] of a tire whose center is ``height_m`` above the road.

    ``sink_mps`` is the rate of compression; ``stepped``: a row of a step table rules the tire, with
    its unloaded radius and stiffness.
    """
    sound = p[t + TIRE.stiffness_npm] + p[t + TIRE.stiffness_npmppa] * gauge_pa
    stiffness = where(stepped, row_stiffness_npm, sound)
    deflection = where(stepped, row_free_m, p[t + TIRE.unloaded_radius_m]) - height_m
    crush = p[t + TIRE.rim_contact_radius_m] - height_m
    rim = p[t + TIRE.rim_stiffness_npm] * crush + p[t + TIRE.rim_damping_nspm] * sink_mps
    rim = where(stepped | (crush <= 0.0), 0.0, rim)
    load = stiffness * deflection + p[t + TIRE.damping_nspm] * sink_mps + rim
    return where(deflection > 0.0, max(load, 0.0), 0.0), deflection


@core
def rim_fraction(p: Floats, t: int, height_m: float) -> float:
    """rho: 0 while the carcass is clear of the rim, 1 when flat on it."""
    return clip((p[t + TIRE.rim_radius_m] - height_m) / p[t + TIRE.rim_span_m], 0.0, 1.0)


@core
def inflated(p: Floats, t: int, gauge_pa: float) -> tuple[float, float]:
    """Gauge pressure as a share of the reference, and how far the carcass has lost its form.

    The second is 0 to 1, also while the carcass is clear of the rim.
    """
    reference, valid = p[t + TIRE.reference_pressure_pa], p[t + TIRE.pressure_valid]
    form = gauge_pa / (reference * valid)
    return form * valid, max(1.0 - form, 0.0)


@core
def rolling_radius_m(p: Floats, t: int, deflection_m: float, rim: float) -> float:
    """Effective rolling radius [m]: a flat steel belt still rolls its own length."""
    free = p[t + TIRE.unloaded_radius_m] - p[t + TIRE.radius_fraction] * max(deflection_m, 0.0)
    return free + rim * (p[t + TIRE.flat_radius_m] - free) + p[t + TIRE.radius_offset_m]


@core
def softness(p: Floats, t: int, gauge_pa: float) -> float:
    """Factor of rolling resistance at a pressure away from the reference one."""
    reference = p[t + TIRE.reference_pressure_pa]
    away = abs(gauge_pa - reference) > 0.05 * reference
    if not any_of(away):
        return 1.0
    share = max(gauge_pa / reference, 0.05)
    return where(away, power_where(away, share, -p[t + TIRE.rolling_pressure_exponent]), 1.0)


@core
def rolling_coefficient(p: Floats, t: int, collapse: float, deflection_m: float, rim: float,
                        speed_mps: float, soft: float) -> float:
    """Rolling resistance per load: (f0 + fV V) times `softness`, the flat's drag when collapsed.

    ``collapse``: the second of `inflated`.
    A carcass without air is folded as far as it is pressed: flat duals that carry little stop short
    of the rim and drag nearly as much as on it.
    """
    f = (p[t + TIRE.rolling_0] + p[t + TIRE.rolling_spm] * speed_mps) * soft
    if not seldom((collapse > 0.0) | (rim > 0.0)):
        return f
    way = p[t + TIRE.unloaded_radius_m] - p[t + TIRE.rim_radius_m]
    folded = collapse * clip(deflection_m / way, 0.0, 1.0)
    return f + max(rim, folded) * (p[t + TIRE.flat_rolling] * p[t + TIRE.flat_drag_scale] - f)

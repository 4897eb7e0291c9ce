"""Springs, dampers, leaf friction, stops and the equalised tandem between an axle and its body.

References: Fancher, Ervin, MacAdam, Winkler 1980 (leaf hysteresis, SAE 800905); values with sources
in config/vehicles.
Known limits: springs act vertically; brake reaction does not change the load share of a tandem;
the equaliser is massless and without friction of its own (leaf friction acts on axle travel).
Validated with: test/physics/test_suspension.py (rates, hysteresis loop area, equal share).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.choose import where
from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import AXLE, AXLE_S, UNIT_S, UNIT_W
from truck_blowout_sim.physics.scalar import clip, hysteresis

Floats = NDArray[np.float64]


@core
def travel_m(x: Floats, us: int, work: Floats, w: int, p: Floats, a: int, s: int, side: float,
             twist: float) -> float:
    """Compression [m] of the spring at ``side`` (+1 left) against the design attitude."""
    arm = side * p[a + AXLE.half_spacing_m]
    body = (x[us + UNIT_S.z_m] + work[w + UNIT_W.rzx] * p[a + AXLE.x_m]
            + work[w + UNIT_W.rzy] * arm + work[w + UNIT_W.rzz] * p[a + AXLE.roll_centre_z_m])
    axle = x[s + AXLE_S.z_m] + arm * x[s + AXLE_S.roll_rad]
    design = p[a + AXLE.roll_centre_height_m] - p[a + AXLE.center_height_m]
    return axle - (body + arm * twist) + design


@core
def travel_rate_mps(x: Floats, us: int, work: Floats, w: int, p: Floats, a: int, s: int,
                    side: float) -> float:
    """Rate of compression [m/s]; the frame twist's own rate is left to its damping."""
    arm = side * p[a + AXLE.half_spacing_m]
    rx, rz = p[a + AXLE.x_m], p[a + AXLE.roll_centre_z_m]
    pr, qr, rr = x[us + UNIT_S.p_radps], x[us + UNIT_S.q_radps], x[us + UNIT_S.r_radps]
    # exactly the rate of travel_m: in a turn a rolled body pitches about its own axis
    up = (work[w + UNIT_W.rzx] * (x[us + UNIT_S.u_mps] + qr * rz - rr * arm)
          + work[w + UNIT_W.rzy] * (x[us + UNIT_S.v_mps] + rr * rx - pr * rz)
          + work[w + UNIT_W.rzz] * (x[us + UNIT_S.w_mps] + pr * arm - qr * rx))
    return x[s + AXLE_S.vz_mps] + arm * x[s + AXLE_S.roll_rate_radps] - up


@core
def spring_force_n(p: Floats, a: int, travel: float) -> float:
    """Elastic force [N] of one side: preload, rate, jounce and rebound stops."""
    beyond = where(travel > p[a + AXLE.jounce_m], travel - p[a + AXLE.jounce_m],
                   where(travel < -p[a + AXLE.rebound_m], travel + p[a + AXLE.rebound_m], 0.0))
    return p[a + AXLE.preload_n] + p[a + AXLE.spring_npm] * travel + p[a + AXLE.stop_npm] * beyond


@core
def equalised_m(p: Floats, a: int, own: float, partner: float) -> float:
    """Spring travel after the equaliser has shared the difference of the two axles."""
    return own + clip(0.5 * (partner - own), -p[a + AXLE.equalizer_m], p[a + AXLE.equalizer_m])


@core
def side_force_n(x: Floats, s: int, p: Floats, a: int, side: float, travel: float, rate: float,
                 dt: float) -> float:
    """Force [N] pushing body and axle apart at one side; advances the leaf friction."""
    slot = s + (AXLE_S.friction_left_n if side > 0.0 else AXLE_S.friction_right_n)
    x[slot] = hysteresis(x[slot], rate * dt, p[a + AXLE.friction_n],
                         p[a + AXLE.friction_transition_m])
    return spring_force_n(p, a, travel) + p[a + AXLE.damping_nspm] * rate + x[slot]

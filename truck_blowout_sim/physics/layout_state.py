"""State blocks of a truck: global, units, axles, hubs, tires; and the topology's head.

Algebraic entries are results of the last step that the next one, or an observer, reads.

References: none, this is bookkeeping.
Known limits: see layout.py.
Validated with: test/physics/test_layout.py.
"""

from __future__ import annotations

from typing import NamedTuple


class Topology(NamedTuple):
    """Head of the integer topology vector; per-axle and per-tire entries follow."""

    n_units: int
    n_axles: int
    n_hubs: int
    n_tires: int
    n_state: int
    steered_axle: int  # -1: none
    axle_at: int  # first axle parameter
    hub_at: int
    tire_at: int
    table_at: int
    state_axle_at: int
    state_hub_at: int
    state_tire_at: int
    state_line_at: int  # brake delay lines
    line_length: int


class GlobalState(NamedTuple):
    """State that belongs to the whole truck; first in the state vector."""

    time_s: int
    line_position: int  # write position of the brake delay lines
    steer_rad: int  # mean road-wheel angle
    steer_command_rad: int  # what the hand wheel asks of it, after ratio and lag
    steer_rate_radps: int
    steer_friction_nm: int
    kingpin_moment_nm: int  # algebraic
    coupling_friction_nm: int
    coupling_fx_n: int  # algebraic, on unit 0, its axes
    coupling_fy_n: int
    coupling_fz_n: int
    coupling_roll_nm: int
    drive_force_n: int  # algebraic
    nonfinite: int  # 1 once a non-finite number was caught
    over_m: int  # rolled since the foremost axle met another friction


class UnitState(NamedTuple):
    """A sprung body: centre of gravity in map, velocity and acceleration in body axes."""

    x_m: int
    y_m: int
    z_m: int
    yaw_rad: int
    pitch_rad: int
    roll_rad: int
    u_mps: int
    v_mps: int
    w_mps: int
    p_radps: int
    q_radps: int
    r_radps: int
    twist_front_rad: int  # of the massless frame ends against the body
    twist_rear_rad: int
    ax_mps2: int  # inertial acceleration of the centre of gravity, body axes (algebraic)
    ay_mps2: int
    az_mps2: int
    pdot_radps2: int
    qdot_radps2: int
    rdot_radps2: int
    gx_mps2: int  # gravity in body axes (algebraic)
    gy_mps2: int
    gz_mps2: int


class AxleState(NamedTuple):
    """Axle bounce and roll, absolute; friction of its two springs."""

    z_m: int
    vz_mps: int
    roll_rad: int
    roll_rate_radps: int
    friction_left_n: int
    friction_right_n: int
    spring_left_n: int  # algebraic
    spring_right_n: int
    steer_rad: int  # algebraic: axle steer


class HubState(NamedTuple):
    """Wheel spin and brake of one hub."""

    spin_radps: int
    angle_rad: int
    chamber_pa: int
    heat_j: int
    released: int  # 1 while the ABS dumps this hub
    hold_s: int
    brake_nm: int  # algebraic
    drive_nm: int  # algebraic: of engine and retarder
    steer_rad: int  # algebraic: total road-wheel angle against the unit


class TireState(NamedTuple):
    """Slip deflections and gas of one tire."""

    slip: int  # longitudinal, lagged
    slip_tan: int  # tangent of the slip angle, lagged
    pressure_pa: int  # gauge
    blown_time_s: int  # inf: intact
    rim: int  # rim contact fraction rho (algebraic, used by the gas law one step later)
    fx_n: int  # algebraic, wheel axes
    fy_n: int
    fz_n: int
    mz_nm: int
    loaded_radius_m: int
    rolling_nm: int

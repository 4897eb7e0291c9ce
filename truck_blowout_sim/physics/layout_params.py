"""Parameter blocks of a truck without its tires: one NamedTuple a block, units in the names.

Field positions become numbers in layout.py.

References: none, this is bookkeeping.
Known limits: see layout.py.
Validated with: test/physics/test_layout.py.
"""

from __future__ import annotations

from typing import NamedTuple


class WorldParams(NamedTuple):
    """Air, gravity and road: one block, first in the parameter vector."""

    gravity_mps2: int
    air_density_kgpm3: int
    air_pressure_pa: int
    air_temperature_k: int
    wind_x_mps: int
    wind_y_mps: int
    road_grade_rad: int  # uphill along +x of map is positive
    road_bank_rad: int  # left side (+y) high is positive
    grade_change_rad: int  # added from its time on
    grade_change_time_s: int  # inf: never
    grade_change_ramp_s: int  # over which it eases in
    bank_change_rad: int
    bank_change_time_s: int
    bank_change_ramp_s: int
    road_roughness_m: int  # rms unevenness
    road_roughness_seed: int
    friction_scale: int  # whole road, all tires
    friction_change_scale: int  # from the place below on
    friction_change_x_m: int  # inf: never
    friction_change_time_s: int  # when the foremost axle meets it, elsewhere; inf: never
    patch_x0_m: int  # one friction patch, for split-friction roads
    patch_x1_m: int
    patch_y0_m: int
    patch_y1_m: int
    patch_scale: int


class SteeringParams(NamedTuple):
    """Steering system, one steered axle."""

    ratio: int
    offset_rad: int  # hand wheel zero: the reading at which the gear is straight
    stiffness_nmprad: int  # kingpin moment of both wheels per road-wheel angle, hand wheel held
    stiffness_gain: int  # 1 = as specified; a diagnosed compliance divides
    lash_rad: int  # total free play at the hand wheel
    lash_extra_rad: int  # 0; what a diagnosis adds
    damping_nmsprad: int
    friction_nm: int
    friction_transition_rad: int
    inertia_kgm2: int
    ackermann_fraction: int
    wheelbase_m: int
    kingpin_inclination_rad: int
    caster_rad: int
    kingpin_offset_m: int  # wheel plane to kingpin axis at spindle height
    compliance_on: int  # 0: road wheels follow the hand wheel exactly
    ratio_curve_prad2: int  # 0; the gear turns (1 + curve angle^2) times as far
    lag_s: int  # 0; first-order lag between hand wheel and gear


class CouplingParams(NamedTuple):
    """Fifth wheel between unit 0 and unit 1."""

    stiffness_xy_npm: int
    damping_xy_nspm: int
    stiffness_z_npm: int
    damping_z_nspm: int
    roll_stiffness_nmprad: int
    roll_damping_nmsprad: int
    roll_lash_rad: int  # +- free travel
    plate_half_width_m: int  # lash opens when the roll moment exceeds load times this
    yaw_friction_nm: int
    yaw_friction_transition_rad: int
    preload_z_n: int  # kingpin load at the design attitude, solved by packing


class DrivelineParams(NamedTuple):
    """Engine, retarder and driveline seen at the driven hubs."""

    power_w: int  # throttle 1
    max_force_n: int
    drag_n: int  # net engine drag at zero throttle
    drag_extra_n: int  # 0; what a diagnosis adds, scaled like drag_n
    drag_extra_nspm: int  # same, per speed
    retarder_n: int  # 0; holds back only while the throttle is as good as closed
    retarder_throttle: int  # at which it lets go
    creep_speed_mps: int  # below this speed drag fades to zero, force is held
    rolling_slip: int  # up to this slip power counts at road speed, from twice it at wheel speed
    clutch_open_time_s: int  # inf: closed throughout
    clutch_open_drag_n: int
    push_n: int  # external force on unit 0 at the road plane, where a speed is imposed; 0


class AbsParams(NamedTuple):
    """Anti-lock logic."""

    mode: int  # 0 off, 1 slip threshold a hub, 2 tractor 4S/4M and trailer 2S/1M
    slip_off: int
    slip_on: int
    cutout_speed_mps: int
    hold_s: int


class CircuitParams(NamedTuple):
    """A brake circuit: steer, drive or trailer, in this order."""

    delay_s: int
    delay_extra_s: int  # 0; what a diagnosis adds
    lag_s: int
    lag_extra_s: int  # 0; what a diagnosis adds
    enabled: int
    fade_per_j: int  # torque = nominal / (1 + fade * dissipated energy per hub)


class UnitParams(NamedTuple):
    """A sprung body with its cargo. Positions are from its centre of gravity, x forward."""

    mass_kg: int
    ixx_kgm2: int
    iyy_kgm2: int
    izz_kgm2: int
    ixy_kgm2: int
    ixz_kgm2: int
    iyz_kgm2: int
    cg_height_m: int  # above the road at the design attitude
    base_x_m: int  # base_link
    base_y_m: int
    base_z_m: int
    yaw_rate_gain: int  # 1; what the gyro there reads over the true yaw rate
    hitch_x_m: int  # fifth wheel or kingpin
    hitch_y_m: int
    hitch_z_m: int
    origin_x_m: int  # steer axle or kingpin
    torsion_front_nmprad: int  # frame torsion from the centre of gravity to what sits ahead of it
    torsion_rear_nmprad: int  # and to what sits behind it; 0: rigid
    torsion_damping_s: int  # time constant of the twist
    torsion_z_m: int  # axis of the twist, from the centre of gravity
    drag_area_m2: int
    drag_area_extra_m2: int  # 0; what a diagnosis adds
    drag_z_m: int
    side_area_m2: int  # side area times side force coefficient per rad of air angle
    side_x_m: int
    side_z_m: int
    gust_mps: int  # crosswind blowing towards +y in an interval
    gust_start_s: int
    gust_end_s: int
    gust_ramp_s: int
    gust_ahead_m: int  # how far the side force acts ahead of side_x_m while it blows
    gust_up_m: int  # how far above side_z_m
    gust_drag_share: int  # of the side force, that a gust pushes back
    payload_kg: int  # the part of mass that can shift
    payload_x_m: int
    payload_y_m: int
    payload_z_m: int
    payload_rear_share: int  # of its weight, standing on the rear end of the frame
    shift_x_m: int
    shift_y_m: int
    shift_start_s: int
    shift_duration_s: int
    probe_fx_n: int  # unexplained wrench at base_link, body axes, over an interval
    probe_fy_n: int
    probe_mz_nm: int
    probe_start_s: int
    probe_end_s: int
    probe_ramp_s: int
    probe_fx_v_nspm: int  # its laws, in this order for each component: speed, speed squared,
    probe_fx_vv_ns2pm2: int  # yaw rate times speed, roll
    probe_fx_vr_kg: int
    probe_fx_roll_nprad: int
    probe_fy_v_nspm: int
    probe_fy_vv_ns2pm2: int
    probe_fy_vr_kg: int
    probe_fy_roll_nprad: int
    probe_mz_v_ns: int
    probe_mz_vv_ns2pm: int
    probe_mz_vr_kgm: int
    probe_mz_roll_nmprad: int


class AxleParams(NamedTuple):
    """A solid axle. Positions from the unit's centre of gravity."""

    x_m: int
    mass_kg: int
    ixx_kgm2: int
    izz_kgm2: int
    roll_centre_z_m: int  # from the unit's centre of gravity, negative below
    roll_centre_height_m: int  # above the road at design
    center_height_m: int  # wheel centre above the road at design load
    half_track_m: int
    half_spacing_m: int
    spring_npm: int  # per side
    preload_n: int  # per side, at the design attitude; solved by packing
    damping_nspm: int
    friction_n: int  # Coulomb, per side
    friction_transition_m: int
    aux_roll_nmprad: int
    jounce_m: int
    rebound_m: int
    stop_npm: int
    equalizer_m: int  # +- travel of the equaliser; 0: none
    roll_steer: int  # rad of axle steer per rad of body roll against the axle
    roll_steer_extra: int  # 0; what a diagnosis adds
    drop_steer_radpm: int  # 0; rad per metre of mean suspension compression
    misalignment_rad: int
    peak_scale: int  # lateral saturation: scales peak lateral friction
    lateral_compliance_radpn: int  # 0; axle steer per lateral force
    behind_m: int  # the foremost axle, on a straight truck


class HubParams(NamedTuple):
    """One end of an axle: brake, bearing, static alignment."""

    y_m: int  # wheel centre (mean of duals) from the axle centre, left positive
    spin_inertia_kgm2: int
    toe_rad: int  # left positive steer of this wheel
    camber_rad: int  # top to the left (+y... lean) positive
    drive_share: int
    brake_linear_nmppa: int
    brake_quadratic_nmppa2: int
    brake_pushout_pa: int
    brake_gain: int
    brake_enabled: int

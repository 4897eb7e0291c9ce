"""What the compiled code reads and writes: named tuples of numbers and arrays.

`Views` are windows onto MuJoCo's own memory, `Truck` is constant through a run, `State` is ours
beside MuJoCo's, `Commands` are held from one sample to the next.
"""

from __future__ import annotations

from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

from proving_ground.individual import Individual
from proving_ground.laws import Laws
from proving_ground.multibody import Multibody
from proving_ground.sheet import PSI_PA, static_loads

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
ROAD_STEP_M = 0.1
DELAY_STEPS = 1400  # 1.17 s: a sound brake's delay and the latest that any case conceals


class Views(NamedTuple):
    """Arrays that live in MuJoCo."""

    qpos: FloatArray
    qvel: FloatArray
    qacc: FloatArray
    xpos: FloatArray
    xipos: FloatArray
    xmat: FloatArray
    cvel: FloatArray
    subtree_com: FloatArray
    xfrc: FloatArray
    qfrc: FloatArray
    sensors: FloatArray
    gravity: FloatArray


class Truck(NamedTuple):
    """Constants of one truck."""

    carrier: IntArray
    wheel: IntArray
    wheel_dof: IntArray
    wheel_qpos: IntArray
    heave: IntArray
    roll: IntArray
    kingpin: IntArray
    kingpin_qpos: IntArray
    hitch: int
    hitch_qpos: int
    payload: IntArray
    units: IntArray
    cornering: FloatArray          # per axle
    brake: FloatArray              # per hub
    camber_rad: FloatArray         # per hub, lean to the left
    duals: IntArray                # per axle: tires on one hub
    dual_half_m: float
    radius_m: float
    pressure_pa: float             # nominal, gauge
    preload_n: FloatArray          # per axle, one spring
    spring: FloatArray             # per axle
    damper: FloatArray
    coulomb: FloatArray
    spacing: FloatArray
    ratio: float
    linkage: float
    tie_rod: float
    lash_half_rad: float           # at the road wheel
    ackermann: float
    toe_rad: float
    kingpin_friction: float
    zero_rad: float
    hitch_friction: float
    drag_area: FloatArray          # tractor, trailer
    air_density: float
    air_height: float
    power_w: float
    engine_drag_n: float
    brake_delay_s: float
    brake_lag_s: float
    push_out_pa: float
    lashing: FloatArray            # stiffness, damping of the payload
    road: FloatArray               # left and right track unevenness over distance
    laws: Laws


class State(NamedTuple):
    """Our own states, all mutable arrays."""

    time: FloatArray               # [1]
    tire_fx: FloatArray            # 18
    tire_fy: FloatArray
    tire_fz: FloatArray
    pressure: FloatArray           # 18, absolute, Pa
    hole: FloatArray               # 18, effective hole area, m2
    blown_at: FloatArray           # 18, s, or inf
    flat_distance: FloatArray      # 18, m rolled since it was blown
    leaf: FloatArray               # 5 x 2 spring friction
    leaf_at: FloatArray            # 5 x 2 last deflection
    dry: FloatArray                # kingpin friction, hitch friction
    dry_at: FloatArray
    ring: FloatArray               # 3 x DELAY_STEPS control pressures
    ring_at: IntArray              # [1]
    chamber: FloatArray            # 10, Pa gauge
    line: FloatArray               # 10, pressure in a slow line before the chamber
    line_rate: FloatArray
    heat: FloatArray               # 10, K above ambient
    extra: FloatArray              # states of effects


class Commands(NamedTuple):
    """Held through one sample: hand wheel (rad), throttle, three control pressures (Pa)."""

    steering: float
    throttle: float
    steer_pa: float
    drive_pa: float
    trailer_pa: float


def views(model: mujoco.MjModel, data: mujoco.MjData) -> Views:
    """Windows onto a model's data; valid as long as `data` lives."""
    return Views(data.qpos, data.qvel, data.qacc, data.xpos, data.xipos, data.xmat, data.cvel,
                 data.subtree_com, data.xfrc_applied, data.qfrc_applied, data.sensordata,
                 model.opt.gravity)


def road_profile(seed: int) -> FloatArray:
    """Unevenness of two wheel tracks over 1.2 km: 1 mm rms in common, 0.1 mm of their own.

    Seed 0 is a perfectly even road.
    """
    if seed == 0:
        return np.zeros((2, 12000))
    rng = np.random.default_rng([seed, 23])
    both = _waves(rng, 2.2) + 0.3 * _waves(rng, 1.5)
    return 0.001 * np.stack([both + 0.1 * _waves(rng, 2.0), both + 0.1 * _waves(rng, 2.0)])


def _waves(rng: np.random.Generator, length_m: float) -> FloatArray:
    """Unit-variance unevenness correlated over a length."""
    kernel = np.exp(-0.5 * (np.arange(-90, 91) * ROAD_STEP_M / length_m) ** 2)
    kernel /= np.sqrt(np.sum(kernel**2))
    return np.convolve(rng.standard_normal(12000 + kernel.size - 1), kernel, "valid")


def truck(individual: Individual, body: Multibody) -> Truck:
    """Constants of an individual."""
    sheet = individual.sheet
    axles, steering, brake = sheet["axles"], sheet["steering"], sheet["brake"]
    model, aero = body.model, sheet["aero"]
    loads = static_loads(sheet).axle_n()
    position = {int(model.jnt_dofadr[i]): int(model.jnt_qposadr[i]) for i in range(model.njnt)}
    camber = np.zeros(10)
    camber[:2] = np.radians(steering["camber_deg"]) * np.array([1.0, -1.0])
    share = np.array([aero["tractor_share"], 1.0 - aero["tractor_share"]])
    lugs = np.array([1.0, 0.9, 0.9, 1.05, 1.05])
    lashing = sheet["payload_lashing"]

    def column(key: str) -> FloatArray:
        return np.array([float(axle[key]) for axle in axles])

    return Truck(
        carrier=body.carrier_bodies, wheel=body.wheel_bodies, wheel_dof=body.wheel_dofs,
        wheel_qpos=np.array([position[int(i)] for i in body.wheel_dofs]),
        heave=body.heave_dofs, roll=body.roll_dofs, kingpin=body.kingpin_dofs,
        kingpin_qpos=np.array([position[int(i)] for i in body.kingpin_dofs]),
        hitch=body.hitch_dof, hitch_qpos=position[body.hitch_dof],
        payload=body.payload_dofs, units=body.unit_bodies,
        cornering=lugs * individual.cornering_scale, brake=individual.brake_scale,
        camber_rad=camber, duals=np.array([2 if a["duals"] else 1 for a in axles]),
        dual_half_m=0.5 * sheet["dual_spacing_m"], radius_m=sheet["tire"]["free_radius_m"],
        pressure_pa=sheet["tire"]["nominal_pressure_psi"] * PSI_PA,
        preload_n=np.array([0.5 * (load - 9.81 * a["mass_kg"])
                            for load, a in zip(loads, axles, strict=True)]),
        spring=column("spring_n_per_m"), damper=column("damper_ns_per_m"),
        coulomb=column("coulomb_n"), spacing=column("spring_spacing_m"),
        ratio=steering["ratio"], linkage=steering["linkage_nm_per_rad"],
        tie_rod=steering["tie_rod_nm_per_rad"],
        lash_half_rad=float(np.radians(0.5 * steering["lash_handwheel_deg"])) / steering["ratio"],
        ackermann=steering["ackermann_per_rad"], toe_rad=float(np.radians(steering["toe_in_deg"])),
        kingpin_friction=steering["friction_nm"], zero_rad=individual.steering_zero_rad,
        hitch_friction=sheet["fifth_wheel"]["yaw_friction_nm"],
        drag_area=share * aero["drag_area_m2"] * individual.drag_scale,
        air_density=aero["air_density"], air_height=aero["height_m"],
        power_w=sheet["driveline"]["power_w"], engine_drag_n=sheet["driveline"]["drag_n"],
        brake_delay_s=brake["delay_s"], brake_lag_s=brake["lag_s"],
        push_out_pa=brake["push_out_psi"] * PSI_PA,
        lashing=np.array([lashing["stiffness_n_per_m"], lashing["damping_ns_per_m"]]),
        road=road_profile(individual.road_seed), laws=individual.laws,
    )


def new_state(individual: Individual) -> State:
    """States of a truck that rolls straight with nothing blown."""
    psi = individual.sheet["tire"]["nominal_pressure_psi"]
    zero18 = np.zeros(18)
    return State(
        time=np.zeros(1), tire_fx=zero18.copy(), tire_fy=zero18.copy(), tire_fz=zero18.copy(),
        pressure=101325.0 + psi * PSI_PA * individual.pressure_scale, hole=zero18.copy(),
        blown_at=np.full(18, np.inf), flat_distance=zero18.copy(),
        leaf=np.zeros((5, 2)), leaf_at=np.zeros((5, 2)), dry=np.zeros(4), dry_at=np.zeros(4),
        ring=np.zeros((3, DELAY_STEPS)), ring_at=np.zeros(1, dtype=np.int64),
        chamber=np.zeros(10), line=np.zeros(10), line_rate=np.zeros(10), heat=np.zeros(10),
        extra=np.zeros(16),
    )

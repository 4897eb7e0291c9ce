"""The combination as a MuJoCo model: bodies, joints and masses, no forces of its own.

Springs whose law is linear live here as joint stiffness; leaf springs, air springs, tires,
steering linkage, brakes and effects are in `forces`. Body frames stand parallel to the road frame
at rest, x forward, y left, z up; the steer axle's middle lies at x = 0.

References: Rill, Road Vehicle Dynamics (2012), ch. 3 and 7, for axles on a roll centre.
Known differences from a real truck: no cab suspension, no axle wind-up, rigid kingpin bushing.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from proving_ground.laws import Laws
from proving_ground.sheet import HUBS, static_loads

KNUCKLE_KG = 20.0


@dataclass(frozen=True)
class Multibody:
    """The compiled model with the places of its parts in MuJoCo's arrays."""

    model: mujoco.MjModel
    axle_bodies: NDArray[np.int64]
    carrier_bodies: NDArray[np.int64]      # per hub: the body that does not spin
    wheel_bodies: NDArray[np.int64]
    wheel_dofs: NDArray[np.int64]
    heave_dofs: NDArray[np.int64]
    roll_dofs: NDArray[np.int64]
    kingpin_dofs: NDArray[np.int64]
    hitch_dof: int
    payload_dofs: NDArray[np.int64]        # y slide of the two blocks
    unit_bodies: NDArray[np.int64]         # tractor front, tractor rear, trailer front, rear
    wheel_height_m: NDArray[np.float64]    # per axle, at rest


def tire_deflection_m(load_n: float, laws: Laws) -> float:
    """Static deflection of one inflated tire: the positive root of k1 d + k2 d^2 = load."""
    k1, k2 = laws.radial, laws.radial_rise
    return (-k1 + math.sqrt(k1 * k1 + 4.0 * k2 * load_n)) / (2.0 * k2)


def wheel_heights(sheet: dict[str, Any], laws: Laws) -> list[float]:
    """Height of each axle's wheel centers over the road under static load, m."""
    loads = static_loads(sheet).axle_n()
    counts = [4 if axle["duals"] else 2 for axle in sheet["axles"]]
    radius = sheet["tire"]["free_radius_m"]
    return [radius - tire_deflection_m(load / n, laws)
            for load, n in zip(loads, counts, strict=True)]


def build(sheet: dict[str, Any], step_s: float, laws: Laws) -> Multibody:
    """Compile the MuJoCo model of a sheet whose tires follow `laws`."""
    heights = wheel_heights(sheet, laws)
    model = mujoco.MjModel.from_xml_string(_document(sheet, heights, step_s))

    def body(name: str) -> int:
        return int(model.body(name).id)

    def dof(name: str) -> int:
        return int(model.joint(name).dofadr[0])

    names = [axle["name"] for axle in sheet["axles"]]
    carriers = [hub if hub.startswith("steer") else hub.rsplit("_", 1)[0] for hub in HUBS]
    return Multibody(
        model=model,
        axle_bodies=np.array([body(name) for name in names]),
        carrier_bodies=np.array([body(f"carrier_{n}" if n in HUBS else n) for n in carriers]),
        wheel_bodies=np.array([body(f"wheel_{hub}") for hub in HUBS]),
        wheel_dofs=np.array([dof(f"spin_{hub}") for hub in HUBS]),
        heave_dofs=np.array([dof(f"heave_{name}") for name in names]),
        roll_dofs=np.array([dof(f"roll_{name}") for name in names]),
        kingpin_dofs=np.array([dof("kingpin_left"), dof("kingpin_right")]),
        hitch_dof=dof("hitch_yaw"),
        payload_dofs=np.array([dof("payload_0_y"), dof("payload_1_y")]),
        unit_bodies=np.array([body(n) for n in
                              ("tractor", "tractor_rear", "trailer", "trailer_rear")]),
        wheel_height_m=np.array(heights),
    )


def _document(sheet: dict[str, Any], heights: list[float], step_s: float) -> str:
    """The MJCF text."""
    tractor = _tractor(sheet, heights)
    sensors = "".join(
        f'<{kind} {obj}="{unit}_base_link"/>'
        for unit in ("tractor", "trailer")
        for kind, obj in (("framepos", 'objtype="site" objname'),
                          ("framequat", 'objtype="site" objname'), ("velocimeter", "site"),
                          ("gyro", "site"), ("accelerometer", "site")))
    return f"""<mujoco><compiler angle="radian" inertiafromgeom="false" balanceinertia="true"/>
<option timestep="{step_s}" integrator="implicitfast" gravity="0 0 -9.81">
<flag contact="disable" constraint="disable"/></option>
<worldbody>{tractor}</worldbody><sensor>{sensors}</sensor></mujoco>"""


def _inertial(mass: float, pos: tuple[float, float, float], inertia: list[float]) -> str:
    x, y, z = pos
    ixx, iyy, izz = inertia
    return (f'<inertial mass="{mass}" pos="{x} {y} {z}" '
            f'diaginertia="{ixx} {iyy} {izz}"/>')


def _split(body: dict[str, Any], front_kg: float, front_x: float,
           front_ixx: float) -> tuple[tuple[float, float, list[float]], ...]:
    """Split a sprung body in two so that mass, centre and inertia of the whole stay."""
    rear_kg = body["mass_kg"] - front_kg
    rear_x = (body["mass_kg"] * body["cg_x_m"] - front_kg * front_x) / rear_kg
    ixx, iyy, izz = body["inertia_kgm2"]
    steiner = front_kg * (front_x - body["cg_x_m"]) ** 2 + rear_kg * (rear_x - body["cg_x_m"]) ** 2
    share = front_kg / body["mass_kg"]
    front = [front_ixx, share * (iyy - steiner), share * (izz - steiner)]
    rear = [ixx - front_ixx, (1 - share) * (iyy - steiner), (1 - share) * (izz - steiner)]
    return (front_kg, front_x, front), (rear_kg, rear_x, rear)


def _tractor(sheet: dict[str, Any], heights: list[float]) -> str:
    """Tractor front with free joint, tractor rear on the torsion joint, trailer behind."""
    t = sheet["tractor"]
    (kg_f, x_f, i_f), (kg_r, x_r, i_r) = _split(
        t, t["front_mass_kg"], t["front_cg_x_m"], t["front_ixx_kgm2"])
    link = t["base_link"]
    axles = sheet["axles"]
    return f"""<body name="tractor"><freejoint/>{_inertial(kg_f, (-x_f, 0, t["cg_z_m"]), i_f)}
<site name="tractor_base_link" pos="{-link["x_m"]} 0 {link["z_m"]}"/>
{_axle(axles[0], 0.0, heights[0], sheet)}
<body name="tractor_rear"><joint name="frame_tractor" type="hinge" axis="1 0 0"
 pos="{-t["torsion_x_m"]} 0 {t["torsion_z_m"]}" stiffness="{t["torsion_nm_per_rad"]}"
 damping="{t["torsion_damping"]}"/>{_inertial(kg_r, (-x_r, 0, t["cg_z_m"]), i_r)}
{_axle(axles[1], -axles[1]["x_m"], heights[1], sheet)}
{_axle(axles[2], -axles[2]["x_m"], heights[2], sheet)}{_trailer(sheet, heights)}</body></body>"""


def _trailer(sheet: dict[str, Any], heights: list[float]) -> str:
    """Trailer front on the fifth wheel, rear on the torsion joint; frame origin at the kingpin."""
    t, fifth = sheet["trailer"], sheet["fifth_wheel"]
    z0 = sheet["tractor"]["hitch_z_m"]
    (kg_f, x_f, i_f), (kg_r, x_r, i_r) = _split(
        t, 0.5 * t["mass_kg"], t["cg_x_m"] - 3.4, 0.5 * t["inertia_kgm2"][0])
    link = t["base_link"]
    axles = [_axle(a, -a["x_m"], h, sheet, z0) for a, h in
             zip(sheet["axles"][3:], heights[3:], strict=True)]
    return f"""<body name="trailer" pos="{-sheet["tractor"]["hitch_x_m"]} 0 {z0}">
<joint name="hitch_yaw" type="hinge" axis="0 0 1"/>
<joint name="hitch_pitch" type="hinge" axis="0 1 0" damping="{fifth["pitch_damping"]}"/>
<joint name="hitch_roll" type="hinge" axis="1 0 0" stiffness="{fifth["roll_nm_per_rad"]}"
 damping="{fifth["roll_damping"]}"/>{_inertial(kg_f, (-x_f, 0, t["cg_z_m"] - z0), i_f)}
<site name="trailer_base_link" pos="{-link["x_m"]} 0 {link["z_m"] - z0}"/>
{_payload(sheet, 0)}<body name="trailer_rear"><joint name="frame_trailer" type="hinge"
 axis="1 0 0" pos="{-t["torsion_x_m"]} 0 {t["torsion_z_m"] - z0}"
 stiffness="{t["torsion_nm_per_rad"]}" damping="{t["torsion_damping"]}"/>
{_inertial(kg_r, (-x_r, 0, t["cg_z_m"] - z0), i_r)}
{_payload(sheet, 1)}{"".join(axles)}</body></body>"""


def _payload(sheet: dict[str, Any], number: int) -> str:
    """A block held by its lashing: a stiff slide across the deck."""
    block, lashing = sheet["payload"][number], sheet["payload_lashing"]
    kg, (length, width, height) = block["mass_kg"], block["size_m"]
    inertia = [kg / 12 * (width**2 + height**2), kg / 12 * (length**2 + height**2),
               kg / 12 * (length**2 + width**2)]
    z = block["z_m"] - sheet["tractor"]["hitch_z_m"]
    return f"""<body name="payload_{number}" pos="{-block["x_m"]} 0 {z}">
<joint name="payload_{number}_y" type="slide" axis="0 1 0"
 stiffness="{lashing["stiffness_n_per_m"]}" damping="{lashing["damping_ns_per_m"]}"/>
{_inertial(kg, (0, 0, 0), inertia)}</body>"""


def _axle(axle: dict[str, Any], x: float, wheel_z: float, sheet: dict[str, Any],
          z0: float = 0.0) -> str:
    """A rigid axle: heave, then roll about the roll centre's axis (inclined for roll steer)."""
    knuckles = 0.0 if axle["duals"] else 2.0 * KNUCKLE_KG
    kg = axle["mass_kg"] - 2.0 * axle["wheel_mass_kg"] - knuckles
    half = 0.5 * axle["track_m"]
    spin = axle["spin_kgm2"]
    ixx = axle["ixx_kgm2"] - 2.0 * (axle["wheel_mass_kg"] * half**2 + 0.55 * spin)
    rc = axle["roll_centre_m"]
    wheels = "".join(_wheel_end(axle, side, wheel_z - rc, sheet) for side in (1, -1))
    return f"""<body name="{axle["name"]}" pos="{x} 0 {rc - z0}">
<joint name="heave_{axle["name"]}" type="slide" axis="0 0 1"/>
<joint name="roll_{axle["name"]}" type="hinge" axis="1 0 {-axle["roll_steer"]}"
 stiffness="{axle["roll_nm_per_rad"]}"/>
{_inertial(kg, (0, 0, wheel_z - rc), [max(ixx, 40.0), 15.0, max(ixx, 40.0)])}{wheels}</body>"""


def _wheel_end(axle: dict[str, Any], side: int, z: float, sheet: dict[str, Any]) -> str:
    """A spinning wheel, on a kingpin where the axle steers."""
    name = f"{axle['name']}_{'left' if side > 0 else 'right'}"
    spin, kg = axle["spin_kgm2"], axle["wheel_mass_kg"]
    half = 0.5 * axle["track_m"]
    steer = sheet["steering"]

    def wheel(y: float, height: float) -> str:
        return f"""<body name="wheel_{name}" pos="0 {y} {height}">
<joint name="spin_{name}" type="hinge" axis="0 1 0"/>
{_inertial(kg, (0, 0, 0), [0.55 * spin, spin, 0.55 * spin])}</body>"""

    if axle["name"] != "steer":
        return wheel(side * half, z)
    offset = steer["kingpin_offset_m"]
    lean = math.tan(math.radians(steer["kingpin_inclination_deg"]))
    caster = math.tan(math.radians(steer["caster_deg"]))
    own = 0.5 * steer["inertia_kgm2"] - 0.55 * spin - kg * offset**2
    return f"""<body name="carrier_{name}" pos="0 {side * (half - offset)} {z}">
<joint name="kingpin_{"left" if side > 0 else "right"}" type="hinge"
 axis="{-caster} {-side * lean} 1" damping="{0.5 * steer["damping_nms_per_rad"]}"/>
{_inertial(KNUCKLE_KG, (0, 0, 0), [3.0, 3.0, max(own, 3.0)])}{wheel(side * offset, 0.0)}</body>"""

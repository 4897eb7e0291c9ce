"""Rig plots of a vehicle's tires: force and moment against slip, inflated and flat."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from truck_blowout_sim.report.page import write_pictures
from truck_blowout_sim.report.style import BLUE, SKY, VERMILION, Picture, new_figure, styled
from truck_blowout_sim.simulation.tire_rig import tire_map
from truck_blowout_sim.vehicle import Packed

LARGEST_SLIP_DEG = 15.0
LOAD_SHARES = (0.5, 1.0, 1.5)  # of the load at rest
_INFLATED = (SKY, BLUE, "#003a5c")


@styled
def rig_picture(packed: Packed, tire: str, load_n: float) -> Picture:
    """Lateral force and aligning moment of one tire over slip angle.

    Args:
        packed: the vehicle.
        tire: name of the tire.
        load_n: its load at rest.
    """
    slip_rad = np.radians(np.linspace(0.0, LARGEST_SLIP_DEG, 61))
    loads = load_n * np.array(LOAD_SHARES)
    sound = tire_map(packed, tire, flat=False, slip_rad=slip_rad, load_n=loads)
    flat = tire_map(packed, tire, flat=True, slip_rad=slip_rad, load_n=loads)
    figure = new_figure((8.4, 3.6))
    force, moment = figure.subplots(1, 2)
    for k, load in enumerate(loads):
        label = f"inflated, {load / 1e3:.1f} kN"
        force.plot(np.degrees(slip_rad), sound.lateral_n[:, k] / 1e3, color=_INFLATED[k],
                   label=label)  # fmt: skip
        moment.plot(np.degrees(slip_rad), sound.aligning_nm[:, k], color=_INFLATED[k])
    at_rest = LOAD_SHARES.index(1.0)
    force.plot(np.degrees(slip_rad), flat.lateral_n[:, at_rest] / 1e3, color=VERMILION,
               label=f"flat on its rim, {load_n / 1e3:.1f} kN")  # fmt: skip
    moment.plot(np.degrees(slip_rad), flat.aligning_nm[:, at_rest], color=VERMILION)
    force.set(xlabel="slip angle (deg)", ylabel="lateral force (kN)")
    moment.set(xlabel="slip angle (deg)", ylabel="aligning moment (N m)")
    force.set_ylim(top=1.35 * force.get_ylim()[1])
    force.legend(loc="upper left", ncols=2)
    title = f"{tire}: {packed.vehicle.tire_specs[tire].title}"
    figure.suptitle(title)
    caption = "Steady rolling without camber on a dry road; positive where the tire restores."
    return Picture(f"rig_{tire}", title, caption, figure)


def write_rig_pictures(packed: Packed, loads_n: dict[str, float], folder: Path
                       ) -> tuple[Path, ...]:  # fmt: skip
    """Draw some tires of a vehicle into a folder, one PNG each.

    Args:
        packed: the vehicle.
        loads_n: load at rest of each tire to draw.
        folder: where the pictures go.

    Raises:
        StorageError: a picture cannot be written.
    """
    folder.mkdir(parents=True, exist_ok=True)
    pictures = tuple(rig_picture(packed, tire, load) for tire, load in loads_n.items())
    return write_pictures(pictures, folder)

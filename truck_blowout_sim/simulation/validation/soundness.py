"""What any sound simulation must give: loads, symmetry, energy, convergence, rest."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.simulation.drive import Drive, names_of, run_drive
from truck_blowout_sim.simulation.equilibrium import InitialState
from truck_blowout_sim.simulation.inputs import STANDSTILL
from truck_blowout_sim.simulation.run import prepare, simulate
from truck_blowout_sim.simulation.scenario import load_scenario
from truck_blowout_sim.simulation.truck import Truck
from truck_blowout_sim.simulation.validation.audit import audit
from truck_blowout_sim.simulation.validation.rows import Row
from truck_blowout_sim.vehicle import Packed
from truck_blowout_sim.vehicle.units import POUND_FORCE_N

_TARGETS_LB = {"steer": 11_925.0, "drive": 20_004.0, "trailer": 20_070.0}
_AUDITED = ("steer_axle_blowout", "trailer_step_steer_right", "brake_stop")
# signs under reflection in the middle plane
_ODD = ("_y_m", "yaw_rad", "roll_rad", "vy_mps", "yaw_rate_radps", "roll_rate_radps", "ay_mps2",
        "articulation_rad", "steer_rad", "tire_fy")


def soundness_rows(packed: Packed, *, weighed: bool) -> list[Row]:
    """All rows for one vehicle; ``weighed``: it stands for the truck whose axles were weighed."""
    return [*_loads(packed, weighed), _symmetry(packed), *_energy(packed), _halving(packed),
            _rest(packed)]


def axle_loads_lb(packed: Packed) -> dict[str, float]:
    """Load of the steer, drive and trailer axles, standing."""
    out = Truck(packed).outputs()
    vehicle = packed.vehicle
    loads = dict.fromkeys(_TARGETS_LB, 0.0)
    for tire in vehicle.tires:
        axle = vehicle.axle_of_hub(vehicle.hub_of_tire(tire))
        loads[vehicle.spec.axles[axle].circuit] += out[f"tire_fz_{tire}_n"] / POUND_FORCE_N
    return loads


def _loads(packed: Packed, weighed: bool) -> list[Row]:
    loads = axle_loads_lb(packed)
    return [
        Row("load", f"{group} axle{'s' if group != 'steer' else ''}, standing",
            f"{target:,.0f} lb ± 1 %",
            f"{loads[group]:,.0f} lb ({100 * (loads[group] / target - 1):+.2f} %)",
            abs(loads[group] / target - 1.0) < 0.01 if weighed else None,
            "" if weighed else "this mass set is 6,046 lb heavier")
        for group, target in _TARGETS_LB.items()
    ]


def symmetry_error(packed: Packed) -> float:
    """Largest difference between a run and its mirror image, in units of the channel's range.

    A blowout of the left trailer duals in a left turn against the right duals in a right turn. Both
    steer tires get the same camber: the truck's own differs by a quarter of a degree.
    """
    vehicle = packed.vehicle
    even = {f"hub.{h}.camber_rad": 0.0 for h in vehicle.hubs} | {"steering.offset_rad": 0.0}
    _, drive, _ = prepare(packed.with_values(even), load_scenario("trailer_step_steer"))
    truck = packed.with_values(even)
    return _mirror_difference(truck, drive)


def _mirror_difference(truck: Packed, drive: Drive) -> float:
    tires = truck.vehicle.tires
    swap = {t: t.replace("left", "#").replace("right", "left").replace("#", "right") for t in tires}
    other = replace(drive, inputs=drive.inputs * np.array([-1.0, 1.0, 1.0, 1.0, 1.0]),
                    blown=np.array([tires.index(swap[tires[b]]) for b in drive.blown], np.int64))
    here, there = run_drive(truck, drive), run_drive(truck, other)
    names = names_of(truck.vehicle)
    worst = 0.0
    for k, name in enumerate(names):
        image = name.replace("left", "#").replace("right", "left").replace("#", "right")
        sign = -1.0 if any(word in name for word in _ODD) else 1.0
        size = max(float(np.ptp(here[:, k])), 1.0)
        difference = np.abs(here[:, k] - sign * there[:, names.index(image)]).max()
        worst = max(worst, float(difference) / size)
    return worst


def _symmetry(packed: Packed) -> Row:
    error = symmetry_error(packed)
    return Row("mirror", "left and right blowout as mirror images", "1e-9 of a channel's range",
               f"{error:.1e}", error < 1e-9)


def _energy(packed: Packed) -> list[Row]:
    rows = []
    for name in _AUDITED:
        truck, drive, _ = prepare(packed, load_scenario(name))
        result = audit(truck, drive)
        rows.append(Row("energy", f"balance over {name}", "0.1 % of the energy at the start",
                        f"{100.0 * result.closure:.4f} %", result.closure < 1e-3))
    return rows


def _halving(packed: Packed) -> Row:
    runs: list[Recording] = [simulate(packed, "steer_axle_blowout", step_s=step)
                             for step in (0.001, 0.0005)]
    rates = [run["tractor_yaw_rate_radps"].value for run in runs]
    change = float(np.degrees(np.abs(rates[0] - rates[1]).max()))
    note = "" if change < 0.02 else "ten datasets swapped at once make jumps that no step resolves"
    return Row("step", "yaw rate with half the step, steer_axle_blowout", "under 0.02 deg/s",
               f"{change:.4f} deg/s", change < 0.02, note)


def _rest(packed: Packed) -> Row:
    truck = Truck(packed, initial=InitialState())
    start = truck.outputs()
    truck.advance(STANDSTILL, 60_000)
    end = truck.outputs()
    moved = 1000.0 * max(abs(end[f"{u}_{k}_m"] - start[f"{u}_{k}_m"])
                         for u in truck.vehicle.units for k in "xyz")
    load = max(abs(end[f"tire_fz_{t}_n"] - start[f"tire_fz_{t}_n"]) for t in truck.vehicle.tires)
    return Row("rest", "60 s standing", "no drift",
               f"{moved:.3f} mm, loads within {load:.1f} N", moved < 1.0 and load < 20.0)

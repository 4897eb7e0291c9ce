"""What the figures and tables of the thesis need: the record, our runs of its cases, tire maps.

Every case runs on two sheets: the test truck (mass set B) and the thesis's own (mass set A with the
ten-step tire swap).
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field

import numpy as np

from truck_blowout_sim.recordings import Recording, read_recording
from truck_blowout_sim.resources import config_dir
from truck_blowout_sim.simulation.run import simulate
from truck_blowout_sim.simulation.tire_rig import TireMap, tire_map
from truck_blowout_sim.vehicle import Packed, Vehicle, load_vehicle, pack

OURS, THESIS = "test truck (set B)", "thesis sheet (set A)"
SHEETS = {OURS: "international_9400i_trailmobile",
          THESIS: "international_9400i_trailmobile_thesis"}
RECORD, STEER, TURNS, MAPS = "record", "steer", "turns", "maps"
_TAILS = {"no blowout": "_no_blowout", "left duals": "", "right duals": "_right",
          "left outer": "_left_outer_dual"}
_SLIP_RAD = np.radians(np.linspace(0.0, 20.0, 41))
_LOAD_N = np.linspace(0.0, 50_000.0, 11)


@dataclass(frozen=True)
class ThesisData:
    """Whatever was asked for; the rest is empty.

    Attributes:
        vehicles: the two sheets.
        record: the rebuilt log of the 2013 test.
        steer: the steer axle blowout, by sheet.
        turns: the step steer cases on the test truck, by axle (trailer, drive) and case.
        maps: tire maps of the left steer tire, by sheet and whether flat.
    """

    vehicles: Mapping[str, Vehicle]
    record: Recording | None = None
    steer: Mapping[str, Recording] = field(default_factory=dict)
    turns: Mapping[tuple[str, str], Recording] = field(default_factory=dict)
    maps: Mapping[tuple[str, bool], TireMap] = field(default_factory=dict)


def thesis_data(parts: Collection[str], progress: Callable[[str], None] = lambda words: None
                ) -> ThesisData:
    """Run the cases that some figures need.

    Args:
        parts: any of RECORD, STEER, TURNS, MAPS.
        progress: called with what is being done.
    """
    vehicles = {sheet: load_vehicle(name) for sheet, name in SHEETS.items()}
    packed = {sheet: pack(vehicle) for sheet, vehicle in vehicles.items()}
    record = None
    if RECORD in parts or STEER in parts:
        record = read_recording(config_dir() / "recordings" / "test_2013_steer_blowout.csv")
    steer: dict[str, Recording] = {}
    if STEER in parts:
        for sheet, truck in packed.items():
            progress(f"steer axle blowout, {sheet}")
            steer[sheet] = simulate(truck, "steer_axle_blowout")
    turns = _turns(packed[OURS], progress) if TURNS in parts else {}
    maps: dict[tuple[str, bool], TireMap] = {}
    if MAPS in parts:
        progress("tire maps")
        maps = {(sheet, flat): tire_map(truck, "steer_left", flat=flat, slip_rad=_SLIP_RAD,
                                        load_n=_LOAD_N)
                for sheet, truck in packed.items() for flat in (False, True)}
    return ThesisData(vehicles, record, steer, turns, maps)


def _turns(truck: Packed, progress: Callable[[str], None]) -> dict[tuple[str, str], Recording]:
    runs = {}
    for axle in ("trailer", "drive"):
        for case, tail in _TAILS.items():
            progress(f"{axle} axle, {case}")
            runs[axle, case] = simulate(truck, f"{axle}_step_steer{tail}")
    return runs

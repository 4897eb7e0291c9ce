"""Tire blowouts of a tractor-semitrailer: simulate, compare with a recording, diagnose.

    from truck_blowout_sim import load_vehicle, simulate

    vehicle = load_vehicle("international_9400i_trailmobile")
    recording = simulate(vehicle, "steer_axle_blowout")

Every name in `__all__` is public. They are imported on first use, so that importing the package
costs nothing and reading recordings does not start the compiler.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from truck_blowout_sim.comparison import compare
    from truck_blowout_sim.diagnosis import calibrate, diagnose
    from truck_blowout_sim.errors import InputError
    from truck_blowout_sim.recordings import (
        Blowout,
        Recording,
        Series,
        read_recording,
        write_recording,
    )
    from truck_blowout_sim.simulation import (
        Batch,
        InitialState,
        Inputs,
        Scenario,
        Truck,
        load_scenario,
        simulate,
        simulate_batch,
        simulate_inputs,
    )
    from truck_blowout_sim.vehicle import Packed, Vehicle, load_vehicle, pack

__version__ = "0.1.0"

__all__ = [
    "Batch",
    "Blowout",
    "InitialState",
    "InputError",
    "Inputs",
    "Packed",
    "Recording",
    "Scenario",
    "Series",
    "Truck",
    "Vehicle",
    "calibrate",
    "compare",
    "diagnose",
    "load_scenario",
    "load_vehicle",
    "pack",
    "read_recording",
    "simulate",
    "simulate_batch",
    "simulate_inputs",
    "write_recording",
]

_ROOMS = {
    "comparison": ("compare",),
    "diagnosis": ("calibrate", "diagnose"),
    "errors": ("InputError",),
    "recordings": ("Blowout", "Recording", "Series", "read_recording", "write_recording"),
    "simulation": ("Batch", "InitialState", "Inputs", "Scenario", "Truck", "load_scenario",
                   "simulate", "simulate_batch", "simulate_inputs"),
    "vehicle": ("Packed", "Vehicle", "load_vehicle", "pack"),
}
_ROOM_OF = {name: room for room, names in _ROOMS.items() for name in names}


def __getattr__(name: str) -> object:
    if name not in _ROOM_OF:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_ROOM_OF[name]}"), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})

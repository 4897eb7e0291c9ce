"""The vehicle that a run is drawn with, where the user names none."""

from __future__ import annotations

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.recordings.names import parts_of
from truck_blowout_sim.resources import config_names
from truck_blowout_sim.vehicle import Vehicle, load_vehicle

DEFAULT_VEHICLE = "international_9400i_trailmobile"


def vehicle_of(run: Recording, wanted: str | None) -> tuple[Vehicle, str]:
    """The vehicle to draw for a run, and a sentence where it had to be guessed.

    Args:
        run: its metadata may name its vehicle.
        wanted: what the user asked for.

    Raises:
        InputError: the vehicle that the user asked for cannot be loaded.
    """
    fitting = fitting_vehicle(run, wanted)
    return fitting or (load_vehicle(DEFAULT_VEHICLE),
                       f"vehicle: {DEFAULT_VEHICLE}, none fits the recording")  # fmt: skip


def fitting_vehicle(run: Recording, wanted: str | None) -> tuple[Vehicle, str] | None:
    """As `vehicle_of`, but None where no shipped vehicle has the tires and hubs of the run."""
    if wanted is not None:
        return load_vehicle(wanted), ""
    named = run.metadata.get("vehicle", "")
    if named:
        try:
            return load_vehicle(named), ""
        except InputError:
            pass
    parts = parts_of(run.channels)
    tires = {*parts.tires, *(tire for event in run.blowouts for tire in event.tires)}
    for name in dict.fromkeys((DEFAULT_VEHICLE, *config_names("vehicles"))):
        vehicle = load_vehicle(name)
        if set(parts.hubs) <= set(vehicle.hubs) and tires <= set(vehicle.tires):
            return vehicle, f"vehicle: {name}, the recording names no vehicle file"
    return None

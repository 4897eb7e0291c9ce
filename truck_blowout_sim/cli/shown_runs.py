"""What `plot` and `view` share: runs by path or name, and the vehicle each of them drove."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from truck_blowout_sim.comparison.sources import find_recording
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Recording, read_recording
from truck_blowout_sim.recordings.names import parts_of
from truck_blowout_sim.resources import config_names
from truck_blowout_sim.vehicle import Vehicle, load_vehicle

DEFAULT_VEHICLE = "international_9400i_trailmobile"


def read_runs(words: Sequence[str], mapping: Path | None = None) -> list[Recording]:
    """Recordings by path or shipped name, in any format; two of one name are told apart.

    Args:
        words: paths or names.
        mapping: mapping file for those that it fits; runs under our own names are read without.

    Raises:
        InputError: one cannot be read.
    """
    runs: list[Recording] = []
    for word in words:
        run = _read(find_recording(word), mapping)
        same = sum(run.name == other.name for other in runs)
        runs.append(replace(run, name=f"{run.name} ({word})") if same else run)
    return runs


def _read(path: Path, mapping: Path | None) -> Recording:
    if mapping is None:
        return read_recording(path)
    try:
        return read_recording(path, mapping=mapping)
    except InputError:
        try:
            return read_recording(path)
        except InputError:
            pass
        raise


def vehicle_of(run: Recording, wanted: str | None) -> tuple[Vehicle, str]:
    """The vehicle to draw for a run, and a sentence where it had to be guessed.

    Args:
        run: its metadata may name its vehicle.
        wanted: what the user asked for.

    Raises:
        InputError: the vehicle that the user asked for cannot be loaded.
    """
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
    return load_vehicle(DEFAULT_VEHICLE), f"vehicle: {DEFAULT_VEHICLE}, none fits the recording"

"""Checks of tires and of the blowout law."""

from __future__ import annotations

from itertools import pairwise

from truck_blowout_sim.physics.layout import STEP_COLUMNS
from truck_blowout_sim.vehicle.document import Place
from truck_blowout_sim.vehicle.packing.formula import loaded_radius_m
from truck_blowout_sim.vehicle.schema.tire import (
    BlowoutSpec,
    RimSpec,
    StepTableSpec,
    TireMapSpec,
    TireSpec,
)
from truck_blowout_sim.vehicle.vehicle import Vehicle


def check_blowout(vehicle: Vehicle, place: Place) -> None:
    """Check the law alone.

    Raises:
        InputError: radii out of order, or a table of steps that cannot be walked.
    """
    law = vehicle.blowout
    _check_rim(law, place)
    if law.law == "steps":
        if law.steps is None:
            raise place.error("law steps has no table", "a steps section in the blowout file")
        _check_steps(law.steps, place)


def _check_rim(rim: RimSpec | BlowoutSpec, place: Place) -> None:
    if rim.rim_span_m >= rim.rim_radius_m:
        raise place.error("rim_span_m reaches the hub", f"less than {rim.rim_radius_m:g} m")
    if rim.rim_contact_radius_m > rim.rim_radius_m:
        raise place.error(
            "rim_contact_radius_m is above rim_radius_m", f"at most {rim.rim_radius_m:g} m"
        )


def _check_steps(steps: StepTableSpec, place: Place) -> None:
    lengths = {name: len(getattr(steps, name)) for name in STEP_COLUMNS}
    longest = max(lengths.values())
    for name, length in lengths.items():
        if length != longest or length < 2:
            raise place.error(f"steps.{name} has {length} entries", f"{max(longest, 2)}, as all")
    times = steps.time_s
    if times[0] != 0.0 or any(b <= a for a, b in pairwise(times)):
        raise place.error("steps.time_s does not run", "0 first, then growing instants")
    if min(steps.radius_m) <= 0.0 or min(steps.stiffness_npm) <= 0.0:
        raise place.error("steps hold a radius or stiffness of zero", "numbers greater than 0")


def check_tire(vehicle: Vehicle, tire: str, place: Place) -> None:
    """Check one tire under its load at rest and on its rim.

    Raises:
        InputError: a tire that cannot carry or has no numbers for its model.
    """
    spec, file, law = vehicle.tire_specs[tire], vehicle.tire_files[tire], vehicle.blowout
    rim = vehicle.rim(tire)
    if spec.rim is not None:
        _check_rim(rim, place)
    if spec.stiffness_npm + spec.stiffness_npmppa * spec.pressure_pa <= 0.0:
        raise place.error(f"{file} for {tire} has no radial stiffness", "stiffness or pressure")
    if loaded_radius_m(spec, spec.reference_load_n) <= rim.rim_radius_m and law.law == "continuous":
        raise place.error(
            f"{file} for {tire} stands on its rim under its reference load",
            f"a loaded radius above its rim_radius_m, {rim.rim_radius_m:g} m",
        )
    if spec.model == "linear" and spec.linear_cornering_nprad <= 0.0:
        raise place.error(
            f"{file} for {tire} is linear without stiffness", "linear_cornering_nprad above 0"
        )
    if spec.map is not None:
        _check_map(spec, spec.map, file, place)


def _check_map(spec: TireSpec, given: TireMapSpec, file: str, place: Place) -> None:
    loads, size = int(given.loads), len(given.lateral_n)
    if spec.model != "map":
        raise place.error(f"{file} gives a map its model does not read", "model: map")
    if loads < 2 or loads != given.loads or size % loads or size < 2 * loads:
        raise place.error(
            f"map of {file} has {size} forces for {given.loads:g} loads",
            "whole rows, two loads and two slip angles at least",
        )
    if len(given.aligning_nm) != size:
        raise place.error(
            f"map of {file} has {len(given.aligning_nm)} moments", f"{size}, one a force"
        )

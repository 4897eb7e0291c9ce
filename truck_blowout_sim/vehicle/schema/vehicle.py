"""The top of a vehicle file."""

# ruff: noqa: RUF009 (section() is a dataclasses.field)
from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from truck_blowout_sim.vehicle.fields import choice, section, sections, text
from truck_blowout_sim.vehicle.schema.axle import AxleSpec
from truck_blowout_sim.vehicle.schema.body import FifthWheelSpec, UnitSpec
from truck_blowout_sim.vehicle.schema.controls import (
    AbsSpec,
    CircuitsSpec,
    DrivelineSpec,
    SteeringSpec,
)

BRAKES = ("air", "hydraulic")


@dataclass(frozen=True, kw_only=True)
class UnitsSpec:
    """One or two units."""

    tractor: UnitSpec = section(UnitSpec, "the unit in front, whatever it is")
    trailer: UnitSpec | None = section(UnitSpec, "the unit behind", optional=True)


@dataclass(frozen=True, kw_only=True)
class VehicleSpec:
    """Everything a vehicle file says; tires, blowout and road name other files."""

    title: str = text("one line a person reads")
    units: UnitsSpec = section(UnitsSpec, "sprung bodies")
    axles: Mapping[str, AxleSpec] = sections(AxleSpec, "axles, front to rear", required=True)
    tires: Mapping[str, Any] = sections(
        None, "tire file of an axle, a hub or a tire; the narrowest entry counts", required=True
    )
    blowout: str = text("blowout file")
    road: str = text("road file it stands on unless a scenario says otherwise")
    driveline: DrivelineSpec = section(DrivelineSpec, "engine and driveline")
    abs: AbsSpec = section(AbsSpec, "anti-lock control")
    brakes: str = choice(
        "what is in the brake lines: says how high control pressures may be", BRAKES, default="air"
    )
    circuits: CircuitsSpec = section(CircuitsSpec, "brake circuits")
    steering: SteeringSpec | None = section(SteeringSpec, "steering", optional=True)
    fifth_wheel: FifthWheelSpec | None = section(FifthWheelSpec, "fifth wheel", optional=True)

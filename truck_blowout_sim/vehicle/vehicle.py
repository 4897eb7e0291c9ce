"""A vehicle as the rest of the package sees it: names, typed sections, sources."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from truck_blowout_sim.vehicle.document import Place
from truck_blowout_sim.vehicle.schema.axle import AxleSpec
from truck_blowout_sim.vehicle.schema.body import UnitSpec
from truck_blowout_sim.vehicle.schema.road import RoadSpec
from truck_blowout_sim.vehicle.schema.tire import BlowoutSpec, RimSpec, TireSpec
from truck_blowout_sim.vehicle.schema.vehicle import VehicleSpec

SIDES = ("left", "right")
DUALS = ("outer", "inner")


@dataclass(frozen=True)
class Effect:
    """A parameter set by its packed name, over what the sections say."""

    value: float
    source: str
    place: Place


@dataclass(frozen=True)
class Vehicle:
    """A loaded and checked vehicle.

    Attributes:
        name: stem of its file.
        path: the file.
        spec: its sections in SI.
        tire_specs: the kind of each tire, by tire name.
        tire_files: the tire file of each tire, by tire name.
        blowout: the blowout law.
        road: the road it stands on.
        effects: parameters set by packed name, such as `hub.trailer_2_left.brake_gain`.
        sources: where each value comes from, by dotted SI key; of tire, blowout and road files
            under `tires.<file>.`, `blowout.` and `road.`.
        spreads: how far the truth may lie from a value, one standard deviation in SI, by the same
            keys; what has none is known as well as others of its kind.
    """

    name: str
    path: Path
    spec: VehicleSpec
    tire_specs: Mapping[str, TireSpec]
    tire_files: Mapping[str, str]
    blowout: BlowoutSpec
    road: RoadSpec
    effects: Mapping[str, Effect] = field(default_factory=dict)
    sources: Mapping[str, str] = field(default_factory=dict)
    spreads: Mapping[str, float] = field(default_factory=dict)

    @property
    def title(self) -> str:
        """One line a person reads."""
        return self.spec.title

    @cached_property
    def unit_specs(self) -> Mapping[str, UnitSpec]:
        """Sections of the units, front to rear."""
        units = {"tractor": self.spec.units.tractor}
        if self.spec.units.trailer is not None:
            units["trailer"] = self.spec.units.trailer
        return units

    @property
    def units(self) -> tuple[str, ...]:
        """Names of the units, front to rear."""
        return tuple(self.unit_specs)

    @property
    def axles(self) -> tuple[str, ...]:
        """Names of the axles, front to rear."""
        return tuple(self.spec.axles)

    @cached_property
    def hubs(self) -> tuple[str, ...]:
        """Names of the hubs: every axle's left one, then its right one."""
        return tuple(hub for axle in self.axles for hub in hubs_of_axle(axle))

    @cached_property
    def tires(self) -> tuple[str, ...]:
        """Names of the tires, hub by hub, outer before inner."""
        return tuple(tire for hub in self.hubs for tire in self.tires_of_hub(hub))

    def tires_of_hub(self, hub: str) -> tuple[str, ...]:
        """Names of the tires a hub carries.

        Raises:
            KeyError: no hub of this name.
        """
        return tires_of_hub(hub, self.spec.axles[self.axle_of_hub(hub)])

    def axle_of_hub(self, hub: str) -> str:
        """Name of the axle a hub belongs to.

        Raises:
            KeyError: no hub of this name.
        """
        if hub not in self.hubs:
            raise KeyError(hub)
        return self.axles[self.hubs.index(hub) // 2]

    def rim(self, tire: str) -> RimSpec | BlowoutSpec:
        """What a tire does on its rim: its own numbers, else those of the blowout file.

        Raises:
            KeyError: no tire of this name.
        """
        return self.tire_specs[tire].rim or self.blowout

    def hub_of_tire(self, tire: str) -> str:
        """Name of the hub a tire sits on.

        Raises:
            KeyError: no tire of this name.
        """
        for hub in self.hubs:
            if tire in self.tires_of_hub(hub):
                return hub
        raise KeyError(tire)


def hubs_of_axle(axle: str) -> tuple[str, ...]:
    """Names of the two hubs of an axle."""
    return tuple(f"{axle}_{side}" for side in SIDES)


def tires_of_hub(hub: str, axle: AxleSpec) -> tuple[str, ...]:
    """Names of the tires of a hub: itself, or its two duals."""
    return tuple(f"{hub}_{dual}" for dual in DUALS) if axle.dual_spacing_m else (hub,)

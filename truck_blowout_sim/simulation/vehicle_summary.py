"""What a vehicle file amounts to: masses, loads, handling, and what rules of thumb filled in."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from math import degrees

from truck_blowout_sim.errors import InputError, nearest, quoted
from truck_blowout_sim.simulation.handling import Handling, handling
from truck_blowout_sim.vehicle import Vehicle
from truck_blowout_sim.vehicle.given import AnyVehicle, packed_of
from truck_blowout_sim.vehicle.masses import unit_mass
from truck_blowout_sim.vehicle.single_track import RULE
from truck_blowout_sim.vehicle.statics import static_loads
from truck_blowout_sim.vehicle.units import MILE_PER_HOUR_MPS, POUND_KG


@dataclass(frozen=True)
class FilledIn:
    """A value that nobody stated.

    Attributes:
        key: dotted SI key.
        value, spread: SI; the spread is one standard deviation, 0 where the rule says none.
        source: the rule's source.
    """

    key: str
    value: float
    spread: float
    source: str


@dataclass(frozen=True)
class VehicleSummary:
    """A vehicle in a dozen numbers.

    Attributes:
        name, title: of the file.
        mass_kg: by unit, axles included.
        hitch_load_kg: what the trailer lays on the fifth wheel.
        axle_load_kg: at rest on a level road, by axle.
        tire_load_n: at rest, of one tire of each axle.
        handling: in a gentle turn; None where nothing is steered.
        filled_in: values by rule of thumb.
        stated_spreads: how many values state a spread of their own.
    """

    name: str
    title: str
    mass_kg: Mapping[str, float]
    hitch_load_kg: float
    axle_load_kg: Mapping[str, float]
    tire_load_n: Mapping[str, float]
    handling: Handling | None
    filled_in: tuple[FilledIn, ...]
    stated_spreads: int

    def to_json(self) -> dict[str, object]:
        """Plain data."""
        return asdict(self)

    def lines(self) -> Iterator[str]:
        """The summary as a person reads it."""
        yield self.title
        for unit, mass in self.mass_kg.items():
            yield f"  {unit}: {_mass(mass)}"
        if self.hitch_load_kg:
            yield f"  on the fifth wheel: {_mass(self.hitch_load_kg)}"
        yield "axle loads at rest"
        for axle, load in self.axle_load_kg.items():
            yield f"  {axle}: {_mass(load)}, {self.tire_load_n[axle] / 1000:.1f} kN a tire"
        if self.handling is not None:
            yield from _handling_lines(self.handling)
        if self.filled_in:
            yield (f"filled in by rule of thumb ({len(self.filled_in)} values, +- one standard"
                   " deviation; GK general knowledge, EJ judgement, C computed)")
            for one in self.filled_in:
                yield f"  {one.key} = {one.value:.4g} +- {one.spread:.2g}  ({one.source})"


def summarize_vehicle(vehicle: AnyVehicle, *, speed_mps: float = 20.0) -> VehicleSummary:
    """Weigh a vehicle and drive it through two gentle turns.

    Args:
        vehicle: the vehicle.
        speed_mps: speed of the turns.

    Raises:
        InputError: the vehicle does not settle in a gentle turn.
    """
    packed = packed_of(vehicle)
    truck = packed.vehicle
    gravity = truck.road.gravity_mps2
    loads = static_loads(truck, gravity)
    axles = truck.spec.axles
    mass = {
        name: unit_mass(unit).mass_kg + sum(a.mass_kg for a in axles.values() if a.unit == name)
        for name, unit in truck.unit_specs.items()
    }
    steered = any(axle.steered for axle in axles.values())
    tires = {name: 2 * (1 + bool(axle.dual_spacing_m)) for name, axle in axles.items()}
    filled = tuple(_filled_in(truck))
    return VehicleSummary(
        name=truck.name, title=truck.title, mass_kg=mass, hitch_load_kg=loads.hitch_n / gravity,
        axle_load_kg={name: load / gravity for name, load in loads.road_n.items()},
        tire_load_n={name: load / tires[name] for name, load in loads.road_n.items()},
        handling=handling(packed, speed_mps) if steered else None, filled_in=filled,
        stated_spreads=len(truck.spreads) - sum(1 for one in filled if one.spread),
    )  # fmt: skip


def tires_named(vehicle: Vehicle, words: Sequence[str]) -> tuple[str, ...]:
    """Tires that words stand for: a tire, a hub's or an axle's first tire, `all` for every axle.

    Raises:
        InputError: a word that names nothing of this vehicle.
    """
    first = {axle: vehicle.tires_of_hub(f"{axle}_left")[0] for axle in vehicle.axles}
    known = {**{tire: tire for tire in vehicle.tires}, **first}
    known |= {hub: vehicle.tires_of_hub(hub)[0] for hub in vehicle.hubs}
    found: list[str] = []
    for word in words:
        if word != "all" and word not in known:
            raise InputError(f"{quoted(word)} is no tire, hub or axle of {vehicle.name}",
                             expected=nearest(word, known, ", ".join(known)))  # fmt: skip
        found += list(first.values()) if word == "all" else [known[word]]
    return tuple(dict.fromkeys(found))


def _filled_in(vehicle: Vehicle) -> Iterator[FilledIn]:
    for key, source in vehicle.sources.items():
        if source.startswith(RULE):
            value = _value_of(vehicle, key)
            spread = vehicle.spreads.get(key, 0.0)
            yield FilledIn(key, value, spread, source.removeprefix(RULE))


def _value_of(vehicle: Vehicle, key: str) -> float:
    """The value at a dotted key, in the vehicle file or in a tire or blowout section."""
    first, *rest = key.split(".")
    if first == "tires":
        name, field = rest
        tire = next(tire for tire, file in vehicle.tire_files.items() if file == name)
        return float(getattr(vehicle.tire_specs[tire], field))
    here: object = vehicle.blowout if first == "blowout" else getattr(vehicle.spec, first)
    for word in rest:
        here = here[word] if isinstance(here, Mapping) else getattr(here, word)
    assert isinstance(here, (int, float))
    return float(here)


def _handling_lines(found: Handling) -> Iterator[str]:
    mph = found.speed_mps / MILE_PER_HOUR_MPS
    yield f"handling in gentle turns at {found.speed_mps:g} m/s ({mph:.0f} mph)"
    how = "understeer" if found.understeer_rad >= 0.0 else "oversteer"
    yield f"  {how} gradient: {degrees(found.understeer_rad):+.2f} deg of road wheel for 1 g"
    if found.critical_speed_mps is not None:
        yield f"  unstable above {found.critical_speed_mps:.1f} m/s"
    yield f"  yaw rate: {found.yaw_gain_radps:.3f} deg/s for 1 deg of hand wheel"
    yield f"  roll: {degrees(found.roll_rad):.1f} deg for 1 g"


def _mass(kg: float) -> str:
    return f"{kg:,.0f} kg ({kg / POUND_KG:,.0f} lb)"

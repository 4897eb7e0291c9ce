"""What a candidate effect is: parameters of the model that are neutral by default, plus words.

An effect holds no physics. It says which packed parameters it moves, where it can act, how far it
may go, whether it begins at an instant, and how a person reads it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from truck_blowout_sim.diagnosis.result.parts import Kind, Place
from truck_blowout_sim.vehicle import Packed, Vehicle

Values = Mapping[str, float]
Timing = Literal["always", "step", "pulse", "ramp"]
SLOPE_ENTERED_IN_S = 1.0  # at first; how long is fitted
# At most, a judgment: a long transition of a road, 500 m at 25 m/s; a load slides a meter in less.
CHANGED_IN_S = 20.0
# Half of 0.7: two published forms of tire are taken to be two sigmas apart; see tire_saturation.py.
TIRE_FORMS_DIFFER = 0.35
WRONG_SHEET = 4.0  # times what trucks of a kind differ by, where a sheet is wrong


@dataclass(frozen=True)
class GripUsed:
    """Shares of the tires' grip, 0 to 1: to the side, and to the side and forward together."""

    side: float
    whole: float


AT_THE_LIMIT = GripUsed(1.0, 1.0)


@dataclass(frozen=True)
class Amount:
    """The number that says how strong an effect is; 0 is neutral.

    Attributes:
        name, unit: as ``diagnosis.json`` reports it.
        step: finite difference for its sensitivity.
        low, high: physical bounds.
        material: by so much 19 of 20 trucks of one kind stray from another at most; a share, where
            it grows with the vehicle. ``source``: where that is from.
        report: value to report from the amount; identity by default.
        grid: starts of a nonlinear search; they reach near the bounds.
        file_share: 1 sigma, a share, by which the number of the vehicle's file may be off that
            turns the amount into a force.
        at_low: what to say at the lower bound, where nature reaches it; ``{percent}`` is the end
            of the 90 % interval. Empty where the bound is only the end of the search. ``at_high``:
            the same of the upper bound.
    """

    name: str
    unit: str
    step: float
    low: float
    high: float
    material: float
    source: str
    report: Callable[[float], float] = lambda amount: amount
    grid: tuple[float, ...] = ()
    file_share: float = 0.0
    at_low: str = ""
    at_high: str = ""


@dataclass(frozen=True)
class FormNumber:
    """A number of an effect's law that no sheet has; fitted with the event, within its prior.

    Attributes:
        key: packed parameter, ``{unit}`` filled in.
        sigma: 1 sigma about what the law has otherwise. ``source``: where that is from.
    """

    key: str
    sigma: Callable[[Packed, Place], float]
    source: str


@dataclass(frozen=True)
class Effect:
    """A named piece of physics that a model may lack.

    Attributes:
        name: canonical name.
        amount: how strong.
        places: where it can act on a vehicle.
        values: packed parameters for a place and an amount (absolute values).
        timing: ``always`` there; a ``step`` at an instant; a ``pulse`` over an interval; a ``ramp``
            that grows over an interval and stays.
        ramp_s: how long a ramp grows, to begin with.
        timed: packed parameters for (place, start, end) of a timed effect.
        form_numbers: what else of its law is fitted, of what begins at an instant.
        applies: which runs can show it at all.
        sentence: for a person; fields ``{where}``, ``{axles}``, ``{value}``, ``{percent}``,
            ``{onset}``.
        equation: its law in plain symbols.
        splits: what observation tells it from look-alikes.
        kind: of what it is.
        onset_form_s: 1 sigma by which a real onset may differ for beginning in another way.
        hides: what may have begun before it shows: a leak that no gauge reads, a loss of grip; see
            ``diagnosis/prove/hidden.py``.
        met: met on the way (wind, slope, grip, an event) and not a property of the truck, so that
            runs of the same truck elsewhere say nothing about it.
        variant: another form of an effect of the same name. One with an onset is tried where the
            steady form, if there is one, explains something.
        drags: slows the truck without holding back a wheel more than its law says.
        listed: a name that is promised; else what is explained by it is `unknown`.
        grows_with: what `material` is a share of; 1 where it is an amount.
        neutral: amount at which a vehicle is as given; 0 unless it lacks the part altogether.
        absorbs: calibration number that means the same as this amount; ``{hub}`` and ``{role}``
            (of the axle) are filled in.
        of_file: scales a number of the vehicle's file that no calibration number stands for.
        whole_range: `material` covers all that such parts are held to do: no file is further off.
        far_from_limit: by so much models of equal slope and peak seem to differ in the amount, 1
            sigma, in runs far from the limit of grip; the less, the nearer.
        near_limit: the same of runs at the limit of grip; the less, the farther.
        pushes_back: what moves pushes the vehicle back meanwhile, by a course that nobody knows.
        cuts_grip: the tires give out earlier: of their grip, what the amount reports is left.
        any_direction: this limit is that of side and forward force together, not of side force.
    """

    name: str
    amount: Amount
    places: Callable[[Vehicle], Sequence[Place]]
    values: Callable[[Packed, Place, float], Values]
    sentence: str
    equation: str
    splits: str
    timing: Timing = "always"
    ramp_s: float = 0.0
    timed: Callable[[Packed, Place, float, float], Values] | None = None
    form_numbers: tuple[FormNumber, ...] = ()
    applies: Literal["any", "blowout", "brakes"] = "any"
    kind: Kind = "physics"
    absorbs: str = ""
    of_file: bool = False
    whole_range: bool = False
    far_from_limit: float = 0.0
    near_limit: float = 0.0
    pushes_back: bool = False
    cuts_grip: bool = False
    any_direction: bool = False
    onset_form_s: float = 0.0
    hides: Literal["nothing", "leak", "grip"] = "nothing"
    met: bool = False
    variant: bool = False
    drags: bool = False
    listed: bool = True
    grows_with: Callable[[Packed], float] = lambda packed: 1.0
    neutral: Callable[[Packed], float] = lambda packed: 0.0

    def strays(self, packed: Packed, grip_used: GripUsed = AT_THE_LIMIT) -> tuple[float, ...]:
        """1 sigma by which trucks of one kind differ in the amount, and roads, winds and loads.

        A number of the vehicle's file may be wrong: then trucks differ from it by four times as
        much, unless the spread already covers all that such parts do. What forms of a law
        differ by is no matter of the file. What the sheet still calibrates beside the effect has
        that chance already.

        ``grip_used``: what the runs ask for.
        """
        used = grip_used.whole if self.any_direction else grip_used.side
        forms = self.far_from_limit * (1.0 - used) + self.near_limit * used
        trucks = 0.5 * self.amount.material * self.grows_with(packed)
        stated = (self.absorbs or self.of_file) and not (self.met or self.whole_range)
        sizes = (1.0, WRONG_SHEET) if stated else (1.0,)
        return tuple(float(np.hypot(size * trucks, forms)) for size in sizes)

    @property
    def adds_up(self) -> bool:
        """Whether an event's responses add up: a force that acts either way, at any size."""
        return self.timed is not None and self.amount.low < 0.0 and not self.amount.grid

    @property
    def edges(self) -> int:
        """How many instants of a run are free: start and end of what ends, else the start."""
        return 2 if self.timing in ("pulse", "ramp") else 1

    def end_s(self, start_s: float, spacing_s: float) -> float:
        """End to begin with, of an event found on a grid of that spacing."""
        return start_s + {"pulse": spacing_s, "ramp": self.ramp_s}.get(self.timing, np.inf)


def drag_area_m2(packed: Packed) -> float:
    """Of the whole vehicle."""
    return sum(packed[f"unit.{name}.drag_area_m2"] for name in packed.vehicle.units)


def weight_n(packed: Packed) -> float:
    """Of the whole vehicle."""
    vehicle = packed.vehicle
    mass = [packed[f"unit.{name}.mass_kg"] for name in vehicle.units]
    mass += [packed[f"axle.{name}.mass_kg"] for name in vehicle.axles]
    return sum(mass) * packed["world.gravity_mps2"]


def length_m(packed: Packed, unit: str) -> float:
    """From the foremost axle, or the kingpin, of a unit to its last axle."""
    spec = packed.vehicle.spec
    at = [packed[f"axle.{axle}.x_m"] for axle in packed.vehicle.axles
          if spec.axles[axle].unit == unit]
    at.append(packed[f"unit.{unit}.origin_x_m"])
    return max(at) - min(at)


def whole_truck(vehicle: Vehicle) -> Sequence[Place]:
    """Acts on the truck as a whole."""
    return (Place(),)


def each_unit(vehicle: Vehicle) -> Sequence[Place]:
    """Acts on one unit."""
    return tuple(Place(body=unit) for unit in vehicle.units)


def each_axle(vehicle: Vehicle) -> Sequence[Place]:
    """Acts on one axle."""
    return tuple(Place(body=vehicle.spec.axles[a].unit, axle=a) for a in vehicle.axles)


def steered_axle(vehicle: Vehicle) -> Sequence[Place]:
    """Acts on the steered axle, if there is one."""
    return tuple(p for p in each_axle(vehicle) if p.axle and vehicle.spec.axles[p.axle].steered)


def unsteered_axles(vehicle: Vehicle) -> Sequence[Place]:
    """Acts on one axle that does not steer; on a steered one a hand-wheel offset means the same."""
    return tuple(p for p in each_axle(vehicle) if p.axle and not vehicle.spec.axles[p.axle].steered)


def each_hub(vehicle: Vehicle) -> Sequence[Place]:
    """Acts on one hub."""
    return tuple(Place(body=vehicle.spec.axles[vehicle.axle_of_hub(h)].unit,
                       axle=vehicle.axle_of_hub(h), hub=h) for h in vehicle.hubs)


def each_tire(vehicle: Vehicle) -> Sequence[Place]:
    """Acts on one tire."""
    return tuple(Place(body=hub.body, axle=hub.axle, hub=hub.hub, tire=tire)
                 for hub in each_hub(vehicle) if hub.hub
                 for tire in vehicle.tires_of_hub(hub.hub))


def each_circuit(vehicle: Vehicle) -> Sequence[Place]:
    """Acts on the brakes of one circuit; the place names its first axle's group."""
    groups = dict.fromkeys(vehicle.spec.axles[a].circuit for a in vehicle.axles)
    return tuple(Place(body="trailer" if group == "trailer" else "tractor", axle=group)
                 for group in groups)


def axles_at(vehicle: Vehicle, place: Place) -> tuple[str, ...]:
    """Axles that a place names: one, all that brake on the circuit of that name, or all."""
    if place.axle is None:
        return tuple(vehicle.axles)
    if place.axle in vehicle.spec.axles:
        return (place.axle,)
    return tuple(a for a in vehicle.axles if vehicle.spec.axles[a].circuit == place.axle)


def added(packed: Packed, name: str, amount: float) -> Values:
    """The named parameter plus ``amount``."""
    return {name: packed[name] + amount}


def scaled(packed: Packed, names: Sequence[str], amount: float) -> Values:
    """The named parameters times (1 + ``amount``)."""
    return {name: packed[name] * (1.0 + amount) for name in names}

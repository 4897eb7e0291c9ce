"""Reading scenario files, with every value checked and every error on one line."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from os import PathLike
from pathlib import Path

from truck_blowout_sim.errors import InputError, quoted
from truck_blowout_sim.recordings import Blowout
from truck_blowout_sim.recordings.blowout_words import ONCE, second_burst
from truck_blowout_sim.resources import config_file, config_names
from truck_blowout_sim.simulation.scenario_schema import (
    BlowoutEventSpec,
    HoldSpec,
    ScenarioSpec,
    WhenSpec,
)
from truck_blowout_sim.vehicle import Vehicle
from truck_blowout_sim.vehicle.document import Branch, Leaf, Place, read_document
from truck_blowout_sim.vehicle.fields import rules
from truck_blowout_sim.vehicle.reading import Notes, build, to_number, unknown
from truck_blowout_sim.vehicle.schema.axle import CIRCUITS

_KIND = "scenarios"
_FEW_PARTS = 8  # so many hubs and tires are listed
NOTHING = "none"  # in place of tires: nothing bursts


@dataclass(frozen=True)
class Scenario:
    """A loaded and checked scenario.

    Attributes:
        name: stem of its file.
        path: the file.
        spec: its sections in SI.
        values: parameters of the vehicle it sets, by packed name.
        sources: where each value comes from, by dotted SI key.
        places: where the values stand that only a vehicle can check.
    """

    name: str
    path: Path
    spec: ScenarioSpec
    values: Mapping[str, float] = field(default_factory=dict)
    sources: Mapping[str, str] = field(default_factory=dict)
    places: Mapping[str, Place] = field(default_factory=dict)

    @property
    def title(self) -> str:
        """One line a person reads."""
        return self.spec.title

    def with_blowouts(self, events: Sequence[Blowout]) -> Scenario:
        """A copy in which these tires or hubs burst and no others.

        Raises:
            InputError: an instant outside the run.
        """
        places = {f"blowouts.{n}.tires": Place(f"blowout {'+'.join(e.tires)}@{e.time_s:g}", 0, "")
                  for n, e in enumerate(events)}
        for event, place in zip(events, places.values(), strict=True):
            if not self.spec.start_s <= event.time_s <= self.spec.end_s:
                raise _outside(self.spec, event.time_s, place)
        specs = {f"{n}": BlowoutEventSpec(time_s=event.time_s, tires="+".join(event.tires))
                 for n, event in enumerate(events)}
        return replace(self, spec=replace(self.spec, blowouts=specs), places=places)

    def blowouts_of(self, vehicle: Vehicle) -> tuple[Blowout, ...]:
        """Its blowouts at instants, with hubs resolved into tires; those on a condition are not.

        Raises:
            InputError: a name that is neither a hub nor a tire of the vehicle, or a tire that
                bursts twice.
        """
        events = {
            name: Blowout(event.time_s, self.tires_of(name, vehicle))
            for name, event in self.spec.blowouts.items()
            if event.when is None and event.tires != NOTHING
        }
        found = tuple(events.values())
        if again := second_burst(found):
            raise self._tires_place([*events][again[0]]).error(again[1], ONCE)
        return found

    def tires_of(self, event: str, vehicle: Vehicle) -> tuple[str, ...]:
        """The tires that burst in one event, each once, hubs resolved.

        Raises:
            InputError: a name that is neither a hub nor a tire of the vehicle.
        """
        words = self.spec.blowouts[event].tires
        tires: list[str] = []
        for word in words.split("+") if words != NOTHING else ():
            if word in vehicle.hubs:
                tires += vehicle.tires_of_hub(word)
            elif word in vehicle.tires:
                tires.append(word)
            else:
                problem = f"{quoted(word)} is no hub or tire of {vehicle.name}"
                parts = tuple(dict.fromkeys((*vehicle.hubs, *vehicle.tires)))
                if len(parts) <= _FEW_PARTS:  # a name of another vehicle resembles the wrong one
                    raise self._tires_place(event).error(problem, "one of " + ", ".join(parts))
                raise unknown(self._tires_place(event), problem, word, parts)
        return tuple(dict.fromkeys(tires))

    def beside(self, name: str, kind: str) -> Path:
        """A file that it names: in its own folder, or a shipped one of ``kind``.

        Raises:
            InputError: no such file.
        """
        beside = self.path.parent / name
        return beside if beside.is_file() else config_file(kind, name)

    def _tires_place(self, event: str) -> Place:
        return self.places.get(f"blowouts.{event}.tires", Place("blowout", 1, ""))


def load_scenario(name_or_path: str | PathLike[str]) -> Scenario:
    """Load a scenario by the name of a shipped file or by path.

    Raises:
        InputError: no such file, or something in it cannot be used; one line says what and where.
    """
    path = config_file(_KIND, name_or_path)
    return scenario_of(read_document(path, _KIND), path)


def scenario_of(document: Branch, path: Path) -> Scenario:
    """The scenario that a document describes; the document stays as it is.

    Args:
        path: the document's file; its stem is the scenario's name.

    Raises:
        InputError: something in it cannot be used.
    """
    tree = Branch(document.place, dict(document.entries))
    values = _values(tree.entries.pop("values", None))
    notes = Notes()
    spec = build(ScenarioSpec, tree, notes)
    places = dict(_places(tree, ""))
    scenario = Scenario(path.stem, path, spec, values, notes.sources, places)
    _check(scenario, tree)
    return scenario


def scenario_names() -> tuple[str, ...]:
    """Names of the shipped scenarios."""
    return config_names(_KIND)


def _values(entry: Leaf | Branch | None) -> dict[str, float]:
    if entry is None:
        return {}
    if isinstance(entry, Leaf):
        raise entry.place.error(f"{entry.value!r} is not a section", "packed names with values")
    values = {}
    for key, leaf in entry.entries.items():
        if isinstance(leaf, Branch):
            raise leaf.place.error("is a section", "a value")
        values[key] = to_number(leaf.value, leaf.place) * leaf.factor
    return values


def _places(tree: Branch, path: str) -> list[tuple[str, Place]]:
    found: list[tuple[str, Place]] = []
    for key, entry in tree.entries.items():
        here = f"{path}.{key}" if path else key
        found.append((here, entry.place))
        if isinstance(entry, Branch):
            found += _places(entry, here)
    return found


def _check(scenario: Scenario, tree: Branch) -> None:
    spec, places = scenario.spec, scenario.places
    if spec.end_s <= spec.start_s:
        raise places["end_s"].error(f"{spec.end_s:g} s is not after the start",
                                    f"more than {spec.start_s:g} s")
    if spec.start is None and not spec.recording:
        raise tree.place.error("says neither how the truck starts nor a recording",
                               "a start section or a recording")
    if spec.hold is None and spec.throttle is None and not spec.recording:
        raise tree.place.error("nothing works the throttle", "hold, throttle or a recording")
    for event in spec.blowouts:
        _check_event(scenario, event)
    if spec.reaction and spec.reaction.when:
        _check_when(scenario, "reaction.when", spec.reaction.when)
    _check_steering(scenario)
    _check_tables(scenario)


def _check_event(scenario: Scenario, event: str) -> None:
    spec, found = scenario.spec, scenario.spec.blowouts[event]
    timed = not math.isnan(found.time_s)
    if timed == (found.when is not None):
        raise scenario.places[f"blowouts.{event}"].error(
            "has a time_s and a when" if timed else "says neither when nor at what time_s",
            "one of: time_s, when")
    if found.when is not None:
        _check_when(scenario, f"blowouts.{event}.when", found.when)
        return
    time_s, place = found.time_s, scenario.places[f"blowouts.{event}.time_s"]
    if not spec.start_s <= time_s <= spec.end_s:
        raise _outside(spec, time_s, place)


def _check_when(scenario: Scenario, key: str, when: WhenSpec) -> None:
    if all(math.isnan(value) for value in vars(when).values()):
        raise scenario.places[key].error("asks for nothing",
                                         f"one or more of: {', '.join(rules(WhenSpec))}")


def _outside(spec: ScenarioSpec, time_s: float, place: Place) -> InputError:
    return place.error(f"blowout at {time_s:g} s is outside the run",
                       f"{spec.start_s:g} to {spec.end_s:g} s")


def _check_steering(scenario: Scenario) -> None:
    steering = scenario.spec.steering
    if steering is None:
        return
    given = [k for k in ("table", "sweep", "follow") if getattr(steering, k) is not None]
    if len(given) != 1:
        raise scenario.places["steering"].error(f"has {' and '.join(given) or 'nothing'}",
                                                "one of: table, sweep, follow")
    if steering.follow:
        follow, place = steering.follow, scenario.places["steering.follow"]
        if len(follow.x_m) < 2 or len(follow.x_m) != len(follow.y_m):
            raise place.error(f"{len(follow.x_m)} x and {len(follow.y_m)} y values",
                              "two points or more, x and y of each")
        points = list(zip(follow.x_m, follow.y_m, strict=True))
        if any(a == b for a, b in pairwise(points)):
            raise place.error("the same point twice in a row", "points apart from each other")
    if steering.sweep and steering.sweep.end_s <= steering.sweep.start_s:
        raise scenario.places["steering.sweep.end_s"].error(
            f"{steering.sweep.end_s:g} s is not after its start",
            f"more than {steering.sweep.start_s:g} s")


def _check_tables(scenario: Scenario) -> None:
    spec = scenario.spec
    if spec.steering and spec.steering.table:
        table = spec.steering.table
        _check_table(scenario, "steering.table", table.time_s, table.angle_rad, "angles")
    if spec.hold:
        _check_hold(scenario, spec.hold)
    if spec.throttle:
        _check_table(scenario, "throttle", spec.throttle.time_s, spec.throttle.opening, "openings")
        if max(spec.throttle.opening) > 1.0:
            raise scenario.places["throttle.opening"].error(
                f"{max(spec.throttle.opening):g} is out of bounds", "0 to 1")
    for circuit in CIRCUITS:
        pressure = getattr(spec.brakes, circuit) if spec.brakes else None
        if pressure:
            _check_table(scenario, f"brakes.{circuit}", pressure.time_s, pressure.pressure_pa,
                         "pressures")


def _check_hold(scenario: Scenario, hold: HoldSpec) -> None:
    if hold.profile is not None and not math.isnan(hold.speed_mps):
        raise scenario.places["hold"].error("has a speed and a profile", "one of them")
    if hold.profile is None and math.isnan(hold.speed_mps) and scenario.spec.start is None:
        raise scenario.places["hold"].error("does not say which speed", "speed_mps or profile")
    if hold.profile:
        _check_table(scenario, "hold.profile", hold.profile.time_s, hold.profile.speed_mps,
                     "speeds")


def _check_table(scenario: Scenario, key: str, times: Sequence[float], values: Sequence[float],
                 words: str) -> None:
    place = scenario.places[key]
    if not times or len(times) != len(values):
        raise place.error(f"{len(times)} times and {len(values)} {words}",
                          "one value for each time")
    if any(b <= a for a, b in pairwise(times)):
        raise place.error("times do not increase", "each time later than the one before")

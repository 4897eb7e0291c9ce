"""What an effect is to the proving ground: a name, places, needs, and a severity knob."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from proving_ground.sheet import AXLE_NAMES, HUBS, TIRES
from proving_ground.switches import Switches, neutral


@dataclass(frozen=True)
class Place:
    """Where an effect sits; None where it does not apply."""

    body: str | None = None
    axle: str | None = None
    hub: str | None = None
    tire: str | None = None

    def as_dict(self) -> dict[str, str | None]:
        """The four fields, as in a diagnosis."""
        return {"body": self.body, "axle": self.axle, "hub": self.hub, "tire": self.tire}


def at_tire(tire: str) -> Place:
    """A tire with its hub, axle and body."""
    hub = tire if tire in HUBS else tire.rsplit("_", 1)[0]
    return Place(at_hub(hub).body, at_hub(hub).axle, hub, tire)


def at_hub(hub: str) -> Place:
    """A hub with its axle and body."""
    axle = hub.rsplit("_", 1)[0]
    return Place(at_axle(axle).body, axle, hub)


def at_axle(axle: str) -> Place:
    """An axle (or a group of axles, by the name they share) with its body."""
    return Place("trailer" if axle.startswith("trailer") else "tractor", axle)


@dataclass(frozen=True)
class Strength:
    """How strong an effect is, in the plainest physical measure."""

    name: str
    value: float
    unit: str


@dataclass(frozen=True)
class Active:
    """An effect at work in one run: its switches, where it began, what it measures."""

    switches: dict[str, Any]
    strength: Strength
    onset_s: float | None = None      # on the recording's clock, where it is an event
    onset_x_m: float | None = None    # place on the road where it begins


Setter = Callable[[float, Place, float, float], Active]


@dataclass(frozen=True)
class EffectKind:
    """A family of effects.

    `set` takes severity (1 is the strongest plausible), place, sign and the instant or place of
    an event in the run, and returns what is active. `needs` names the manoeuvre class that
    excites it.
    """

    name: str
    set: Setter
    places: tuple[Place, ...]
    needs: str
    signed: bool = False
    event: bool = False
    lowest: float = 1.0e-3            # severity below which the name would no longer fit
    guess: float = 40.0               # usual detectability at severity one, where a search begins
    others: tuple[Setter, ...] = ()   # the same effect by other laws of the literature
    end: float = 1.2                  # severity of the physical end

    def by_law(self, law: int) -> Setter:
        """The setter of a law: 0 is `set`, then `others`."""
        return (self.set, *self.others)[law % (1 + len(self.others))]


def combine(actives: list[Active]) -> Switches:
    """Switches with several effects at work; arrays add up, gains multiply."""
    base = neutral()
    values = base._asdict()
    for active in actives:
        for key, value in active.switches.items():
            start = getattr(base, key)
            if key == "brake_gain":
                values[key] = values[key] * value
            elif isinstance(start, np.ndarray) and key != "slosh":
                values[key] = values[key] + value
            else:
                values[key] = value
    return Switches(**values)


def only(size: int, index: int, value: float) -> np.ndarray[Any, np.dtype[np.float64]]:
    """Zeros but for one entry."""
    out = np.zeros(size)
    out[index] = value
    return out


def axle_index(place: Place) -> int:
    """Number of an axle, 0 to 4."""
    if place.axle is None:
        raise ValueError("this effect needs an axle")
    return AXLE_NAMES.index(place.axle)


def hub_index(place: Place) -> int:
    """Number of a hub, 0 to 9."""
    if place.hub is None:
        raise ValueError("this effect needs a hub")
    return HUBS.index(place.hub)


def tire_index(place: Place) -> int:
    """Number of a tire, 0 to 17."""
    if place.tire is None:
        raise ValueError("this effect needs a tire")
    return TIRES.index(place.tire)


def group_index(place: Place) -> int:
    """Number of a brake group: steer 0, drive 1, trailer 2."""
    return ("steer", "drive", "trailer").index(place.axle or "")

"""A mapping begun for a log: guesses from names, stated units, and the size of the numbers.

Every guess is marked as one; none is used before a person has read the file.

Validated with: test/recordings/test_proposing.py, test/recordings/test_bring_your_own_log.py.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.recordings.channels import (
    DEFAULT_HUBS,
    DEFAULT_TIRES,
    UNITS,
    Channel,
    by_name,
    channels_for,
)
from truck_blowout_sim.recordings.logs.log import Column, Log
from truck_blowout_sim.recordings.logs.vbo_log import KIND as VBO_KIND
from truck_blowout_sim.recordings.mapping.agreeing import BY_SIZE, Guesses
from truck_blowout_sim.recordings.mapping.plausible import unit_by_size
from truck_blowout_sim.recordings.mapping.signs import with_signs
from truck_blowout_sim.recordings.mapping.stand_ins import stand_ins
from truck_blowout_sim.recordings.mapping.vocabulary import channel_hinted
from truck_blowout_sim.recordings.units import (
    SI_QUANTITIES,
    Unit,
    find_unit,
    not_known,
    unknown_unit,
)

FloatArray = NDArray[np.float64]

_TRUCK_WHEEL_M = 0.5  # rolling radius of 11R22.5 and 295/75R22.5


@dataclass(frozen=True)
class Proposal:
    """A column that may be a channel.

    Attributes:
        column, channel: full names.
        unit: empty where the log states it, also if that one is not known here.
        sign, offset, radius_m: as in a mapping file.
        why: what each part was guessed from.
        file: of several, the one that the column is in, as a mapping names it; empty: any.
    """

    column: str
    channel: str
    unit: str = ""
    sign: float = 1.0
    offset: float = 0.0
    why: tuple[str, ...] = ()
    radius_m: float = 0.0
    file: str = ""


@dataclass(frozen=True)
class Wheels:
    """Wheels of the vehicle that a log is of, for names like "front left".

    Attributes:
        hubs: names, every axle's left one, then its right one, from the front.
        radius_m: rolling radius of each, for wheel speeds in km/h.
        source: what the radii are of.
        tires: names; a gauge is that of a hub with one tire.
    """

    hubs: tuple[str, ...] = DEFAULT_HUBS
    radius_m: tuple[float, ...] = (_TRUCK_WHEEL_M,) * len(DEFAULT_HUBS)
    source: str = "a 22.5 in truck tire"
    tires: tuple[str, ...] = DEFAULT_TIRES

    def named(self, channel: str) -> str:
        """A wheel's channel by this vehicle's name of it; empty where it has no such axle."""
        for before, after in (("hub_speed_", "_radps"), ("tire_pressure_", "_pa")):
            hub = channel.removeprefix(before).removesuffix(after)
            if channel.startswith(before) and hub in DEFAULT_HUBS:
                at = DEFAULT_HUBS.index(hub)
                return f"{before}{self.hubs[at]}{after}" if at < len(self.hubs) else ""
        return channel

    def radius_of(self, hub: str) -> float:
        """Radius of a hub's wheel."""
        return self.radius_m[self.hubs.index(hub)]


def propose(log: Log, taken: Mapping[str, object] | None = None, wheels: Wheels | None = None,
            time_s: FloatArray | None = None) -> list[Proposal]:  # fmt: skip
    """Guess which column is which channel; each channel once, the fullest column first.

    Args:
        log: the columns.
        taken: channels that are there already.
        wheels: of the vehicle; None: the default truck's.
        time_s: of the log's rows, where they have one time column.
    """
    wheels = wheels or Wheels()
    table = by_name((*channels_for(wheels.hubs, wheels.tires), *stand_ins()))
    best: dict[str, tuple[tuple[float, int], Proposal, Column]] = {}
    for at, name in enumerate(log.names):
        channel = table.get(wheels.named(channel_hinted(name)))
        if channel is None or channel.name in (taken or {}):
            continue
        column = log.column(name)
        found = _of_column(name, column, channel, wheels)
        if found is None:
            continue
        rank = (_rank(name, column), -at)
        if channel.name not in best or rank > best[channel.name][0]:
            best[channel.name] = (rank, found, column)
    order = {name: k for k, name in enumerate(table)}
    picked = [best[name] for name in sorted(_of_one_kind(best, taken or {}), key=order.__getitem__)]
    guesses = Guesses([(proposal, column) for _, proposal, column in picked], time_s)
    signed = with_signs(guesses.agreed(), guesses.together)
    return [_west_positive(one) for one in signed] if log.kind == VBO_KIND else signed


def _of_one_kind(found: Collection[str], taken: Collection[str]) -> list[str]:
    """Names without half positions, and without latitudes where there are positions in meters."""
    kept = list(found)
    for unit in UNITS:
        globe = [f"{unit}_{stem}" for stem in ("latitude_rad", "longitude_rad", "altitude_m")]
        plane = {f"{unit}_x_m", f"{unit}_y_m"} & {*found, *taken}
        if plane or not set(globe[:2]) <= set(found):
            kept = [name for name in kept if name not in globe]
    return kept


def _of_column(name: str, column: Column, channel: Channel, wheels: Wheels) -> Proposal | None:
    quantity = SI_QUANTITIES[channel.unit]
    why = ["channel from the name"]
    stated = find_unit(column.unit)
    if channel.group == "hub_speed":
        return _of_wheel(name, stated or _unit_in_name(name), column, channel, wheels)
    if stated is not None and stated.quantity != quantity:
        return None
    told = column.values[np.isfinite(column.values)]
    if told.size < 2:
        return None
    unit = ""
    if stated is None:
        in_name = _unit_in_name(name)
        if in_name is not None and in_name.quantity != quantity:
            return None
        unknown = unknown_unit(column.unit)
        if in_name is not None:
            unit = in_name.name
            why.append("unit from the name")
        elif not unknown:
            unit = unit_by_size(told, channel.name, quantity)
            why.append(BY_SIZE)
        if unknown:  # what is stated is not overruled by the size of numbers: a person decides
            why.append(not_known(unknown))
    return Proposal(name, channel.name, unit, why=tuple(why))


def _of_wheel(name: str, unit: Unit | None, column: Column, channel: Channel, wheels: Wheels
              ) -> Proposal | None:
    """A wheel speed: only with a unit, as its size tells none; in km/h with a radius."""
    why: tuple[str, ...] = ("channel from the name",)
    if unit is None or not np.isfinite(column.values).any():
        return None
    stated = "" if find_unit(column.unit) else unit.name
    if unit.quantity == "angular rate":
        return Proposal(name, channel.name, stated, why=why)
    if unit.quantity != "speed":
        return None
    why = (*why, f"radius of {wheels.source}: take the one that the logger multiplies by")
    return Proposal(name, channel.name, stated, why=why, radius_m=wheels.radius_of(channel.part))


def _west_positive(proposal: Proposal) -> Proposal:
    if not proposal.channel.endswith("longitude_rad"):
        return proposal
    why = (*proposal.why, "sign: the format counts west positive")
    return replace(proposal, sign=-1.0, why=why)


def _unit_in_name(name: str) -> Unit | None:
    """A unit at the end of a name: ``speed_kmh``, ``/can/swa_deg:data``, ``wheel_rpm[0]``."""
    words = re.split(r"[:./ _]", name.partition("[")[0].removesuffix(":data"))
    for text in (words[-1], "/".join(words[-2:]), " ".join(words[-2:])):
        # one letter may be an axis or an index
        if len(words) > 1 and len(text) > 1 and find_unit(text) is not None:
            return find_unit(text)
    return None


def _rank(name: str, column: Column) -> float:
    """More samples and a moving signal first; an angle before the parts of its quaternion."""
    told = column.values[np.isfinite(column.values)]
    moves = 1.0 if np.ptp(told) > 0.0 else 0.0
    return moves + min(told.size, 10**7) / 1e7

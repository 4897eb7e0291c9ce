"""Which hubs, tires and units the names of a recording's channels speak of."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from truck_blowout_sim.recordings.channels import (
    DEFAULT_HUBS,
    DEFAULT_TIRES,
    UNITS,
    Channel,
    channels_for,
)

_HUB_COLUMNS = (
    re.compile(r"hub_speed_(\w+)_radps"),
    re.compile(r"brake_chamber_(\w+)_pa"),
    re.compile(r"hub_spin_angle_(\w+)_rad"),
)
_TIRE_COLUMNS = (
    re.compile(r"tire_pressure_(\w+)_pa"),
    re.compile(r"tire_f[xyz]_(\w+)_n"),
    re.compile(r"tire_loaded_radius_(\w+)_m"),
)
_STEER_COLUMN = re.compile(r"(\w+)_steer_rad")
_UNIT_COLUMN = re.compile(r"(tractor|trailer)_.*")


@dataclass(frozen=True)
class Parts:
    """Hubs, tires, units and steered hubs, each in the order of the vehicle."""

    hubs: tuple[str, ...]
    tires: tuple[str, ...]
    units: tuple[str, ...]
    steered_hubs: tuple[str, ...]

    def table(self) -> tuple[Channel, ...]:
        """The channel table of these parts."""
        return channels_for(self.hubs, self.tires, self.units, self.steered_hubs)

    def knows_tire(self, name: str) -> bool:
        """Whether a blowout may name this tire: one of these parts or of the default truck."""
        return name in self.tires or name in DEFAULT_TIRES or name in self._implied_tires()

    def _implied_tires(self) -> set[str]:
        duals = {f"{hub}_{place}" for hub in self.hubs for place in ("outer", "inner")}
        return duals | set(self.hubs)


def parts_of(
    names: Iterable[str],
    hubs: Iterable[str] = (),
    tires: Iterable[str] = (),
) -> Parts:
    """Collect the parts that channel names (CSV columns) speak of.

    Args:
        names: channel names; those that follow no pattern are ignored.
        hubs: further hubs, known from elsewhere.
        tires: further tires, known from elsewhere.

    Returns:
        Parts of the default truck first, in its order, then others as they came.
    """
    found_hubs, found_tires = dict.fromkeys(hubs), dict.fromkeys(tires)
    units: dict[str, None] = {}
    steered: dict[str, None] = {}
    for name in names:
        _collect(name, _HUB_COLUMNS, found_hubs)
        _collect(name, _TIRE_COLUMNS, found_tires)
        _collect(name, (_STEER_COLUMN,), steered)
        _collect(name, (_UNIT_COLUMN,), units)
        if name == "articulation_rad":
            units.update(dict.fromkeys(UNITS))
    return Parts(
        _ordered(found_hubs, DEFAULT_HUBS),
        _ordered(found_tires, DEFAULT_TIRES),
        _ordered(units, UNITS),
        _ordered(steered, DEFAULT_HUBS),
    )


def _collect(name: str, patterns: Iterable[re.Pattern[str]], into: dict[str, None]) -> None:
    for pattern in patterns:
        match = pattern.fullmatch(name)
        if match:
            into[match[1]] = None


def _ordered(found: Iterable[str], usual: tuple[str, ...]) -> tuple[str, ...]:
    names = tuple(found)
    known = tuple(name for name in usual if name in names)
    return known + tuple(name for name in names if name not in usual)

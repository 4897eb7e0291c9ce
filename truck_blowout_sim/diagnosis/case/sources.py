"""Where the priors of the sheet's numbers come from, as ``config/diagnosis`` states it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from truck_blowout_sim.diagnosis.settings_file import settings_tree
from truck_blowout_sim.resources import config_file


class NumberSources(Mapping[str, str]):
    """Source of each number's prior by the number's name.

    A number that stands for one of several parts carries the part's name with it
    (``brake_gain_trailer_2_left``); its source is that of the longest entry its name holds.
    """

    def __init__(self, tree: Mapping[str, Any]) -> None:
        self._sources = {
            key: str(entry.get("source", ""))
            for key, entry in (tree.get("sheet") or {}).items()
            if isinstance(entry, Mapping)
        }

    def __getitem__(self, name: str) -> str:
        if name in self._sources:
            return self._sources[name]
        parts = [key for key in self._sources if key in name]
        return self._sources[max(parts, key=len)] if parts else ""

    def __iter__(self) -> Iterator[str]:
        return iter(self._sources)

    def __len__(self) -> int:
        return len(self._sources)


def number_sources(settings: str) -> NumberSources:
    """Sources of a file of ``config/diagnosis``, by its name."""
    return NumberSources(settings_tree(config_file("diagnosis", settings)))

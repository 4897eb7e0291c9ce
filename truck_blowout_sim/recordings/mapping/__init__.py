"""What in somebody else's log becomes which channel: mapping files, checked and applied."""

from __future__ import annotations

from truck_blowout_sim.recordings.mapping.combine import combine
from truck_blowout_sim.recordings.mapping.mapping_file import load_mapping, rules_from
from truck_blowout_sim.recordings.mapping.opened import Opened, open_test
from truck_blowout_sim.recordings.mapping.rules import Also, Mount, Rules, Source, TimeRule

__all__ = [
    "Also",
    "Mount",
    "Opened",
    "Rules",
    "Source",
    "TimeRule",
    "combine",
    "load_mapping",
    "open_test",
    "rules_from",
]

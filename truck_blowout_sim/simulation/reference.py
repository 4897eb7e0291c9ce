"""The reference of all scenario keys, as a commented YAML file, from the schema itself.

`python -m truck_blowout_sim.simulation.reference docs/reference/keys` brings the file up to date. A
test holds it against the schema.
"""

from __future__ import annotations

import sys
from pathlib import Path

from truck_blowout_sim.simulation.scenario_schema import ScenarioSpec
from truck_blowout_sim.vehicle.reference import key_file, key_line, write_files


def scenario_keys() -> str:
    """Every key of a scenario file."""
    last = ["values:", key_line("  <name>", "number, optional: a vehicle parameter, packed name")]
    return key_file("a scenario file (config/scenarios)", ScenarioSpec, last)


if __name__ == "__main__":
    write_files(Path(sys.argv[1]), {"scenario": scenario_keys()})

"""The page on scenario files says what the schema says, and its examples run."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np

from truck_blowout_sim.simulation import load_scenario, scenario_names, simulate
from truck_blowout_sim.simulation.reference import scenario_keys
from truck_blowout_sim.vehicle import Packed

PAGE = Path(__file__).resolve().parents[2] / "docs" / "scenario_files.md"


def test_the_reference_is_up_to_date() -> None:
    keys = PAGE.parent / "reference" / "keys" / "scenario.yaml"
    assert keys.read_text(encoding="utf-8") == scenario_keys()


def test_every_shipped_scenario_is_on_the_page_with_its_title() -> None:
    page = PAGE.read_text(encoding="utf-8")
    for name in scenario_names():
        assert f"| `{name}` | {load_scenario(name).title} |" in page


def test_the_examples_run(truck: Packed, write: Callable[[str], Path]) -> None:
    examples = re.findall(r"```yaml\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    assert len(examples) == 2
    runs = [simulate(truck, load_scenario(write(example))) for example in examples]
    assert runs[0]["brake_pressure_drive_pa"].value.max() > 5e5
    assert [b.tires for b in runs[1].blowouts][-1] == ("drive_1_left_inner",)


def test_the_thesis_procedure_holds_the_speed_until_the_clutch_opens(truck: Packed) -> None:
    speed = simulate(truck, "thesis_procedure")["tractor_vx_mps"]
    held = speed.between(-4.9, 3.0).value / 0.44704
    assert np.abs(held - 52.4).max() < 0.6
    assert speed.value[-1] < 0.8 * held[-1] * 0.44704

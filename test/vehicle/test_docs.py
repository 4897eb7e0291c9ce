"""The page on vehicle files says what the schema says, and its examples hold."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.resources import config_dir
from truck_blowout_sim.vehicle import load_vehicle, pack
from truck_blowout_sim.vehicle.reference import key_files

PAGE = Path(__file__).resolve().parents[2] / "docs" / "vehicle_files.md"
TAGS = re.compile(r"\b(F\d+)\b")


def test_the_reference_is_up_to_date() -> None:
    for name, text in key_files().items():
        path = f"reference/keys/{name}.yaml"
        assert (PAGE.parent / path).read_text(encoding="utf-8") == text
        assert f"]({path})" in PAGE.read_text(encoding="utf-8")


def test_the_examples_load(write: Callable[..., Path]) -> None:
    examples = re.findall(r"```yaml\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    assert len(examples) == 3
    default = pack(load_vehicle("international_9400i_trailmobile"))
    trucks = [pack(load_vehicle(write(example))) for example in examples]
    assert not [one for one in trucks if np.array_equal(one.params, default.params)]


def test_every_shipped_vehicle_is_on_the_page() -> None:
    page = PAGE.read_text(encoding="utf-8")
    for path in (config_dir() / "vehicles").glob("*.yaml"):
        assert f"| `{path.stem}` |" in page


def test_every_tag_in_the_files_is_explained() -> None:
    page = PAGE.read_text(encoding="utf-8")
    used = {tag for path in config_dir().rglob("*.yaml") for tag in TAGS.findall(path.read_text())}
    assert used <= set(TAGS.findall(page.split("## All keys", maxsplit=1)[0]))


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("\nunits: {tractor: {body: {mass: 5000}}}", "line 3: units.tractor.body.mass: 5000"),
        ("\n\naxles: {drive_2: {x_m: 9}}", "line 4: axles.drive_2.x_m: 9 m lies outside"),
        ("effects: {hub.steer_left.brake_gian: 1}", "line 2: effects.hub.steer_left.brake_gian"),
    ],
)
def test_the_errors_on_the_page_are_the_real_ones(
    extending: Callable[[str], Path], text: str, line: str
) -> None:
    with pytest.raises(InputError) as caught:
        load_vehicle(extending(text))
    assert line in str(caught.value)
    real = str(caught.value).replace(str(caught.value.file), "mine.yaml")
    assert real in PAGE.read_text(encoding="utf-8")

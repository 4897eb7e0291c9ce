"""Numbers in YAML are those that people write, in files of every kind."""

from __future__ import annotations

import datetime
import math
from pathlib import Path

import pytest
import yaml

from truck_blowout_sim.diagnosis.settings_file import settings_tree
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings.mapping.mapping_file import load_mapping
from truck_blowout_sim.simulation import load_scenario
from truck_blowout_sim.vehicle import load_vehicle
from truck_blowout_sim.yaml_numbers import FAST_LOADER, LOADER

TRUCK = "extends: international_9400i_trailmobile\n"


@pytest.mark.parametrize("loader", [LOADER, FAST_LOADER])
@pytest.mark.parametrize(("text", "value"), [
    ("1e-3", 1e-3), ("3e6", 3e6), ("1.5E+2", 150.0), (".5", 0.5), ("5.", 5.0), ("-2", -2),
    ("01040", 1040), ("-007", -7), ("1_000", 1000), ("0x1F", 31), ("0o17", 15), ("+.inf", math.inf),
    ("-.INF", -math.inf), ("20:1", "20:1"), ("1:30.5", "1:30.5"), ("0b11", "0b11"),
    ("1e", "1e"), ("205/55R16", "205/55R16"), ("yes", True), ("off", False), ("~", None),
    ("2001-12-14", datetime.date(2001, 12, 14)), ("'7'", "7"),
])  # fmt: skip
def test_values(loader: type[yaml.SafeLoader], text: str, value: object) -> None:
    found = yaml.load(f"a: {text}", Loader=loader)["a"]
    assert (type(found), found) == (type(value), value)


@pytest.mark.parametrize("loader", [LOADER, FAST_LOADER])
def test_a_text_tagged_as_a_number_is_refused(loader: type[yaml.SafeLoader]) -> None:
    for text in ("!!float 20:1", "!!int 1e3"):
        with pytest.raises(yaml.YAMLError, match="is not a number"):
            yaml.load(text, Loader=loader)


def test_a_ratio_is_no_number_of_a_vehicle(tmp_path: Path) -> None:
    path = tmp_path / "mine.yaml"
    path.write_text(TRUCK + "steering: {ratio: 20:1}\n")
    with pytest.raises(InputError, match=r"line 2: steering\.ratio: '20:1' is not a number"):
        load_vehicle(path)
    path.write_text(TRUCK + "steering: {ratio: 020}\n")
    steering = load_vehicle(path).spec.steering
    assert steering is not None
    assert steering.ratio == 20.0


def test_a_time_of_day_is_no_instant_of_a_scenario(tmp_path: Path) -> None:
    path = tmp_path / "mine.yaml"
    path.write_text("extends: steer_axle_blowout\nend_s: 1:30\n")
    with pytest.raises(InputError, match=r"line 2: end_s: '1:30' is not a number"):
        load_scenario(path)


def test_numbers_of_a_mapping(tmp_path: Path) -> None:
    path = tmp_path / "map.yaml"
    path.write_text("channels: {tractor_vx_mps: {from: Speed, offset: 1e-3}}\n"
                    "blowouts: [{tire: steer_left, at_s: 4e0}]\n")  # fmt: skip
    rules = load_mapping(path)
    assert (rules.channels["tractor_vx_mps"].offset, rules.blowouts[0].time_s) == (1e-3, 4.0)
    path.write_text("blowouts: [{tire: steer_left, at_s: 1:30}]\n")
    with pytest.raises(InputError, match=r"key blowouts\.1\.at_s: is '1:30'; expected a number"):
        load_mapping(path)


def test_numbers_of_settings(tmp_path: Path) -> None:
    path = tmp_path / "mine.yaml"
    path.write_text("extends: default\nmethod: {bin_s: {value: 2e-1, source: coarse}}\n")
    assert settings_tree(path)["method"]["bin_s"]["value"] == 0.2

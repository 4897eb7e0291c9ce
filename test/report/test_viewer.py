"""The page of `view`: whole in itself, small, and true to the vehicle file."""

from __future__ import annotations

import hashlib
import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from truck_blowout_sim import Blowout, Recording, Series, Vehicle, load_vehicle
from truck_blowout_sim.cli.main import main
from truck_blowout_sim.motion import motion_of
from truck_blowout_sim.recordings.channels import channels_for
from truck_blowout_sim.report import viewer
from truck_blowout_sim.report.viewer.page import viewer_page
from truck_blowout_sim.report.viewer.shapes import vehicle_shape

VENDOR = Path(viewer.__file__).parent / "vendor"
RECORD = "test_2013_steer_blowout"


def full_run(vehicle: Vehicle, name: str = "run", far: float = 0.0) -> viewer.RunToShow:
    """20 s at 100 Hz of every channel there is, none of them smooth."""
    time = np.arange(0.0, 20.0, 0.01)
    random = np.random.default_rng(1)
    channels = {c.name: Series(time, np.cumsum(random.normal(size=time.size)))
                for c in channels_for(vehicle.hubs, vehicle.tires, vehicle.units)}
    channels["tractor_x_m"] = Series(time, 20.0 * time + far)
    run = Recording(name, channels, (Blowout(5.0, ("steer_left",)),))
    return viewer.RunToShow(run, motion_of(run, vehicle), vehicle)


def data_of(page: str) -> dict:
    return json.loads(re.search(r'id="data">(.*?)</script>', page, re.S)[1])  # type: ignore[index]


def test_20_s_of_every_channel_stay_under_5_mb(vehicle: Vehicle) -> None:
    run = full_run(vehicle)
    page = viewer_page([run])
    assert len(page) < 5e6
    shown = [channel["name"] for channel in data_of(page)["runs"][0]["channels"]]
    assert shown == list(run.recording.channels)


def test_nothing_is_loaded_from_elsewhere(vehicle: Vehicle) -> None:
    page = viewer_page([full_run(vehicle)])
    assert not re.search(r'(src|href)\s*=\s*["\']?(https?:)?//', page)
    assert "<link" not in page
    assert "import(" not in page


def test_a_name_cannot_end_the_script(vehicle: Vehicle) -> None:
    run = full_run(vehicle)
    evil = replace(run, recording=replace(run.recording, name="</script><b>&"))
    page = viewer_page([evil])
    assert page.count("</script>") == 3
    assert data_of(page)["runs"][0]["name"] == "</script><b>&"


def test_a_run_that_begins_elsewhere_is_brought_beside_the_first(vehicle: Vehicle) -> None:
    page = viewer_page([full_run(vehicle), full_run(vehicle, "away", far=4.0e6)])
    first, away = data_of(page)["runs"]
    assert away["motion"]["units"]["tractor"]["x"]["low"] == pytest.approx(
        first["motion"]["units"]["tractor"]["x"]["low"], abs=1.0)
    assert any("moved" in words for words in away["assumptions"])


@pytest.mark.parametrize("name", ["international_9400i_trailmobile", "rigid_truck",
                                  "ferrari_250lm"])
def test_every_shipped_vehicle_has_a_shape_with_all_its_tires(name: str) -> None:
    vehicle = load_vehicle(name)
    shape = vehicle_shape(vehicle)
    tires = [tire["name"] for hub in shape["hubs"] for tire in hub["tires"]]
    assert tires == list(vehicle.tires)
    assert all(unit["front"] > max(unit["axles"]) > unit["rear"]
               for unit in shape["units"].values())


def test_the_copy_of_three_is_the_one_that_its_provenance_names() -> None:
    said = re.search(r"sha256: (\w{64})", (VENDOR / "PROVENANCE.md").read_text())
    assert said is not None
    assert hashlib.sha256((VENDOR / "three.min.js").read_bytes()).hexdigest() == said[1]
    assert "MIT License" in (VENDOR / "three.LICENSE.txt").read_text()


def test_view_writes_a_page_says_what_it_assumed_and_overwrites_nothing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    page = tmp_path / "record.html"
    assert main(["view", RECORD, "-o", str(page), "--json"]) == 0
    said = json.loads(capsys.readouterr().out)
    assert said["bytes"] == page.stat().st_size
    assert any("roll of the tractor" in words for words in said["assumptions"][RECORD])
    assert main(["view", RECORD, "-o", str(page)]) == 2
    assert "--force" in capsys.readouterr().err
    assert main(["view", RECORD, "-o", str(tmp_path / "x.html"), "--camera", "chasse"]) == 2
    assert "chase" in capsys.readouterr().err

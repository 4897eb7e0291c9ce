"""The page of the whole way: what a diagnosis found, between the fit before and after."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from truck_blowout_sim import Vehicle, compare
from truck_blowout_sim.report.story_page import Story, write_story
from truck_blowout_sim.report.story_variants import Variant
from truck_blowout_sim.vehicle.document import Place
from truck_blowout_sim.vehicle.vehicle import Effect

FOUND = {
    "verdict": "missing_physics",
    "effects": [{
        "name": "steering_lag", "where": {"body": "tractor", "axle": "steer", "hub": None,
                                          "tire": None},
        "parameters": {"extra_lag_s": {"value": 0.4, "unit": "s", "ci90": [0.25, 0.55]}},
        "equation": "delta < hand wheel", "sentence": "The road wheels follow late.",
    }],
    "alias_sets": [["steering_lag", "blown_tire_drag"]],
    "location": {"channels": [{"name": "tractor_yaw_rate_radps", "sigma": 25.6}],
                 "interval_s": [-1.5, 6.5], "body": "tractor",
                 "wrench": {"fx_n": -1608.0, "fy_n": 453.0, "mz_nm": 1842.0}},
    "fit": {"train": {"before": {"tractor_yaw_rate_radps": 25.6},
                      "after": {"tractor_yaw_rate_radps": 9.2}}},
    "next_test": "Record the road wheel.",
}  # fmt: skip
NOTHING = {**FOUND, "verdict": "consistent",
           "summary": {"wrong": "The model explains this.", "sure": "Three of ten show as much."},
           "effects": [], "alias_sets": [], "next_test": "",
           "location": {"channels": [], "interval_s": None, "body": None,
                        "wrench": {"fx_n": None, "fy_n": None, "mz_nm": None}},  # as it is written
           "fit": {"train": {"before": {}, "after": {}}}}  # fmt: skip


@pytest.fixture(scope="module")
def story(vehicle: Vehicle) -> Story:
    before = compare("test_2013_steer_blowout", vehicle)
    late = Effect(0.4, "diagnosed", Place("x", 1, ""))
    after = replace(before, vehicle=replace(vehicle, effects={"steering.lag_s": late}))
    return Story(before, after, FOUND, [("the run", "run.html")])


def test_the_page_tells_all_six_parts_in_order(story: Story, tmp_path: Path) -> None:
    page = write_story(story, tmp_path / "index.html").read_text()
    parts = ["1. The record", "No measurement", "2. The model", "3. Where they differ", "25.6 σ",
             "4. What is missing", "delta &lt; hand wheel", "0.25 to 0.55",
             "steering lag or blown tire drag", "Record the road wheel", "5. The model, amended",
             "steering.lag_s", "6. The fit", "9.2"]
    places = [page.index(part) for part in parts]
    assert places == sorted(places)
    assert 'href="run.html"' in page


def test_a_consistent_record_has_a_page_too(story: Story, tmp_path: Path) -> None:
    page = write_story(replace(story, diagnosis=NOTHING), tmp_path / "index.html").read_text()
    assert "Nowhere beyond noise" in page
    assert "Verdict: consistent. The model explains this." in page
    assert "No effect was named; the verdict is “consistent”. Three of ten show as much." in page
    assert "with the named effects" not in page


def test_other_models_of_the_run_are_told_if_there_are_any(story: Story, tmp_path: Path) -> None:
    assert "7. The same run" not in write_story(story, tmp_path / "one.html").read_text()
    three = tuple(Variant(words, story.before) for words in ("as given", "rigid", "published"))
    told = replace(story, variants=three, lesson="The linkage gives way.")
    page = write_story(told, tmp_path / "three.html").read_text()
    assert page.index("6. The fit") < page.index("7. The same run") < page.index("gives way")


def test_a_variant_is_measured_from_its_blowout_on(story: Story) -> None:
    one = Variant("as given", story.before)
    early, late = (one.after_event("tractor_yaw_rate_radps", *between)
                   for between in ((-0.5, -0.1), (0.5, 0.8)))
    assert abs(early) < 0.01 * late
    assert 0.02 < late < 0.05  # 1 to 3 deg/s to the side of the flat tire

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.result import (
    AliasSet,
    Calibrated,
    ChannelSigma,
    ChannelTimeMap,
    Diagnosis,
    Effect,
    Evidence,
    Fit,
    Location,
    Parameter,
    Place,
    Showing,
    Wrench,
    write_diagnosis,
)
from truck_blowout_sim.report.diagnosis_rows import calibrated_row

EFFECT = Effect(
    name="brake_imbalance",
    kind="physics",
    where=Place("trailer", "trailer_2", "trailer_2_left", None),
    parameters={"gain": Parameter(0.35, "1", (0.31, math.inf))},
    equation="T = 0.35 T_sheet",
    sentence="One brake is weak.",
)
DIAGNOSIS = Diagnosis(
    verdict="missing_physics",
    sentence="The brake of trailer_2_left is weak.",
    effects=(EFFECT,),
    alias_sets=(AliasSet(("brake_imbalance", "brake_fade")),),
    location=Location(
        (ChannelSigma("trailer_yaw_rate_radps", 12.5),), (4.0, 9.5), "trailer", -3.1, (-3.6, -2.7),
        Wrench(1200.0, 0.0, -900.0),
    ),
    train=Fit({"b": 3.0, "a": 9.0}, {"a": 1.1, "b": 1.0}),
    null_p_value=0.001,
    next_test="Brake from 60 mph.",
)  # fmt: skip


def written(diagnosis: Diagnosis, folder: Path) -> bytes:
    write_diagnosis(diagnosis, folder / "diagnosis.json")
    return (folder / "diagnosis.json").read_bytes()


def test_the_file_has_the_promised_keys_and_values(tmp_path: Path) -> None:
    assert json.loads(written(DIAGNOSIS, tmp_path)) == {
        "verdict": "missing_physics",
        "effects": [
            {
                "name": "brake_imbalance",
                "kind": "physics",
                "where": {
                    "body": "trailer", "axle": "trailer_2", "hub": "trailer_2_left", "tire": None
                },
                "onset_s": None,
                "onset_ci90_s": None,
                "parameters": {"gain": {"value": 0.35, "unit": "1", "ci90": [0.31, None]}},
                "equation": "T = 0.35 T_sheet",
                "sentence": "One brake is weak.",
            }
        ],
        "alias_sets": [["brake_imbalance", "brake_fade"]],
        "location": {
            "channels": [{"name": "trailer_yaw_rate_radps", "sigma": 12.5}],
            "interval_s": [4.0, 9.5],
            "body": "trailer",
            "line_of_action_x_m": -3.1,
            "line_of_action_ci90_m": [-3.6, -2.7],
            "wrench": {"fx_n": 1200.0, "fy_n": 0.0, "mz_nm": -900.0},
        },
        "fit": {
            "train": {"before": {"a": 9.0, "b": 3.0}, "after": {"a": 1.1, "b": 1.0}},
            "holdout": {"before": {}, "after": {}},
        },
        "null_p_value": 0.001,
        "next_test": "Brake from 60 mph.",
        "summary": {
            "wrong": "The brake of trailer_2_left is weak.",
            "sure": "A vehicle with nothing missing gives as strong evidence in 1 of 1,000 cases; "
            "brake_imbalance trailer_2_left: gain 0.35 (90 %: from 0.31); these recordings cannot "
            "tell brake_imbalance trailer_2_left from brake_fade.",
            "changed": "No unseen run was given (--holdout); on the fitted runs the error, in "
            "units of each channel's noise, fell for a (9 to 1.1) and b (3 to 1); it rose for no "
            "channel.",
        },
        "pulled": [],
        "would_show": [],
    }  # fmt: skip


def test_what_would_have_been_named_is_written(tmp_path: Path) -> None:
    one = Showing("road_grade", Place("tractor"), "grade_rad", "rad", None, 0.004)
    sound = Diagnosis("consistent", "Sound.", evidence=Evidence(would_show=(one,)))
    assert json.loads(written(sound, tmp_path))["would_show"] == [{
        "name": "road_grade", "parameter": "grade_rad", "unit": "rad", "below": None,
        "above": 0.004, "where": {"body": "tractor", "axle": None, "hub": None, "tire": None},
    }]  # fmt: skip


def test_the_order_of_channels_does_not_change_the_bytes(tmp_path: Path) -> None:
    other = replace(DIAGNOSIS, train=Fit({"a": 9.0, "b": 3.0}, {"b": 1.0, "a": 1.1}))
    assert written(other, tmp_path) == written(DIAGNOSIS, tmp_path)


def test_rounding_noise_does_not_change_the_bytes(tmp_path: Path) -> None:
    other = replace(DIAGNOSIS, null_p_value=float(np.nextafter(0.001, 1.0)))
    assert written(other, tmp_path) == written(DIAGNOSIS, tmp_path)


def test_a_number_that_is_none_is_refused_by_name_and_leaves_the_old_file(tmp_path: Path) -> None:
    before = written(DIAGNOSIS, tmp_path)
    bad = replace(DIAGNOSIS, train=Fit({"tractor_vx_mps": math.nan}))
    with pytest.raises(ValueError, match=r"fit\.train\.before\.tractor_vx_mps is nan"):
        write_diagnosis(bad, tmp_path / "diagnosis.json")
    assert (tmp_path / "diagnosis.json").read_bytes() == before
    assert [path.name for path in tmp_path.iterdir()] == ["diagnosis.json"]


def test_an_empty_answer_still_has_every_key(tmp_path: Path) -> None:
    found = json.loads(written(Diagnosis("consistent", "Nothing is missing."), tmp_path))
    assert list(found) == list(json.loads(written(DIAGNOSIS, tmp_path)))
    assert found["location"]["wrench"] == {"fx_n": None, "fy_n": None, "mz_nm": None}


def test_words_outside_the_promise_are_refused() -> None:
    with pytest.raises(ValueError, match="verdict 'fine'"):
        Diagnosis("fine", "")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="kind 'magic'"):
        replace(EFFECT, kind="magic")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="0 alias sets for 1 effects"):
        replace(DIAGNOSIS, alias_sets=())


def test_a_map_of_the_wrong_shape_is_refused() -> None:
    with pytest.raises(ValueError, match="expected \\(2, 3\\)"):
        ChannelTimeMap("run", "train", np.arange(4.0), ("a", "b"), np.zeros((3, 2)))


def test_a_number_that_makes_a_sheet_miscalibrated_is_listed(tmp_path: Path) -> None:
    """By the limit of the verdict, which is a little below where such numbers are stopped."""
    numbers = [Calibrated(f"n{k}", "rad", 0.0, 0.01, 0.01 * pull, 0.001)
               for k, pull in enumerate((2.89, 2.95, -3.0))]
    off = replace(DIAGNOSIS, evidence=replace(DIAGNOSIS.evidence, calibrated=tuple(numbers)))
    assert [one["name"] for one in json.loads(written(off, tmp_path))["pulled"]] == ["n1", "n2"]
    assert [calibrated_row(n)["style"] for n in numbers] == ["", "bad", "bad"]

"""The answer in three sentences."""

from __future__ import annotations

from dataclasses import replace

import pytest

from truck_blowout_sim.diagnosis.result import (
    AliasSet,
    Diagnosis,
    Effect,
    Fit,
    Parameter,
    Place,
    amount_text,
    label_of,
    plain,
    summarize,
)


def test_what_got_worse_is_said_beside_what_got_better(diagnosis: Diagnosis) -> None:
    fit = Fit({"tractor_vx_mps": 49.0, "tractor_roll_rad": 22.0, "tractor_vy_mps": 1.2},
              {"tractor_vx_mps": 1.9, "tractor_roll_rad": 46.0, "tractor_vy_mps": 1.3})  # fmt: skip
    said = summarize(replace(diagnosis, holdout=fit)).changed
    assert said == (
        "On unseen runs the error, in units of each channel's noise, fell for tractor vx "
        "(49 to 1.9); it rose for tractor roll (22 to 46)."
    )


@pytest.mark.parametrize(("before", "after"), [(30.0, 28.8), (1.0, 1.45), (30.0, 30.0)])
def test_what_hardly_changed_is_said_with_both_limits(diagnosis: Diagnosis, before: float,
                                                      after: float) -> None:
    """An error of 30 that falls by 1.2 changed by more than the noise, and by less than 5 %."""
    fit = Fit({"tractor_vx_mps": before}, {"tractor_vx_mps": after})
    said = summarize(replace(diagnosis, holdout=fit)).changed
    assert said == ("On unseen runs no channel's error changed by more than both 50% of its noise "
                    "and 5% of itself.")


@pytest.mark.parametrize(("before", "after"), [(30.0, 28.4), (1.0, 1.6)])
def test_a_change_beyond_both_limits_is_told(diagnosis: Diagnosis, before: float,
                                             after: float) -> None:
    fit = Fit({"tractor_vx_mps": before}, {"tractor_vx_mps": after})
    assert f"({before:g} to {after:g})" in summarize(replace(diagnosis, holdout=fit)).changed


def test_chance_look_alikes_and_amount_are_said(diagnosis: Diagnosis) -> None:
    said = summarize(diagnosis).sure
    assert said.startswith("A vehicle with nothing missing gives as strong evidence in 1 of 10,000")
    assert "gain 0.356 (90 %: 0.331 to 0.382)" in said
    assert "cannot tell brake_imbalance trailer_2_left from brake_fade" in said


@pytest.mark.parametrize(("rule", "because"), [
    ("holdout", "but unseen runs are predicted worse with it"),
    ("bound", "but its amount ran to the end of what was searched")])
def test_what_stood_out_and_was_refused_is_said_where_nothing_is_named(
    diagnosis: Diagnosis, rule: str, because: str
) -> None:
    """Else little chance would stand beside a verdict that nothing is missing."""
    refused = replace(diagnosis.evidence.candidates[0], rule=rule, p_value=1e-5)
    evidence = replace(diagnosis.evidence, candidates=(refused,))
    calm = replace(diagnosis, verdict="consistent", effects=(), alias_sets=(), evidence=evidence)
    said = summarize(replace(calm, null_p_value=2e-5)).sure
    assert f": {refused.name} {refused.where} stands out in training, {because}" in said
    assert said.endswith("so it is not named.")
    assert "stands out" not in summarize(replace(calm, null_p_value=0.5)).sure
    assert "stands out" not in summarize(replace(diagnosis, evidence=evidence)).sure


@pytest.mark.parametrize(
    ("name", "parameter", "text"),
    [
        ("bias", Parameter(0.01, "rad/s", (0.008, 0.012)),
         "0.573 deg/s (90 %: 0.458 to 0.688)"),
        ("scale_error", Parameter(0.08, "1", (0.07, 0.09)), "8 % (90 %: 7 to 9)"),
        ("gain", Parameter(0.0, "1", (0.0, 0.1)), "0 (90 %: 0 to 0.1)"),
    ],
)  # fmt: skip
def test_amounts_are_in_units_a_person_reads(name: str, parameter: Parameter, text: str) -> None:
    assert amount_text(name, parameter) == text


def test_effects_of_one_name_are_told_apart() -> None:
    late = [
        Effect("channel_delay", "sensor", Place(body="tractor"), {}, "", "", instrument=words)
        for words in ("tractor gyros", "tractor velocity")
    ]
    labels = [label_of(effect, late) for effect in late]
    assert labels == [
        "channel_delay tractor (tractor gyros)", "channel_delay tractor (tractor velocity)"
    ]  # fmt: skip
    answer = Diagnosis("sensor_artefact", "Two are late.", tuple(late),
                       (AliasSet(("channel_delay",)), AliasSet(("channel_delay",))))  # fmt: skip
    assert summarize(answer).wrong == "Two are late."


@pytest.mark.parametrize(("name", "words"), [
    ("extra_moment_nm", "extra moment"), ("extra_drag_area_m2", "extra drag area"),
    ("torque_ratio", "torque ratio"), ("tractor_yaw_rate_radps", "tractor yaw rate"),
])  # fmt: skip
def test_a_name_is_read_without_its_unit(name: str, words: str) -> None:
    assert plain(name) == words

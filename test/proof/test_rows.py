from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from truck_blowout_sim.proof.cases import Cause, read_truth
from truck_blowout_sim.proof.rows import rows, uniformity, wrong_names
from truck_blowout_sim.proof.score import CaseScore, score_case
from truck_blowout_sim.proof.short import WORDS
from truck_blowout_sim.proof.summary import naming, verdicts
from truck_blowout_sim.proof.table import SOUGHT

Maker = Callable[..., dict[str, Any]]
SEEN = "effects seen by an ideal detector, among the causes named"
BEYOND = "effects beyond six spreads of fault-free vehicles, among the causes named"


def scored(tmp_path: Path, write_case: Callable[..., Path], name: str, line: dict[str, Any],
           group: str = "null", effects: tuple[dict[str, Any], ...] = (),
           sigma_b: float | None = None, individual: float | None = None,
           apart: float | None = None) -> tuple[CaseScore, Any]:
    answer = write_case(tmp_path, name, group, effects)
    if sigma_b is not None or individual is not None:
        path, known = tmp_path / "sigma_b.json", {}
        if path.is_file():
            known = json.loads(path.read_text())
        measured = {"sigma_b": [sigma_b] * len(effects),
                    "individual": [individual] * len(effects), "apart": [apart] * len(effects)}
        path.write_text(json.dumps({**known, name: {
            key: one for key, one in measured.items() if one[0]}}))
    truth = read_truth(answer)
    return score_case(line, truth), truth


def test_only_effects_that_can_be_seen_count(
        tmp_path: Path, write_case: Callable[..., Path], line: Maker, cause: Maker, effect: Maker
) -> None:
    faint = scored(tmp_path, write_case, "a", line("a", "consistent"), "single", (cause(),), 3.0)
    plain = scored(tmp_path, write_case, "b", line("b", effects=(effect(),)), "single",
                   (cause(),), 20.0)
    lost = scored(tmp_path, write_case, "c", line("c", "consistent"), "single", (cause(),), 8.0)
    found = dict(rows([s for s, _ in (faint, plain, lost)],
                      {s.case: t for s, t in (faint, plain, lost)}))
    named = found[SEEN]
    assert (named.hits, named.trials) == (1, 2)


def test_what_sound_vehicles_differ_by_counts_in_a_row_of_its_own(
        tmp_path: Path, write_case: Callable[..., Path], line: Maker, cause: Maker, effect: Maker
) -> None:
    usual = scored(tmp_path, write_case, "a", line("a", "consistent"), "single", (cause(),),
                   100.0, 2.0)
    strong = scored(tmp_path, write_case, "b", line("b", effects=(effect(),)), "single",
                    (cause(),), 100.0, 50.0)
    assert usual[1].causes[0].beyond_spread < 2.0
    assert strong[1].causes[0].beyond_spread == pytest.approx(44.7, abs=0.1)
    found = dict(rows([usual[0], strong[0]], {s.case: t for s, t in (usual, strong)}))
    seen, beyond = found[SEEN], found[BEYOND]
    assert (seen.hits, seen.trials, beyond.hits, beyond.trials) == (1, 2, 1, 1)


@pytest.mark.parametrize(("sigma_b", "individual", "seen"), [
    (50.0, 1e12, 50.0), (1e9, 7.0, 7.0), (3.0, 4.0, 2.4), (0.0, 4.0, 0.0),
])
def test_a_detector_sees_no_more_than_its_own_noise_or_what_vehicles_differ_by(
        sigma_b: float, individual: float, seen: float) -> None:
    cause = Cause("brake_lag", "physics", {}, None, {}, ("", 0.0, ""), sigma_b, individual)
    assert cause.beyond_spread == pytest.approx(seen)


def test_without_sigma_b_the_spread_alone_counts_and_no_effect_is_called_seen(
        tmp_path: Path, write_case: Callable[..., Path], line: Maker, cause: Maker
) -> None:
    strong = scored(tmp_path, write_case, "a", line("a", "consistent"), "single", (cause(),),
                    individual=50.0)
    found = dict(rows([strong[0]], {strong[0].case: strong[1]}))
    assert found[SEEN].trials == 0
    assert found[BEYOND].trials == 1


def test_a_name_beside_the_true_one_is_wrong_unless_aliased(
        tmp_path: Path, write_case: Callable[..., Path], line: Maker, cause: Maker, effect: Maker
) -> None:
    two = (effect(), effect("crosswind"))
    both = scored(tmp_path, write_case, "a", line("a", effects=two), "single", (cause(),))
    excused = scored(tmp_path, write_case, "b", line(
        "b", effects=(effect("crosswind"),), alias_sets=(("crosswind", "brake_lag"),)),
        "single", (cause(),))
    assert wrong_names(*both) == ["crosswind"]
    assert wrong_names(*excused) == []


def test_false_alarms_are_names_and_unknown(
        tmp_path: Path, write_case: Callable[..., Path], line: Maker, effect: Maker) -> None:
    cases = [scored(tmp_path, write_case, name, line(name, verdict, effects=effects, p_value=p))
             for name, verdict, effects, p in (
                 ("a", "consistent", (), 0.3), ("b", "unknown", (), 0.01),
                 ("c", "missing_physics", (effect(),), 0.02), ("d", "miscalibrated", (), 0.6),
                 ("e", "consistent", (), 0.9))]
    found = dict(rows([s for s, _ in cases], {s.case: t for s, t in cases}))
    assert found["false alarms, nothing missing"].hits == 2
    uniform = uniformity([s for s, _ in cases])
    assert uniform is not None
    assert uniform > 0.1


def test_unseen_runs_are_counted_apart_where_physics_was_named(
        tmp_path: Path, write_case: Callable[..., Path], line: Maker, cause: Maker, effect: Maker
) -> None:
    named = scored(tmp_path, write_case, "a", line("a", effects=(effect(),)), "single", (cause(),))
    worse = scored(tmp_path, write_case, "b", line("b", effects=(effect(),), holdout=(1.0, 2.0)),
                   "single", (cause(),))
    still = scored(tmp_path, write_case, "c", line("c", "consistent", holdout=(2.0, 2.0)),
                   "single", (cause(),))
    found = dict(rows([s for s, _ in (named, worse, still)],
                      {s.case: t for s, t in (named, worse, still)}))
    every, where = (found[f"holdout better{tail}"] for tail in ("", ", where physics was named"))
    assert (every.hits, every.trials) == (1, 3)
    assert (where.hits, where.trials) == (1, 2)


def test_what_could_become_better_is_counted(
        tmp_path: Path, write_case: Callable[..., Path], line: Maker, cause: Maker, effect: Maker
) -> None:
    """Of what exceeds six spreads, how much became better; how many cases have such an effect."""
    plain = scored(tmp_path, write_case, "a", line("a", effects=(effect(),)), "single", (cause(),),
                   100.0, 50.0)
    missed = scored(tmp_path, write_case, "b", line("b", "consistent", holdout=(2.0, 2.0)),
                    "single", (cause(),), 100.0, 50.0)
    faint = scored(tmp_path, write_case, "c", line("c", "consistent", holdout=(2.0, 2.0)),
                   "single", (cause(),), 100.0, 2.0)
    found = dict(rows([s for s, _ in (plain, missed, faint)],
                      {s.case: t for s, t in (plain, missed, faint)}))
    strong = found["holdout better, an effect beyond six spreads"]
    share = found["cases with physics missing that have an effect beyond six spreads"]
    assert (strong.hits, strong.trials, share.hits, share.trials) == (1, 2, 2, 3)


def test_a_pair_counts_where_both_exceed_what_sound_vehicles_differ_by(
        tmp_path: Path, write_case: Callable[..., Path], line: Maker, cause: Maker, effect: Maker
) -> None:
    """A detector that sees all differences between vehicles does not make them effects."""
    two = (cause(), cause("crosswind"))
    faint, plain = (scored(tmp_path, write_case, name, line(name, effects=(effect(),)), "pair",
                           two, 100.0, individual) for name, individual in
                    (("a", 2.0), ("b", 50.0)))
    found = dict(rows([faint[0], plain[0]], {s.case: t for s, t in (faint, plain)}))
    both = found["both of a pair"]
    assert (both.hits, both.trials) == (0, 1)


@pytest.mark.parametrize(("group", "row", "all_of_them"), [
    ("unknown", "of no list, and no listed effect imitates it: unknown", "of no list: unknown"),
    ("pair", "both of a pair, neither imitates the other", "both of a pair"),
])
def test_what_another_effect_imitates_is_left_out_of_a_row(
        tmp_path: Path, write_case: Callable[..., Path], line: Maker, cause: Maker, group: str,
        row: str, all_of_them: str) -> None:
    """Both are as visible, but of one an effect of another name leaves two spreads."""
    cases = [scored(tmp_path, write_case, name, line(name, "unknown"), group, (cause(),), 20.0,
                    50.0, apart) for name, apart in (("a", 2.0), ("b", 12.0), ("c", None))]
    found = dict(rows([s for s, _ in cases], {s.case: t for s, t in cases}))
    assert found[all_of_them].trials == 3
    assert found[row].trials == 1


def test_the_words_of_a_row_say_what_it_counts(
    tmp_path: Path, write_case: Callable[..., Path], cause: Maker, effect: Maker, line: Maker
) -> None:
    """An instrument that is named counts as a name, and ``unknown`` as an alarm."""
    fault = effect("yaw_rate_bias", kind="sensor")
    one = scored(tmp_path, write_case, "a", line("a", "sensor_artefact", (fault,)), "single",
                 (cause(),))
    calm = scored(tmp_path, write_case, "b", line("b", "unknown"))
    found = dict(rows([one[0], calm[0]], {s.case: t for s, t in (one, calm)}))
    row = found["one effect: truth in the alias set, where something was named"]
    assert (row.hits, row.trials) == (0, 1)
    assert naming([one[0]])["truth inside the alias set, where something was named"].trials == 1
    assert verdicts([calm[0]])["false discovery on nulls"].hits == 1
    assert "unknown" in WORDS["false discovery on nulls"]
    assert set(WORDS) <= set(SOUGHT)

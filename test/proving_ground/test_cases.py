from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path

import pytest
from typer.testing import CliRunner

import proving_ground
from proving_ground.__main__ import app
from proving_ground.cases import CaseSpec, EffectSpec, read_case, write_case
from proving_ground.effects import FAMILIES, IN_TABLES, LISTED, UNLISTED
from proving_ground.faults import FAULTS
from proving_ground.generate import generate, interleaved, pending
from proving_ground.seal import broken_seals, write_manifest
from proving_ground.table import SETS, Table, cases_of

SMALL = CaseSpec("small-1", "single", 77, ("straight",), ("blowout_free",), ("blowout_free",),
                 (EffectSpec("blown_tire_drag", 0, 1.0, None, 0.5),), (), ("tire_pressure",))


@pytest.fixture(scope="module")
def tables() -> dict[str, list[CaseSpec]]:
    return {name: cases_of(name) for name in SETS}


def test_test_set_is_as_large_as_promised(tables: dict[str, list[CaseSpec]]) -> None:
    groups = [spec.group for spec in tables["test"]]
    assert {group: groups.count(group) for group in set(groups)} == {
        "null": 120, "single": 160, "pair": 40, "sensor": 40, "unknown": 40}


def test_sets_share_no_seed_manoeuvre_or_severity(tables: dict[str, list[CaseSpec]]) -> None:
    """Trucks and runs draw from streams of their own, so that a number may stand for one of each.

    What is drawn for a truck is tagged otherwise than what is drawn for a run (next test).
    """
    def gather(name: str) -> tuple[set[int], set[int], set[str], set[float]]:
        specs = tables[name]
        return ({spec.seed for spec in specs},
                {seed for spec in specs for _, _, seed in spec.runs()},
                {kind for spec in specs for _, kind, _ in spec.runs()},
                {part.sigma for spec in specs if spec.group == "single"
                 for part in spec.effects if part.sigma})

    for dev, test in zip(gather("dev"), gather("test"), strict=True):
        assert dev
        assert test
        assert not dev & test


def test_every_stream_of_random_numbers_has_a_tag_of_its_own() -> None:
    found = [tag for file in Path(proving_ground.__file__).parent.rglob("*.py")
             for tag in re.findall(r"default_rng\(\[[^\],]+, (\d+)\]", file.read_text("utf-8"))]
    assert len(found) >= 10
    assert len(found) == len(set(found))


def test_the_small_set_has_every_group_and_seeds_of_its_own(
        tables: dict[str, list[CaseSpec]]) -> None:
    groups = [spec.group for spec in tables["ci"]]
    assert {group: groups.count(group) for group in set(groups)} == {
        "null": 6, "single": 10, "pair": 2, "sensor": 4, "unknown": 2}
    # Halves are diagnosed side by side and have a share of each group.
    assert sorted(groups[::2]) == sorted(groups[1::2])
    seeds = {spec.seed for spec in tables["ci"]}
    assert not seeds & {spec.seed for name in ("dev", "test") for spec in tables[name]}


def test_singles_cover_every_name_and_four_severities(
        tables: dict[str, list[CaseSpec]]) -> None:
    singles = [spec.effects[0] for spec in tables["test"] if spec.group == "single"]
    assert len({effect.name for effect in singles}) == 21
    assert {effect.sigma for effect in singles} == {5.0, 10.0, 20.0, 50.0}


def test_every_name_has_one_family() -> None:
    names = [name for family in FAMILIES.values() for name in family]
    assert len(names) == len(set(names))
    assert set(names) >= set(LISTED)
    assert set(names) - set(LISTED) == {"steering_angle_offset"}  # an instrument's, looks alike


def test_half_of_the_unknown_are_of_families_taken_out(tables: dict[str, list[CaseSpec]]) -> None:
    unknown = [spec for spec in tables["test"] if spec.group == "unknown"]
    out = [spec for spec in unknown if spec.without]
    assert len(out) == len(unknown) / 2
    known = {*IN_TABLES, *FAULTS}
    assert {spec.without for spec in out} == {
        tuple(name for name in names if name in known) for names in FAMILIES.values()}
    assert all(spec.effects[0].name in spec.without for spec in out)
    never = {spec.effects[0].name for spec in unknown if not spec.without}
    assert never == set(UNLISTED)


def test_tables_repeat(tables: dict[str, list[CaseSpec]]) -> None:
    assert Table("test").cases() == tables["test"]


def test_case_survives_its_file(tmp_path: Path, tables: dict[str, list[CaseSpec]]) -> None:
    for spec in tables["dev"][::20]:
        write_case(tmp_path / "case.yaml", spec)
        assert read_case(tmp_path / "case.yaml") == spec


def test_shipped_examples_are_cases() -> None:
    examples = (Path(proving_ground.__file__).parents[1] / "docs/example_cases").glob("*.yaml")
    assert {path.stem: read_case(path).effects[0].where.hub for path in examples} == {
        "weak_trailer_brake": "trailer_2_left", "loose_tread": "steer_left"}


def test_first_part_of_a_set_holds_every_group(tables: dict[str, list[CaseSpec]]) -> None:
    first = interleaved(tables["test"])[:100]
    groups = [spec.group for spec in first]
    assert {group: groups.count(group) for group in set(groups)} == {
        "null": 30, "single": 40, "pair": 10, "sensor": 10, "unknown": 10}


@pytest.mark.parametrize(("text", "words"), [
    ("- a list", "mapping"), ("colour: red", "unknown field"),
    ("{id: a, group: odd, seed: 1, baseline: [], train: [straight], holdout: [straight]}",
     "group"),
    ("{id: a, group: null, seed: 1, baseline: [], train: [loop], holdout: [straight]}", "group"),
    ("{id: a, group: single, seed: 1, baseline: [], train: [loop], holdout: [straight]}", "loop"),
    ("{id: a, group: single, seed: 1, baseline: [], train: [straight], holdout: []}", "holdout"),
    ("{id: a, group: single, seed: 1, baseline: [], train: [straight], holdout: [straight], "
     "effects: [{name: gremlin}]}", "gremlin")])
def test_bad_case_file_is_refused_in_words(text: str, words: str, tmp_path: Path) -> None:
    path = tmp_path / "bad.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ValueError, match=words) as caught:
        read_case(path)
    assert "bad.yaml" in str(caught.value)
    result = CliRunner().invoke(app, ["generate", "-o", str(tmp_path), "--case", str(path)])
    assert result.exit_code == 2


def test_case_is_made_once_and_the_same_each_time(tmp_path: Path) -> None:
    for folder in ("one", "two"):
        assert list(generate([SMALL], tmp_path / folder, 1)) == [("small-1", "")]
    assert pending([SMALL], tmp_path / "one") == []
    files = sorted((tmp_path / "one" / "cases" / "small-1").iterdir())
    assert [path.name for path in files] == ["baseline_1.csv", "holdout_1.csv", "train_1.csv"]
    for path in files:
        twin = tmp_path / "two" / "cases" / "small-1" / path.name
        assert path.read_bytes() == twin.read_bytes()
    manifest = write_manifest(tmp_path / "one", "small")
    assert broken_seals(tmp_path / "two", manifest) == []
    head = files[0].read_text(encoding="utf-8").split("time_s", 1)[1].split("\n", 1)[0]
    assert "tire_pressure" not in head

    answer = tmp_path / "two" / "answers" / "small-1.json"
    told = json.loads(answer.read_text(encoding="utf-8"))
    assert told["effects"][0]["where"]["tire"] == "steer_left"
    assert told["effects"][0]["onset_s"].keys() == {"train_1", "holdout_1"}
    answer.write_text(json.dumps({**told, "group": "null"}), encoding="utf-8")
    assert broken_seals(tmp_path / "two", manifest) == ["small-1"]


def test_a_case_says_what_the_diagnosis_must_do_without(tmp_path: Path) -> None:
    spec = replace(SMALL, id="small-3", group="unknown", without=FAMILIES["the flat tire"])
    list(generate([spec], tmp_path, 1))
    told = json.loads((tmp_path / "cases" / "small-3" / "library.json").read_text("utf-8"))
    assert told == {"without": list(spec.without)}
    answer = json.loads((tmp_path / "answers" / "small-3.json").read_text(encoding="utf-8"))
    assert answer["verdicts"] == ["unknown"]
    assert answer["effects"][0]["kind"] == "taken_out"
    manifest = write_manifest(tmp_path, "small")
    (tmp_path / "cases" / "small-3" / "library.json").unlink()
    assert broken_seals(tmp_path, manifest) == ["small-3"]


def test_severity_is_calibrated_to_the_wanted_sigma(tmp_path: Path) -> None:
    effect = EffectSpec("aerodynamic_drag", 0, 1.0, 25.0)
    spec = replace(SMALL, id="small-2", train=("coast_slow",), holdout=("straight",),
                   effects=(effect,), missing=())
    list(generate([spec], tmp_path, 1))
    answer = json.loads((tmp_path / "answers" / "small-2.json").read_text(encoding="utf-8"))
    assert answer["effects"][0]["sigma"] == pytest.approx(25.0, rel=0.17)


def test_only_a_whole_set_is_published(tmp_path: Path, tables: dict[str, list[CaseSpec]]) -> None:
    for spec in tables["ci"]:
        path = tmp_path / "answers" / f"{spec.id}.json"
        path.parent.mkdir(exist_ok=True)
        path.write_text(spec.id, encoding="utf-8")
    to = tmp_path / "sealed" / "ci.json"
    words = ["seal", "-o", str(tmp_path), "--set", "ci", "--to", str(to)]
    assert CliRunner().invoke(app, words).exit_code == 0
    assert json.loads(to.read_text(encoding="utf-8"))["count"] == 24
    assert CliRunner().invoke(app, ["seal", "-o", str(tmp_path), "--check", str(to)]).exit_code == 0
    path.write_text("moved", encoding="utf-8")
    assert CliRunner().invoke(app, ["seal", "-o", str(tmp_path), "--check", str(to)]).exit_code == 2
    path.unlink()
    assert CliRunner().invoke(app, words).exit_code == 2

from __future__ import annotations

import re
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.result import (
    BeatScores,
    Diagnosis,
    Evidence,
    Location,
    Place,
    Showing,
)
from truck_blowout_sim.report.diagnosis_page import diagnosis_page, write_diagnosis_report
from truck_blowout_sim.report.diagnosis_rows import interval_text
from truck_blowout_sim.vehicle import Vehicle, load_vehicle

VOID = {"meta", "img", "br", "link"}


class Reader(HTMLParser):
    """Collects text, checks that tags close in order, and lists addresses."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.words: list[str] = []
        self.addresses: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag not in VOID:
            self.open.append(tag)
        self.addresses += [value or "" for key, value in attrs if key in ("src", "href")]

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if self.open and self.open[-1] != "style":
            self.words.append(data)

    @property
    def text(self) -> str:
        return " ".join(" ".join(self.words).split())


def read(page: str) -> Reader:
    reader = Reader()
    reader.feed(page)
    assert not reader.open
    return reader


@pytest.fixture(scope="module")
def page(diagnosis: Diagnosis, vehicle: Vehicle) -> str:
    return diagnosis_page(diagnosis, vehicle)


def test_the_verdict_comes_first(page: str, diagnosis: Diagnosis) -> None:
    text = read(page).text
    body = text[text.index("Diagnosis ·") :]
    assert body.index(diagnosis.sentence) < 150
    assert body.index(diagnosis.sentence) < body.index("What is missing")


def test_the_page_needs_no_other_file(page: str) -> None:
    addresses = read(page).addresses
    assert len(addresses) >= 8
    assert all(address.startswith("data:image/svg+xml;base64,") for address in addresses)
    assert not re.search(r"https?://", page)


def test_every_part_is_there(page: str, diagnosis: Diagnosis) -> None:
    text = read(page).text
    effect = diagnosis.effects[0]
    for words in (
        effect.sentence, effect.equation, "0.331 to 0.382", "from 20,000", "always there",
        "5.90 m behind base_link", "6.80 m behind to 5.10 m behind", "brake_fade (trailer_2)",
        diagnosis.next_test, "interval includes zero", "15,230", "train_2 has a gap",
        "The road is level and dry <everywhere>.", "brake_lag from brake_imbalance",
        "17210 ± 60", "+4.0", "A second stop with cold brakes", "0.0001",
    ):  # fmt: skip
        assert words in text, words


def test_text_is_escaped(page: str) -> None:
    assert "&lt;everywhere&gt;" in page
    assert "<everywhere>" not in page


def test_the_same_diagnosis_gives_the_same_bytes(
    page: str, diagnosis: Diagnosis, vehicle: Vehicle, tmp_path: Path
) -> None:
    write_diagnosis_report(diagnosis, vehicle, tmp_path / "report.html")
    assert (tmp_path / "report.html").read_text(encoding="utf-8") == page


@pytest.mark.parametrize("name", ["international_9400i_trailmobile", "ferrari_250lm"])
def test_an_answer_without_findings_is_a_page_too(name: str) -> None:
    nothing = Diagnosis("consistent", "The model reproduces the recordings.")
    text = read(diagnosis_page(nothing, load_vehicle(name))).text
    assert "The model reproduces the recordings." in text
    assert "there is nothing to locate" in text
    assert "What is missing" not in text


def test_what_would_have_shown_is_told_in_units_that_a_person_reads() -> None:
    shows = (Showing("steering_angle_offset", Place("tractor"), "offset_rad", "rad", -0.02, 0.02),
             Showing("road_bank", Place(), "bank_rad", "rad", None, None))
    sound = Diagnosis("consistent", "Sound.", evidence=Evidence(would_show=shows))
    text = read(diagnosis_page(sound, load_vehicle("ferrari_250lm"))).text
    assert "What these recordings would have shown" in text
    assert "steering_angle_offset tractor offset -1.15 deg 1.15 deg" in text
    assert "road_bank – bank – –" in text


def test_a_location_without_effects_is_drawn(diagnosis: Diagnosis, vehicle: Vehicle) -> None:
    unknown = replace(diagnosis, verdict="unknown", effects=(), alias_sets=(), sentence="Unknown.")
    text = read(diagnosis_page(unknown, vehicle)).text
    assert "unknown cause" in text
    assert "Missing wrench +2,100 N forward" in text
    nowhere = replace(unknown, location=Location(interval_s=(1.0, 2.5)))
    assert "1.00 to 2.50 s" in read(diagnosis_page(nowhere, vehicle)).text


def test_a_quick_page_has_the_printed_pictures_only(diagnosis: Diagnosis, vehicle: Vehicle
                                                    ) -> None:
    brief, whole = (diagnosis_page(diagnosis, vehicle, short) for short in (True, False))
    assert 2 <= brief.count("<img") < whole.count("<img")
    before = brief[:brief.index("All figures")]
    assert before.count("<img") >= brief.count("<img") - 1
    assert read(brief).text.startswith(read(whole).text[:500])


def test_what_beats_is_drawn(diagnosis: Diagnosis, vehicle: Vehicle) -> None:
    every = np.linspace(2.9, 3.3, 50)
    score = 20.0 * np.exp(-((every - 3.1) / 0.02) ** 2)
    without = diagnosis_page(diagnosis, vehicle).count("<img")
    for kind in ("turning", "steady", "swinging"):
        beats = BeatScores(kind, every, score, 8.0)
        beating = replace(diagnosis, evidence=replace(diagnosis.evidence, beats=beats))
        page = diagnosis_page(beating, vehicle)
        assert "Something beats" in page
        assert page.count("<img") == without + 1


def test_open_intervals_are_said_in_words() -> None:
    assert interval_text((-np.inf, 2.0), str) == "up to 2.0"
    assert interval_text((1.0, np.inf), str) == "from 1.0"
    assert interval_text((-np.inf, np.inf), str) == "open on both sides"

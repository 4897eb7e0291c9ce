"""What the answer says of a sheet that is off, and of one that is off beyond any truck."""

from __future__ import annotations

from truck_blowout_sim.diagnosis.answer.words import verdict_sentence


def test_a_sheet_that_is_off_is_told_with_its_numbers() -> None:
    sentence = verdict_sentence("miscalibrated", (), [("drag_area", -6.4), ("caster", 3.0)], None)
    assert sentence == ("No missing physics shows, but the sheet is off: drag area (-6.4 sigma), "
                        "caster (+3.0 sigma).")


def test_a_number_that_no_truck_has_is_not_told_as_one_of_the_sheet() -> None:
    sentence = verdict_sentence("miscalibrated", (), [("trailer_mass", -31.8)], None)
    assert "trailer mass (-31.8 sigma)" in sentence
    assert "No vehicle is so far off its sheet" in sentence
    assert "something is missing that these recordings cannot tell" in sentence

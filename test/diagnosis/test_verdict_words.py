"""What the answer says of a sheet that is off, and of one that is off beyond any truck."""

from __future__ import annotations

from dataclasses import replace

from truck_blowout_sim.diagnosis.answer.words import verdict_sentence
from truck_blowout_sim.diagnosis.model.law import Law


def test_a_sheet_that_is_off_is_told_with_its_numbers() -> None:
    sentence = verdict_sentence("miscalibrated", (), [("drag_area", -6.4), ("caster", 3.0)], None)
    assert sentence == ("No missing physics shows, but the sheet is off: drag area (-6.4 sigma), "
                        "caster (+3.0 sigma).")


def test_a_number_that_no_truck_has_is_not_told_as_one_of_the_sheet() -> None:
    sentence = verdict_sentence("miscalibrated", (), [("trailer_mass", -31.8)], None)
    assert "trailer mass (-31.8 sigma)" in sentence
    assert "No vehicle is so far off its sheet" in sentence
    assert "something is missing that these recordings cannot tell" in sentence


def test_beside_an_unknown_force_only_numbers_that_no_truck_has_are_told() -> None:
    """A brake that gives twice its torque shows as one, where the force is not explained."""
    pulled = [("brake_gain_trailer_2_left", 69.5), ("trailer_mass", -6.0)]
    law = Law("trailer", (("throttle", -2360.0),), "F_x,trailer = -2360 * throttle", 0.02, {})
    sentence = verdict_sentence("unknown", (), pulled, law)
    assert sentence.endswith(
        "No vehicle is so far off its sheet: brake gain trailer 2 left (+69.5 sigma).")
    assert "-2360" not in sentence  # left-out windows hardly confirm it
    assert "no plain law" in sentence
    confirmed = verdict_sentence("unknown", (), pulled[1:], replace(law, explained=0.8))
    assert "-2360 * throttle, which left-out windows confirm to 80 percent" in confirmed
    assert "sheet" not in confirmed

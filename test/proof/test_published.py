"""A run's answers beside those that were published."""

from __future__ import annotations

from pathlib import Path

import pytest

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.proof.published import repeats

HEAD = "case,concealed,sigma,sigma_b,verdict,named,solved\n"
BEFORE = (HEAD + "w1-1,nothing,,,consistent,,yes\n"
          "w1-2,brake_lag,20,9,missing physics,brake_lag,yes\n")  # fmt: skip


def tables(folder: Path, now: str) -> tuple[Path, Path]:
    run, published = folder / "cases.csv", folder / "published.csv"
    run.write_text(now, encoding="utf-8")
    published.write_text(BEFORE, encoding="utf-8")
    return run, published


def test_the_same_answers_are_told_from_others(tmp_path: Path) -> None:
    """A part of the published cases is enough; figures beside verdict and names may move."""
    same = repeats(*tables(tmp_path, HEAD + "w1-2,brake_lag,20.1,,missing physics,brake_lag,no\n"))
    assert [one.same for one in same] == [True]
    other = repeats(*tables(tmp_path, BEFORE.replace("physics,brake_lag", "physics,brake_fade")))
    assert [one.same for one in other] == [True, False]
    assert other[1].now == "missing physics: brake_fade"
    assert other[1].concealed == "brake_lag"


@pytest.mark.parametrize("now", ["", "case\nw1-1\n", HEAD + "w1-9,nothing,,,consistent,,yes\n"])
def test_what_is_no_table_of_published_cases_is_refused(tmp_path: Path, now: str) -> None:
    run, published = tables(tmp_path, now)
    if not now:
        run.unlink()
    with pytest.raises(InputError) as caught:
        repeats(run, published)
    assert "\n" not in str(caught.value)


def test_an_answer_that_a_correction_changed_is_told_with_its_reason(tmp_path: Path) -> None:
    run, published = tables(tmp_path, BEFORE.replace("physics,brake_lag", "physics,brake_fade"))
    changed = tmp_path / "changed.csv"
    changed.write_text("case,concealed,verdict,named,why\n"
                       "w1-2,brake_lag,missing physics,brake_fade,a reason\n", encoding="utf-8")
    same, other = repeats(run, published, changed)
    assert (same.same, same.corrected) == (True, False)
    assert (other.same, other.corrected, other.why) == (False, True, "a reason")
    changed.write_text(changed.read_text().replace("brake_fade", "roll_steer"))
    assert not repeats(run, published, changed)[1].corrected

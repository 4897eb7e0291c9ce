"""Options that take several values after one flag."""

from __future__ import annotations

import pytest

from truck_blowout_sim.cli.several import repeat_flags

BOTH = ("--baseline", "--holdout")


@pytest.mark.parametrize(("words", "spread"), [
    ("a --holdout b c -o x", "a --holdout b --holdout c -o x"),
    ("a --holdout b --holdout c", "a --holdout b --holdout c"),
    ("a --holdout b --baseline c d e", "a --holdout b --baseline c --baseline d --baseline e"),
    ("a -o x b --quick c", "a -o x b --quick c"),
    ("--holdout=b a", "--holdout=b a"),
    ("--holdout b -- a", "--holdout b -- a"),
])
def test_a_flag_stands_before_each_of_its_values(words: str, spread: str) -> None:
    assert repeat_flags(words.split(), BOTH) == spread.split()

"""Each fate is a record that reads as a sentence."""

from __future__ import annotations

from typing import get_args

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.effects import LIBRARY, Effect
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.diagnosis.fit.scatter import Chance, Scatter
from truck_blowout_sim.diagnosis.fit.shown import SCATTERS
from truck_blowout_sim.diagnosis.name.judging import imitates, weakness
from truck_blowout_sim.diagnosis.name.trial import Fate, Rule
from truck_blowout_sim.diagnosis.result.parts import Place

CHANCE = Chance(Scatter(np.eye(SCATTERS.size)[0]), 20.0, 0.02)
BANK = next(e for e in LIBRARY if e.name == "road_bank")


def test_every_rule_has_words_of_its_own() -> None:
    words = {rule: str(Fate(rule, 3.2, 11.0)) for rule in get_args(Rule)}
    assert len(set(words.values())) == len(words)
    assert not [text for text in words.values() if len(text) < 8 or set("{}") & set(text)]


def test_the_words_hold_value_and_limit() -> None:
    assert str(Fate("support", 7.44, 11.02)) == "support 7.4 of 11.0 that chance may reach"


@pytest.mark.parametrize(("changes", "rule"), [
    ({"refitted": False}, "refit"),
    ({"support": CHANCE.asked - 0.1}, "support"),
    ({"hypothesis": Hypothesis(BANK, Place(), BANK.amount.high)}, "bound"),
    ({"evidence": 5.0}, "remainder"),
    ({}, None),
])
def test_the_rule_that_is_broken_decides(changes: dict, rule: str | None) -> None:
    good = {"hypothesis": Hypothesis(BANK, Place(), 0.01), "delta": 90.0, "sigma": 0.001,
            "refitted": True, "evidence": 90.0, "support": CHANCE.asked + 0.1}
    fate = weakness(Ranked(**{**good, **changes}), CHANCE, 80.0)
    assert (fate and fate.rule) == rule
    if rule in ("support", "remainder"):
        assert fate is not None
        assert fate.value < fate.limit


def test_a_wind_gives_way_to_a_steady_cause_that_is_as_likely() -> None:
    wind = next(e for e in LIBRARY if e.name == "crosswind" and e.timed)
    lag = next(e for e in LIBRARY if e.name == "steering_lag")

    def tried(effect: Effect, support: float) -> Ranked:
        return Ranked(Hypothesis(effect, Place(), 0.5 * effect.amount.high), 400.0, 1.0,
                      support=support, refitted=True)

    asked = CHANCE.asked
    steady = tried(lag, asked + 1.0)
    assert imitates(tried(wind, asked + 3.0), [steady], CHANCE)
    assert not imitates(tried(wind, asked + 8.0), [steady], CHANCE)
    assert not imitates(tried(wind, asked + 3.0), [tried(lag, asked - 1.0)], CHANCE)
    assert not imitates(tried(BANK, asked + 3.0), [steady], CHANCE)

"""Severities of the later draws."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from proving_ground import settle
from proving_ground.cases import CaseSpec
from proving_ground.ensemble import Nulls
from proving_ground.kept_back import FROM, LATER
from proving_ground.worlds import CYCLE, severities
from proving_ground.worlds.draws import SIGMAS_B
from proving_ground.worlds.table import open_cases


def effects_of(first: int, count: int) -> list[CaseSpec]:
    return [severities.wanted(spec) for spec in open_cases("w2", first, count) if spec.effects]


def test_visibility_is_drawn_evenly_in_later_draws_only() -> None:
    assert LATER % len(CYCLE) == 0
    assert all(e.sigma_b is None for spec in effects_of(FROM, 48) for e in spec.effects)
    drawn = np.array([e.sigma_b for spec in effects_of(LATER, 2400) for e in spec.effects])
    assert drawn.size > 900
    low, high = SIGMAS_B
    counts, _ = np.histogram(drawn, bins=7, range=(low, high))
    assert counts.sum() == drawn.size
    assert counts == pytest.approx(np.full(7, drawn.size / 7), rel=0.25)


def test_a_case_has_the_severity_that_was_found_or_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    spec = effects_of(LATER, 24)[0]
    monkeypatch.setattr(severities, "FOLDER", tmp_path)
    severities.known.cache_clear()
    with pytest.raises(ValueError, match=f"{spec.id}.*severities_w2.json"):
        severities.settled(spec)
    severities.known.cache_clear()
    found = {"severity": [0.37] * len(spec.effects)}
    monkeypatch.setattr(severities, "known", lambda world: {spec.id: found})
    (effect,) = {e.severity for e in severities.settled(spec).effects}
    assert effect == 0.37
    assert all(e.sigma is None for e in severities.settled(spec).effects)


def test_a_severity_makes_an_effect_as_visible_as_wanted(monkeypatch: pytest.MonkeyPatch) -> None:
    """What fault-free vehicles differ by in the effect's own number counts, too."""
    class Linear:
        def __init__(self, spec: CaseSpec, nulls: Nulls) -> None:
            pass

        def sigma_b(self, effect: object, severity: float) -> float:
            return 40.0 * severity

    monkeypatch.setattr(settle, "Seen", Linear)
    monkeypatch.setattr(settle, "individual", lambda strength, car: 30.0 * strength["value"])
    spec = next(s for s in effects_of(LATER, 480) if s.effects[0].name == "steering_lag")
    spec = replace(spec, effects=(replace(spec.effects[0], sigma_b=12.0),))
    found = settle.severities(spec, Nulls("w2", Path("nowhere"), 1))
    seen, spreads = found["sigma_b"][0], found["individual"][0]
    assert (1.0 / seen**2 + 1.0 / spreads**2) ** -0.5 == pytest.approx(12.0, rel=0.16)

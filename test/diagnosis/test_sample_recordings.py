"""Recordings of another simulator: where nothing is missing nothing is named, a weak brake is."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from truck_blowout_sim.diagnosis import Diagnosis, diagnose
from truck_blowout_sim.recordings import read_recording

SPLITS: tuple[tuple[list[str], list[str], list[str]], ...] = (  # training, baseline, holdout
    (["blowout"], ["lane_change", "coast_down"], []),
    (["blowout"], ["coast_down"], []),
    (["lane_change"], ["coast_down"], ["blowout"]),
    (["coast_down"], ["lane_change"], []),
)


def asked(folder: Path, train: Sequence[str], baseline: Sequence[str], holdout: Sequence[str]
          ) -> Diagnosis:
    runs = ([read_recording(folder / f"{name}.csv") for name in names]
            for names in (train, baseline, holdout))
    first, second, third = runs
    return diagnose(first, baseline=second, holdout=third)[0]


@pytest.mark.parametrize(("train", "baseline", "holdout"), SPLITS,
                         ids=["-".join((*a, "by", *b)) for a, b, _ in SPLITS])
def test_nothing_is_named_where_nothing_is_missing(
    shared_recordings: Path, train: list[str], baseline: list[str], holdout: list[str]
) -> None:
    told = asked(shared_recordings / "proving_ground" / "nominal", train, baseline, holdout)
    assert told.verdict in ("consistent", "miscalibrated")
    assert told.effects == ()


def test_the_weak_brake_is_named_and_nothing_else(shared_recordings: Path) -> None:
    told = asked(shared_recordings / "proving_ground" / "concealed_sample",
                 ["train_1", "train_2"], ["baseline_1", "baseline_2"], ["holdout_1", "holdout_2"])
    assert told.verdict == "missing_physics"
    effect, = told.effects
    assert (effect.name, effect.where.hub) == ("brake_imbalance", "trailer_2_left")
    # each channel counts alike: squares alone would be those of one pressure gauge
    change = [np.log(told.holdout.after[name] / value)
              for name, value in told.holdout.before.items()]
    assert np.mean(change) < 0.0

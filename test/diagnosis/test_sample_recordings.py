"""Recordings of another simulator: where nothing is missing nothing is named, a weak brake is."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from truck_blowout_sim.diagnosis import Diagnosis, diagnose
from truck_blowout_sim.recordings import read_recording
from truck_blowout_sim.vehicle import Vehicle, load_vehicle

TEN_LINES = """\
title: the sample's truck in ten lines
single_track:
  kind: truck
  mass_kg: {value: 8198, spread: 80, source: weighbridge}
  wheelbase_m: 5.994
  cg_x_m: 2.42
  yaw_inertia_kgm2: 55000
  steering_ratio: 22
  tire: 275/80R22.5
  rear_axles: 2
  hitch_x_m: 5.5
  trailer: {mass_kg: 15388, wheelbase_m: 11.2265, cg_x_m: 6.64}
"""
SPLITS: tuple[tuple[list[str], list[str], list[str]], ...] = (  # training, baseline, holdout
    (["blowout"], ["lane_change", "coast_down"], []),
    (["blowout"], ["coast_down"], []),
    (["lane_change"], ["coast_down"], ["blowout"]),
    (["coast_down"], ["lane_change"], []),
)


def asked(folder: Path, train: Sequence[str], baseline: Sequence[str], holdout: Sequence[str],
          vehicle: Vehicle | str = "international_9400i_trailmobile") -> Diagnosis:
    runs = ([read_recording(folder / f"{name}.csv") for name in names]
            for names in (train, baseline, holdout))
    first, second, third = runs
    return diagnose(first, baseline=second, holdout=third, vehicle=vehicle)[0]


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


def test_the_weak_brake_is_named_by_a_truck_of_ten_lines(shared_recordings: Path, tmp_path: Path
                                                         ) -> None:
    """The rules of thumb behind it are off by more than the sheet; the brake stands out of them."""
    (tmp_path / "my_truck.yaml").write_text(TEN_LINES)
    told = asked(shared_recordings / "proving_ground" / "concealed_sample",
                 ["train_1", "train_2"], ["baseline_1", "baseline_2"], ["holdout_1", "holdout_2"],
                 load_vehicle(str(tmp_path / "my_truck.yaml")))
    assert told.verdict == "missing_physics"
    assert [(e.name, e.where.hub) for e in told.effects] == [("brake_imbalance", "trailer_2_left")]

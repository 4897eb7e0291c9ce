"""A short drive of the default truck, with something changed in it, for every test to share.

Seven seconds: straight, a lane change, then braking. The model itself is the truth here, so that
what is tested is the method and not the likeness of two models.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from unittest.mock import patch

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case import calibration
from truck_blowout_sim.diagnosis.case.runs import prepare_run
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.settings import Settings, load_settings
from truck_blowout_sim.recordings import INPUT_NAMES, Recording, Series
from truck_blowout_sim.simulation.drive import Drive, execute
from truck_blowout_sim.simulation.equilibrium import InitialState
from truck_blowout_sim.simulation.replay import as_recording
from truck_blowout_sim.vehicle import Packed, load_vehicle, pack

STEP_S, LENGTH_S = 0.0025, 7.0
NOISE = {
    "_vx_mps": 0.01, "_vy_mps": 0.01, "_yaw_rate_radps": 3e-4, "_ax_mps2": 0.03, "_ay_mps2": 0.03,
    "_roll_rad": 3e-4, "_radps": 0.05,
}  # fmt: skip
FEW = {
    "tractor_mass", "trailer_mass", "trailer_cg_forward", "steered_cornering", "driven_cornering",
    "towed_cornering", "steering_zero", "steering_stiffness", "rolling_resistance",
    "towed_roll_steer", "towed_toe", "brake_gain_trailer_2_left", "brake_gain_trailer_2_right",
}  # fmt: skip

Changes = Mapping[str, float]
Drives = Callable[..., Recording]
Studies = Callable[..., Study]


@pytest.fixture(scope="session")
def truck() -> Packed:
    """The default vehicle."""
    return pack(load_vehicle("international_9400i_trailmobile"))


@pytest.fixture(scope="session")
def ten_line_car(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A vehicle file of a car in the fewest lines; rules of thumb fill in the rest."""
    path = tmp_path_factory.mktemp("vehicles") / "car.yaml"
    path.write_text("title: car\nsingle_track: {kind: car, mass_kg: 1500, wheelbase_m: 2.7,"
                    " cg_x_m: 1.25, steering_ratio: 16, tire: 205/55R16}\n")
    return path


@pytest.fixture(scope="session")
def few(truck: Packed) -> Settings:
    """The default assumptions with a dozen sheet numbers instead of all: a case in a second."""
    full = load_settings(truck)
    return replace(full, nuisances=tuple(n for n in full.nuisances if n.name in FEW))


@pytest.fixture(scope="session")
def drive_it(truck: Packed) -> Drives:
    """Record a drive of the truck with changed parameters; ``seed`` is that of the noise."""

    def record(changes: Changes | None = None, *, seed: int = 1, steer: float = 1.0,
               name: str = "") -> Recording:
        return _recorded(truck, tuple(sorted((changes or {}).items())), seed, steer,
                         name or f"run {seed}")

    return record


@pytest.fixture(scope="session")
def drive_of() -> Drives:
    """The same of any vehicle: truck, changes, seed, hand wheel, name, brake pressure."""
    return _recorded


@pytest.fixture(scope="session")
def study_of(truck: Packed, few: Settings, drive_it: Drives) -> Studies:
    """A calibrated case of changed trucks; each caller gets lists of his own."""

    @cache
    def build(train: tuple[tuple[str, float], ...], holdout: tuple[tuple[str, float], ...] | None,
              baseline: tuple[tuple[str, float], ...] | None) -> Study:
        runs = [prepare_run(drive_it(dict(train), seed=1), "train", truck, few, step_s=STEP_S)]
        if baseline is not None:
            runs.insert(0, prepare_run(drive_it(dict(baseline), seed=5), "baseline", truck, few,
                                       step_s=STEP_S))
        held = () if holdout is None else (prepare_run(
            drive_it(dict(holdout), seed=3, steer=-0.9), "holdout", truck, few, step_s=STEP_S),)
        return _calibrated(Study(tuple(runs), held, truck, few))

    def make(train: Changes | None = None, *, holdout: Changes | None = None,
             baseline: bool | Changes = False) -> Study:
        usual: Changes = {} if isinstance(baseline, bool) else baseline
        one = build(tuple(sorted((train or {}).items())),
                    None if holdout is None else tuple(sorted(holdout.items())),
                    None if baseline is False else tuple(sorted(usual.items())))
        return replace(one, models=list(one.models), holdout_models=list(one.holdout_models),
                       _projectors={})

    return make


@pytest.fixture(scope="session")
def case_of(truck: Packed, few: Settings) -> Studies:
    """A calibrated case of the default truck, of training runs alone."""

    def make(*recordings: Recording) -> Study:
        return _calibrated(Study(tuple(prepare_run(one, "train", truck, few, step_s=STEP_S)
                                       for one in recordings), (), truck, few))

    return make


def _calibrated(study: Study) -> Study:
    """Its trucks differ by numbers that these small cases leave closed.

    The widths would take that for restlessness; they have tests of their own.
    """
    with patch.object(calibration, "whiten", lambda _: None):
        calibration.calibrate(study)
    return study


def _recorded(truck: Packed, changes: Sequence[tuple[str, float]], seed: int, steer: float,
              name: str, brake_pa: float = 1.5e5) -> Recording:
    """Any vehicle with changed parameters: straight, a lane change, then braking."""
    t = STEP_S * np.arange(round(LENGTH_S / STEP_S))
    inputs = np.zeros((t.size, len(INPUT_NAMES)))
    inputs[:, 0] = steer * np.where(t > 1.0, np.sin(2.0 * np.pi * 0.4 * (t - 1.0)), 0.0)
    inputs[:, 1] = 0.1 * (t < 4.5)
    inputs[:, 2:] = (brake_pa * np.clip(2.0 * (t - 4.8), 0.0, 1.0))[:, None]
    none = np.zeros(0, dtype=np.int64)
    drive = Drive(InitialState(speed_mps=20.0), STEP_S, 4, inputs, np.zeros(0), none, none)
    changed = truck.with_values(dict(changes))
    exact = as_recording(name, changed, drive, execute(changed, drive), ())
    rng = np.random.default_rng(seed)
    channels = {key: exact[key] for key in INPUT_NAMES}
    for key, series in exact.channels.items():
        sigma = next((s for end, s in NOISE.items() if key.endswith(end)), None)
        if sigma is not None and key.startswith(("tractor", "trailer", "hub_speed")):
            noise = sigma * rng.standard_normal(series.value.size)
            channels[key] = Series(series.time_s, series.value + noise)
    return Recording(name, channels)

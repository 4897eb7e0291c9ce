"""The worlds: a truck of another form is a truck still, a rough log is rough as it says."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import yaml

from proving_ground.build import CaseBuilder
from proving_ground.channels import COMMANDS
from proving_ground.forms import draw, draw_laws
from proving_ground.laws import BRUSH, MAGIC, TMEASY, usual
from proving_ground.roughness import FEW, Roughness, roughen
from proving_ground.tire import cornering_slope, steady_forces
from proving_ground.worlds import CYCLE, WORLDS, world_cases

CLEAN = Roughness(noise=1e-9, memory_s=0.2, frame_hz=3.0, frame=0.0, wheel=0.0, engine_hz=15.0,
                  engine=0.0, drift=0.0, rounding=1.0, dropped=0.0, clock=0.0, clock_of="",
                  every=1, few=False)




def test_every_family_is_drawn_and_corners_as_the_sheet_says() -> None:
    laws = [draw_laws(np.random.default_rng([seed, 97])) for seed in range(60)]
    assert {one.family for one in laws} == {TMEASY, MAGIC, BRUSH}
    for one in laws:
        assert cornering_slope(26.5e3, 1.0, one) == pytest.approx(170.8e3, rel=0.08)
        small = 1.0e-4
        _, force, _ = steady_forces(26.5e3, 0.0, small, 170.8e3, 1.0, 1.0, one)
        assert force / small == pytest.approx(170.8e3, rel=0.01)
        for sx in (-0.3, 0.0, 0.2):
            for sy in (-0.4, 0.1, 0.8):
                fx, fy, _ = steady_forces(26.5e3, sx, sy, 170.8e3, 0.7, 1.0, one)
                assert np.hypot(fx, fy) <= 0.7 * 26.5e3


def test_no_number_of_a_drawn_tire_is_the_products() -> None:
    """Digit for digit: slip slopes, peaks, rim stiffness, reference load."""
    folder = Path(__file__).resolve().parents[2] / "config/tires"
    own = {str(value["value"]) for path in folder.glob("*.yaml")
           for value in _values(yaml.safe_load(path.read_text()))}
    drawn, keys = draw_laws(np.random.default_rng(3)), usual()._fields
    reals = {key for key in keys if isinstance(getattr(usual(), key), float)}
    kept = {"relaxation_shrinks", "blow_off_mps", "blow_off_share"}  # no numbers of a tire
    assert not {f"{getattr(drawn, key)}" for key in reals - kept} & own


def _values(node: object) -> list[dict[str, object]]:
    if isinstance(node, dict):
        inner = [row for value in node.values() for row in _values(value)]
        return [node, *inner] if "value" in node else inner
    return []


def test_a_wrong_sheet_changes_the_truck_and_nothing_else() -> None:
    right, wrong = draw(7, wrong=False), draw(7)
    assert right.laws == wrong.laws
    assert right.sheet != wrong.sheet or not np.allclose(
        np.r_[right.cornering_scale, right.brake_scale],
        np.r_[wrong.cornering_scale, wrong.brake_scale])


@pytest.mark.parametrize("world", WORLDS)
def test_a_cycle_of_a_world_holds_every_group(world: str) -> None:
    cases = world_cases(world, 48, len(CYCLE))
    assert Counter(case.group for case in cases) == {
        "null": 10, "single": 9, "pair": 1, "sensor": 2, "unknown": 2}
    assert cases[5] == world_cases(world, 53, 1)[0]


def test_worlds_share_no_seed() -> None:
    seeds = [case.seed for world in WORLDS for case in world_cases(world, 0, 480)]
    assert len(set(seeds)) == len(seeds)


def test_severities_are_continuous_and_reach_the_end() -> None:
    cases = world_cases("w2", 0, 960)
    effects = [effect for case in cases for effect in case.effects]
    assert len({effect.sigma for effect in effects}) > 200
    dead = [e for e in effects if e.name == "brake_imbalance" and e.sigma is None]
    assert dead
    assert all(e.at(e.severity, 0.0).strength.value < 0.1 for e in dead)


def readings(count: int = 20_000) -> dict[str, np.ndarray]:
    names = [*COMMANDS, "tractor_vx_mps", "tractor_yaw_rate_radps", "tractor_ay_mps2",
             "trailer_yaw_rate_radps"]
    return {name: np.full(count, 20.0 if name.endswith("vx_mps") else 0.0) for name in names}


def test_rough_noise_remembers_as_long_as_it_says() -> None:
    rough = replace(CLEAN, noise=5.0, memory_s=0.5)
    _, out = roughen(readings(), rough, 11)
    noise = out["tractor_ay_mps2"]
    assert 0.6 * 5.0 * 0.03 * 0.8 < noise.std() < 1.4 * 5.0 * 0.031 * 1.2
    lagged = np.corrcoef(noise[:-50], noise[50:])[0, 1]
    assert lagged == pytest.approx(np.exp(-1.0), abs=0.1)


def test_rough_logs_keep_commands_and_lose_what_they_say() -> None:
    rough = replace(CLEAN, few=True, every=10, dropped=0.03)
    time, out = roughen(readings(), rough, 12)
    assert set(out) == set(FEW)
    assert time[1] - time[0] == pytest.approx(0.1)
    assert not np.isnan(out["steering_wheel_angle_rad"]).any()
    assert 0.01 < np.isnan(out["tractor_ay_mps2"]).mean() < 0.05


def test_a_drawn_truck_drives(tmp_path: Path) -> None:
    case = replace(world_cases("w4", 1, 1)[0], train=("straight",), holdout=("straight",),
                   baseline=(), effects=())
    answer = CaseBuilder(replace(case, group="null")).build(tmp_path)
    assert answer["rough"]["noise"] >= 1.0
    assert (tmp_path / "train_1.csv").stat().st_size > 10_000

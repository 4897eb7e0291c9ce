"""Which effects are considered; what pressures tell: which tire failed by itself, and when."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.name.candidates import (
    considered,
    failed_tires,
    known_names,
    steady_candidates,
    timed_effects,
)
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Blowout, Recording, Series
from truck_blowout_sim.vehicle import Packed

TIME_S = np.arange(0.0, 8.0, 0.01)


def pressures(began_s: float, lasts_s: float, tire: str, seed: int = 1) -> Recording:
    """A tire that empties exponentially from an instant on, beside a sound one; noise 0.5 %."""
    rng = np.random.default_rng([seed, 101])
    falling = np.exp(-np.maximum(TIME_S - began_s, 0.0) / lasts_s)
    return Recording("run", {
        f"tire_pressure_{name}_pa": Series(
            TIME_S, 7.0e5 * share * (1.0 + 0.005 * rng.standard_normal(TIME_S.size)))
        for name, share in ((tire, falling), ("trailer_1_left_outer", np.ones(TIME_S.size)))})


def gauges(truck: Packed, *recordings: Recording, without: tuple[str, ...] = ()) -> Study:
    runs = tuple(SimpleNamespace(recording=recording) for recording in recordings)
    return cast(Study, SimpleNamespace(runs=runs, packed=truck,
                                       settings=SimpleNamespace(without=without)))


@pytest.mark.parametrize("lasts_s", [0.3, 1.0, 4.0])
def test_the_gauge_tells_when_a_tire_began_to_lose_its_air(truck: Packed, lasts_s: float) -> None:
    found = failed_tires(gauges(truck, pressures(2.5, lasts_s, "steer_right")), [0])
    assert list(found) == ["steer_right"]
    assert found["steer_right"]["run"] == pytest.approx(2.5, abs=0.02 + 0.02 * lasts_s)


def test_a_gauge_that_reads_once_a_second_tells_a_tire_that_is_flat_for_most_of_the_run(
    truck: Packed
) -> None:
    time_s = np.arange(15.0)
    pressure_pa = np.array([748, 752, 752, 752, 352, 136, 28] + [0] * 8) * 1e3
    run = Recording("run", {"tire_pressure_steer_left_pa": Series(time_s, pressure_pa)})
    found = failed_tires(gauges(truck, run), [0])
    assert 2.9 <= found["steer_left"]["run"] <= 4.0


def test_a_tire_blown_on_command_has_not_failed_by_itself(truck: Packed) -> None:
    run = pressures(2.5, 0.3, "steer_right")
    told = Recording("run", run.channels, (Blowout(2.5, ("steer_right",)),))
    assert failed_tires(gauges(truck, told), [0]) == {}


def test_what_is_known_not_to_be_the_cause_is_not_considered(
    truck: Packed, study_of: Callable[..., Study]
) -> None:
    whole = study_of(baseline=True)
    out = ("crosswind", "roll_steer")
    less = replace(whole, settings=replace(whole.settings, without=out))
    assert {e.name for e in considered(whole)} - {e.name for e in considered(less)} == set(out)
    assert {h.effect.name for h in steady_candidates(less)}.isdisjoint(out)
    assert {e.name for e in timed_effects(less)}.isdisjoint(out)
    assert "crosswind" in {e.name for e in timed_effects(whole)}


def test_a_tire_that_is_known_to_hold_its_air_has_not_failed(truck: Packed) -> None:
    study = gauges(truck, pressures(2.5, 0.3, "steer_right"), without=("secondary_blowout",))
    assert failed_tires(study, [0]) == {}


def test_a_name_of_no_effect_is_refused() -> None:
    assert known_names(("road_bank", "crosswind", "road_bank")) == ("crosswind", "road_bank")
    with pytest.raises(InputError, match="cross_wind"):
        known_names(("cross_wind",))


def test_a_gyro_gain_is_asked_of_the_model_only_without_a_heading(
    study_of: Callable[..., Study]
) -> None:
    study = study_of({})

    def names(runs: tuple[Run, ...]) -> set[str]:
        return {h.effect.name for h in steady_candidates(replace(study, runs=runs))}

    headed = tuple(replace(run, recording=run.recording.with_channels(
        {f"{unit}_yaw_rad": run.recording[f"{unit}_yaw_rate_radps"]
         for unit in ("tractor", "trailer")})) for run in study.runs)
    assert names(study.runs) - names(headed) == {"yaw_rate_scale"}

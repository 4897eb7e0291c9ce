"""What the benchmarks of real cars write, and the faults that they put in."""

from __future__ import annotations

from typing import Any

import numpy as np

from benchmarks.cars.driven import SIDEWAYS, YAW_RATE, driven_table, found_table
from benchmarks.cars.faults import AX, AY, FAULTS, said
from truck_blowout_sim import Recording, Series
from truck_blowout_sim.diagnosis.result import AliasSet, Diagnosis, Effect, Parameter, Place


def comparison(yaw_rate_radps: float, sideways_mps: float) -> dict[str, Any]:
    return {"channels": {YAW_RATE: {"rms": yaw_rate_radps}, SIDEWAYS: {"rms": sideways_mps}}}


def test_errors_of_both_vehicles_stand_side_by_side() -> None:
    table = driven_table({"never seen": comparison(0.04, 0.5)},
                         {"never seen": comparison(0.03, 0.25)})
    assert table.lines[2:] == ["| yaw rate [deg/s], half never seen | 2.29 | 1.72 | 25 % |",
                               "| side velocity [m/s], half never seen | 0.50 | 0.25 | 50 % |"]


def test_what_was_found_is_told_with_its_equation() -> None:
    effect = {"name": "tire_saturation", "sentence": "Grip levels off.", "equation": "F = s"}
    table = found_table({"verdict": "missing_physics", "effects": [effect],
                         "summary": {"sure": "1 in 100."}})
    assert "| `tire_saturation` | Grip levels off. `F = s` |" in table.lines
    assert table.lines[-1] == "| how sure | 1 in 100. |"


def test_faults_change_what_they_say() -> None:
    t = np.arange(0.0, 2.0, 0.01)
    run = Recording("run", {YAW_RATE: Series(t, np.sin(t)), AX: Series(t, t),
                            AY: Series(t, -t)})
    late = FAULTS["yaw rate 0.2 s late"](run)[YAW_RATE].at([1.0])
    assert np.allclose(late, np.sin(0.8), atol=1e-4)
    assert np.allclose(FAULTS["yaw rate times 1.08"](run)[YAW_RATE].at([1.0]), 1.08 * np.sin(1.0))
    assert FAULTS["accelerations exchanged"](run)[AX] == run[AY]
    assert FAULTS["none"](run) is run


def test_what_was_named_before_is_left_out() -> None:
    def answer(*names: str) -> Diagnosis:
        effects = tuple(Effect(name=name, kind="sensor", where=Place(body="tractor"), equation="",
                               sentence="", parameters={"delay": Parameter(0.2, "s", (0.1, 0.3))})
                        for name in names)
        return Diagnosis("sensor_artefact", "", effects, tuple(AliasSet((name,)) for name in names))

    first = answer("yaw_rate_bias")
    assert said(first) == "yaw_rate_bias tractor: 0.2 s (90 %: 0.1 to 0.3)"
    assert said(answer("yaw_rate_bias", "channel_delay"), first) == (
        "channel_delay tractor: 0.2 s (90 %: 0.1 to 0.3)")
    assert said(first, first) == "nothing"

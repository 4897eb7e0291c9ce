"""A made-up diagnosis that has everything a page can show."""

from __future__ import annotations

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.result import (
    AliasSet,
    Calibrated,
    Candidate,
    ChannelSigma,
    ChannelTimeMap,
    Diagnosis,
    Effect,
    Evidence,
    Fit,
    ForceHistory,
    Location,
    Overlay,
    Parameter,
    Place,
    Wrench,
)
from truck_blowout_sim.vehicle import Vehicle, load_vehicle

TIME = np.linspace(0.0, 14.0, 701)
CHANNELS = (
    "trailer_yaw_rate_radps", "tractor_yaw_rate_radps", "hub_speed_trailer_2_left_radps",
    "hub_speed_trailer_2_right_radps", "tractor_vx_mps", "trailer_vy_mps", "trailer_ay_mps2",
    "tractor_ay_mps2", "trailer_roll_rad", "brake_chamber_trailer_2_left_pa",
)  # fmt: skip
WEAK = Place("trailer", "trailer_2", "trailer_2_left")


@pytest.fixture(scope="session")
def vehicle() -> Vehicle:
    return load_vehicle("international_9400i_trailmobile")


def brake(time_s: np.ndarray) -> np.ndarray:
    return np.clip((time_s - 6.0) / 0.8, 0.0, 1.0)


def mismatch(recording: str, role: str) -> ChannelTimeMap:
    random = np.random.default_rng(len(recording))
    edges = np.arange(0.0, 14.5, 0.5)
    strength = np.array([30.0, 12, 60, -4, -3, 8, 5, 2, 1, 0])
    before = random.normal(size=(10, 28)) + strength[:, None] * brake(edges[:-1])
    before[9, :12] = np.nan
    return ChannelTimeMap(recording, role, edges, CHANNELS, before,  # type: ignore[arg-type]
                          random.normal(size=(10, 28)))  # fmt: skip


def overlay(recording: str, role: str, channel: str, size: float) -> Overlay:
    random = np.random.default_rng(len(channel))
    measured = size * np.sin(TIME) * brake(TIME) + random.normal(scale=0.03 * size, size=TIME.size)
    return Overlay(recording, role, channel, TIME, measured,  # type: ignore[arg-type]
                   0.3 * size * np.sin(TIME) * brake(TIME), size * np.sin(TIME) * brake(TIME),
                   0.03 * size)  # fmt: skip


def candidates() -> tuple[Candidate, ...]:
    return (
        Candidate("brake_imbalance", WEAK, 15230.0, 1e-4, True, True, "", "0.36"),
        Candidate("brake_fade", Place("trailer", "trailer_2"), 15110.0, 1e-4, False, True,
                  "needs 480 °C after 2 s", "0.34"),
        Candidate("blown_tire_drag", Place("trailer", "trailer_1", None), 4210.0, 0.02,
                  False, False, "prediction of holdout runs becomes worse", "-3.1 kN"),
        Candidate("crosswind", Place("trailer"), 3900.0, 0.04, False, False,
                  "interval includes zero", "4 m/s"),
        Candidate("road_bank", Place(), 350.0, 0.4, False, False, "p above the limit"),
    )  # fmt: skip


@pytest.fixture(scope="session")
def diagnosis() -> Diagnosis:
    effect = Effect(
        "brake_imbalance", "physics", WEAK,
        {"gain": Parameter(0.356, "1", (0.331, 0.382)),
         "push_out": Parameter(3.4e4, "Pa", (2.0e4, float("inf")))},
        "T(trailer_2_left) = 0.356 · T_sheet(p)",
        "The brake of trailer_2_left gives 36 % (33 to 38 %) of the sheet's torque whenever the"
        " trailer brakes.",
    )  # fmt: skip
    zeros = np.zeros(TIME.size)
    force = ForceHistory("train_1", "trailer", TIME, 2.1e3 * brake(TIME), 120 * np.sin(TIME),
                         -2.9e3 * brake(TIME), zeros + 180, zeros + 90, zeros + 260)  # fmt: skip
    before = dict(zip(CHANNELS, (21.0, 9.0, 43.0, 3.1, 2.8, 5.0, 3.3, 1.7, 1.2, 1.0), strict=True))
    after = {name: 1.0 + 0.01 * value for name, value in before.items()}
    evidence = Evidence(
        vehicle="international_9400i_trailmobile",
        recordings=(("train_1", "train"), ("train_2", "train"), ("holdout_1", "holdout"),
                    ("baseline_1", "baseline")),
        candidates=candidates(),
        maps=(mismatch("train_1", "train"), mismatch("holdout_1", "holdout")),
        overlays=tuple(overlay(r, role, c, s) for r, role in
                       (("train_1", "train"), ("holdout_1", "holdout"))
                       for c, s in zip(CHANNELS[:4], (0.05, 0.03, 4.0, 2.0), strict=True)),
        forces=(force,),
        calibrated=(Calibrated("trailer mass", "kg", 17000.0, 340.0, 17210.0, 60.0),
                    Calibrated("drag area", "m2", 5.6, 0.28, 5.5, 0.1),
                    Calibrated("steering zero", "rad", 0.0, 9e-4, 3.6e-3, 1e-4)),
        equations=("T(trailer_2_left) = 0.356 · T_sheet(p)",),
        assumptions=("The road is level and dry <everywhere>.", "Noise is as stated."),
        missing_channels=(("brake_chamber_trailer_2_left_pa", "brake_lag from brake_imbalance"),),
        notes=("train_2 has a gap of 0.4 s at 3.1 s.",),
        facts=(("Simulations", "412"), ("Run time", "74 s")),
    )  # fmt: skip
    location = Location(
        tuple(ChannelSigma(name, before[name]) for name in CHANNELS[:3]), (6.2, 14.0), "trailer",
        -5.9, (-6.8, -5.1), Wrench(2100.0, -40.0, -2900.0),
    )  # fmt: skip
    return Diagnosis(
        "missing_physics",
        "The trailer's rear left brake (trailer_2_left) gives about 36 % of its torque;"
        " nothing else explains the recordings as well, except fading of the same brake.",
        (effect,),
        (AliasSet(("brake_imbalance", "brake_fade"), ("", "trailer_2"),
                  "A second stop with cold brakes would tell them apart."),),
        location,
        Fit(before, after),
        Fit({n: v * 0.9 for n, v in before.items()}, after),
        0.0001,
        "Brake the trailer from 60 mph twice, cold, with all chamber pressures recorded.",
        evidence,
    )  # fmt: skip

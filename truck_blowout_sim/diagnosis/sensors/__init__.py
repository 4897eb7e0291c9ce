"""Stages 1 and 2 of the diagnosis: noise of the channels, and the sensor gate."""

from __future__ import annotations

from truck_blowout_sim.diagnosis.sensors.correction import correct
from truck_blowout_sim.diagnosis.sensors.findings import (
    Amount,
    GateResult,
    IdentityResidual,
    SensorFinding,
    SteeringZero,
)
from truck_blowout_sim.diagnosis.sensors.gate import sensor_gate
from truck_blowout_sim.diagnosis.sensors.geometry import (
    Geometry,
    stated_geometry,
    vehicle_geometry,
)
from truck_blowout_sim.diagnosis.sensors.noise import (
    Noise,
    believable,
    channel_noise,
    seen_quanta,
    series_noise,
    slow_noise,
    told_noise,
)

__all__ = [
    "Amount",
    "GateResult",
    "Geometry",
    "IdentityResidual",
    "Noise",
    "SensorFinding",
    "SteeringZero",
    "believable",
    "channel_noise",
    "correct",
    "seen_quanta",
    "sensor_gate",
    "series_noise",
    "slow_noise",
    "stated_geometry",
    "told_noise",
    "vehicle_geometry",
]

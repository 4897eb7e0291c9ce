"""How long an event may have been there before it shows.

A leak that no gauge reads shows once the tire's forces change. Two forms are published: with the
pressure from the first moment on, and only when the carcass touches the rim. They are taken to be
two sigmas apart, for one and the same change of the forces.

Less grip shows once the vehicle asks for more than is left. Up to the last moment at which the
recording asks for more than 95 % sure is left, the grip was still there; from then on it may have
been gone.

References: thesis L659-L733 (forces fall with the pressure); Goodyear's measurements of a truck
tire at four pressures (cornering stiffness holds down to 40 psi).
Known limits: asked for is the yaw rate times the speed, and how fast the speed changes; without
these channels the vehicle may have asked for nothing. The twin of a leaking tire takes its load,
which is left out.
Validated with: test/diagnosis/test_hidden.py.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.algebra.quantiles import NINETY
from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.case.trust import asked_for_mps2, grip_mps2
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.ranked import Ranked
from truck_blowout_sim.physics.tires.gas import pressure_rate_paps
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
_FLAT = 0.01  # of the pressure: the last of it hardly flows
_STEPS = 400


def leak_shift_s(run: Run, event: Hypothesis, packed: Packed) -> tuple[float, float]:
    """Mean and 1 sigma of a leak's onset after the found one; nothing where a gauge reads it.

    The model's forces change from `pressure_valid` on. Had they done so from the first moment on,
    the leak began when they do; had they held until the rim, they take the same time from there.
    """
    tire = event.place.tire
    if event.effect.hides != "leak" or tire is None \
            or f"tire_pressure_{tire}_pa" in run.recording:
        return 0.0, 0.0
    gauge, times = emptying(packed, tire, event.amount)
    model = packed[f"tire.{tire}.pressure_valid"] * packed[f"tire.{tire}.reference_pressure_pa"]
    shows, rim = (float(np.interp(-pressure, -gauge, times))
                  for pressure in (model, rim_pressure_pa(packed, tire)))
    left = float(times[-1]) - rim  # none where the carcass carries the load without air
    before_rim = (times[-1] - shows) * rim / left if left > 0.0 else float(times[-1])
    return float(shows - 0.5 * before_rim), float(0.5 * before_rim)


def emptying(packed: Packed, tire: str, hole_scale: float) -> tuple[Floats, Floats]:
    """Gauge pressures [Pa] of a leaking tire from full to flat, and when each is reached [s]."""
    full, ambient = packed[f"tire.{tire}.pressure_pa"], packed["world.air_pressure_pa"]
    gauge = np.geomspace(1.0, _FLAT, _STEPS) * full
    hole = packed[f"tire.{tire}.hole_area_m2"] * packed[f"tire.{tire}.hole_scale"] * hole_scale
    slow = np.array([-1.0 / pressure_rate_paps(
        one + ambient, full + ambient, ambient, packed["world.air_temperature_k"],
        packed[f"tire.{tire}.volume_m3"], hole, packed[f"tire.{tire}.polytropic"])
        for one in gauge.tolist()])
    steps = 0.5 * (slow[1:] + slow[:-1]) * (gauge[:-1] - gauge[1:])
    return gauge, np.concatenate([[0.0], np.cumsum(steps)])


def rim_pressure_pa(packed: Packed, tire: str) -> float:
    """Gauge pressure at which the carcass touches the rim under the reference load."""
    def value(name: str) -> float:
        return packed[f"tire.{tire}.{name}"]

    way = value("unloaded_radius_m") - value("rim_contact_radius_m")
    stiff = value("reference_load_n") / way - value("stiffness_npm")
    highest = value("pressure_valid") * value("reference_pressure_pa")
    return float(np.clip(stiff / value("stiffness_npmppa"), _FLAT * highest, highest))


def earliest_s(study: Study, run: Run, found: Ranked, low_s: float) -> float:
    """Lower end of an onset's interval: as early as an event may have begun without showing.

    ``low_s``: the lower end by what shows. What hides and began before the run is in force from
    the run's beginning.
    """
    event, begin = found.hypothesis, run.drive.initial.time_s
    if event.effect.hides == "grip":
        form = study.settings.form(event.effect.name) * event.amount
        most = event.amount + NINETY * float(np.hypot(found.sigma, form))
        left = event.effect.amount.report(most) * grip_mps2(study.packed)
        before = run.edges_s[1:] <= event.times[run.recording.name][0]
        needed = run.edges_s[1:][before & (asked_for_mps2(study, run) > left)]
        low_s = min(float(needed[-1]) if needed.size else begin, low_s)
    return low_s if event.effect.hides == "nothing" or np.isinf(low_s) else max(low_s, begin)

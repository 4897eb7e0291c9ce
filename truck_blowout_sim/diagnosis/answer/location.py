"""Where the mismatch shows: channels before anything is named, and where what is left acts.

Validated with: test/diagnosis/test_outcome.py.
"""

from __future__ import annotations

import numpy as np
from scipy.stats import chi2

from truck_blowout_sim.diagnosis.algebra.quantiles import NINETY
from truck_blowout_sim.diagnosis.answer import evidence
from truck_blowout_sim.diagnosis.answer.material import Material
from truck_blowout_sim.diagnosis.answer.verdict import only_unseen
from truck_blowout_sim.diagnosis.result import ChannelSigma, Location, Wrench


def locate(material: Material) -> Location:
    """Channels that differ before anything is named; where what is then left unnamed acts."""
    study = material.study
    before = evidence.pooled(evidence.left_before(study, material.found, "train"))
    channels = tuple(ChannelSigma(n, s) for n, s in sorted(before.items(), key=lambda p: -p[1])
                     if s > 1.5)
    if not material.wrenches or only_unseen(material):
        return Location(channels=channels)
    # along the course both bodies move as one: what turns or beats says which it is, or what was
    # named, by its wheels
    shown: list[str | None] = [
        one.body for one in (material.posture, material.new_beat, material.moving_on) if one]
    bodies = shown or [r.hypothesis.place.body for r in material.found.named[:1]]
    best = max(material.wrenches, key=lambda w: (w.history.body in bodies, w.delta))
    history = best.history
    z = (np.abs(history.fx_n / history.fx_sigma_n) + np.abs(history.fy_n / history.fy_sigma_n)
         + np.abs(history.mz_nm / history.mz_sigma_nm))
    strong = np.flatnonzero(z > 0.5 * z.max()) if z.size else np.zeros(0, dtype=int)
    least = chi2.isf(study.settings.false_alarms, best.degrees)
    if best.delta < least or not strong.size:
        return Location(channels=channels)
    a, b = strong[0], strong[-1] + 1
    wide = NINETY * best.x_sigma_m
    known = np.isfinite(best.x_m)
    return Location(
        channels=channels,
        interval_s=(float(history.time_s[a]) - 0.5 * best.window_s,
                    float(history.time_s[b - 1]) + 0.5 * best.window_s),
        body=history.body, line_of_action_x_m=best.x_m if known else None,
        line_of_action_ci90_m=(best.x_m - wide, best.x_m + wide) if known else None,
        wrench=Wrench(float(history.fx_n[a:b].mean()), float(history.fy_n[a:b].mean()),
                      float(history.mz_nm[a:b].mean())))

"""The plane model of docs/riddle.md: yaw rate after a pull, per degree of hand wheel against it.

Tractor and trailer with linear tires at constant speed. Prints, for each share of its cornering
force that the blown tire keeps, the ratio for a pull by drag and for one by steered road wheels.

References: masses with axles, set B of docs/physics.md; 160 kN/rad a steer tire, drive and trailer
tandems as in a published 7-DOF truck (F17).
Validated with: test/test_plane_model.py.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

SPEED_MPS, RATIO, STEP_S, ONSET_S = 52.4 * 0.44704, 22.0, 0.001, 0.5
TRACTOR_KG, TRACTOR_KGM2, TRAILER_KG, TRAILER_KGM2 = 8198.0, 55000.0, 15388.0, 375500.0
# from the center of gravity: steer axle, drive axles, hitch; kingpin; trailer axles behind its own
STEER_M, DRIVE_M, HITCH_M, KINGPIN_M, TRAILER_M = 2.42, 3.574, 3.08, 6.64, 4.587
STEER_NPRAD, DRIVE_NPRAD, TRAILER_NPRAD = 320e3, 914e3, 659e3
DRAG_N, TRACK_M = 3500.0, 2.05
KEPT = (1.0, 0.4, 0.25, 0.1)


def yaw_rate_dps(kept: float, moment_nm: float = 0.0, steer_rad: float = 0.0,
                 seconds: float = 30.0) -> NDArray[np.float64]:
    """Yaw rate of the tractor [deg/s] each step, the pull rising over half a second.

    Args:
        kept: share of its cornering force that the blown tire keeps.
        moment_nm: pull, as a yaw moment on the tractor; ``steer_rad``: or by the road wheels.
    """
    v = r = r_trailer = turn = 0.0
    rates = []
    left = [[TRACTOR_KG, 0, 0, -1], [0, TRACTOR_KGM2, 0, HITCH_M],
            [TRAILER_KG, -TRAILER_KG * HITCH_M, -TRAILER_KG * KINGPIN_M, 1],
            [0, 0, TRAILER_KGM2, KINGPIN_M]]
    for k in range(round(seconds / STEP_S)):
        s = min(k * STEP_S / ONSET_S, 1.0)
        front = -STEER_NPRAD * (1 - 0.5 * s * (1 - kept)) * (
            (v + STEER_M * r) / SPEED_MPS - steer_rad * s)
        rear = -DRIVE_NPRAD * (v - DRIVE_M * r) / SPEED_MPS
        trailer = -TRAILER_NPRAD * (v - HITCH_M * r - SPEED_MPS * turn
                                    - (KINGPIN_M + TRAILER_M) * r_trailer) / SPEED_MPS
        known = [front + rear - TRACTOR_KG * SPEED_MPS * r,
                 STEER_M * front - DRIVE_M * rear + moment_nm * s,
                 trailer - TRAILER_KG * SPEED_MPS * r, -TRAILER_M * trailer]
        dv, dr, dr_trailer, _ = np.linalg.solve(left, known)
        turn += STEP_S * (r_trailer - r)
        v, r, r_trailer = v + STEP_S * dv, r + STEP_S * dr, r_trailer + STEP_S * dr_trailer
        rates.append(np.degrees(r))
    return np.array(rates)


def ratios(kept: float) -> tuple[float, float]:
    """Yaw rate at one second per degree of the hand wheel that balances it: by drag, by steer."""
    drag = yaw_rate_dps(kept, moment_nm=DRAG_N * TRACK_M / 2)
    steer = yaw_rate_dps(kept, steer_rad=np.radians(1.0))
    at = round(1.0 / STEP_S) - 1
    return drag[at] / (drag[-1] / steer[-1] * RATIO), steer[at] / RATIO


if __name__ == "__main__":
    for share in KEPT:
        print(share, *(f"{value:.3f}" for value in ratios(share)))

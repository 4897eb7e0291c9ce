"""How far published tire laws differ: where the diagnosis has the spread of its amounts from.

Five laws of side force over slip with one initial stiffness and one peak: brush (Pacejka 2012,
ch. 3), Magic Formula (ch. 4), TMeasy (Rill 2012, ch. 3), Burckhardt (1993, dry asphalt), and tanh.
Force is in units of the peak, slip in units of peak over stiffness.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import permutations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import brentq

from truck_blowout_sim.diagnosis.settings import load_settings
from truck_blowout_sim.vehicle import load_vehicle, pack

Floats = NDArray[np.float64]
NAME = "international_9400i_trailmobile"


def brush(slip: Floats) -> Floats:
    bent = np.minimum(slip / 3.0, 1.0)
    return 3.0 * bent - 3.0 * bent**2 + bent**3


def magic_formula(slip: Floats) -> Floats:
    return np.sin(1.3 * np.arctan(slip / 1.3))


def tmeasy(slip: Floats) -> Floats:
    """The peak lies at three times the slip of a straight line."""
    share = np.minimum(slip / 3.0, 1.0)
    return 3.0 * share / (1.0 + share * (share + 1.0))


def burckhardt(slip: Floats) -> Floats:
    grid = np.linspace(0.0, 1.0, 20_001)
    force = 1.2801 * (1.0 - np.exp(-23.99 * grid)) - 0.52 * grid
    stiffness = (1.2801 * 23.99 - 0.52) / force.max()
    return np.interp(slip, grid * stiffness, force / force.max())


LAWS: list[Callable[[Floats], Floats]] = [brush, magic_formula, tmeasy, burckhardt, np.tanh]


def test_two_laws_of_one_stiffness_and_peak_differ_by_the_form_share() -> None:
    slip = np.linspace(0.5, 2.0, 61)  # below, all are straight; above, most slide
    forces = np.stack([law(slip) for law in LAWS])
    spread = np.sqrt(2.0) * forces.std(axis=0, ddof=1) / forces.mean(axis=0)
    for name in ("default", "measured_car", "rebuilt_record"):
        settings = load_settings(pack(load_vehicle(NAME)), name)
        assert settings.form_share == pytest.approx(spread.mean(), abs=0.01)


def test_two_laws_that_give_one_force_differ_in_grip_by_the_share_of_its_change() -> None:
    """At 0.7 of the grip, as the settings say; nearer to the limit, laws differ less."""
    used, ratios = 0.7, []
    for true, believed in permutations(LAWS, 2):
        slip = brentq(lambda s, law=true: float(law(np.array(s))) - used, 0.1, 3.0)
        ratios.append(brentq(lambda grip, law=believed, at=slip:
                             grip * float(law(np.array(at / grip))) - used, 0.3, 9.0))
    share = np.sqrt(np.mean(np.log(ratios)**2))
    settings = load_settings(pack(load_vehicle(NAME)))
    assert settings.form("friction_change") == pytest.approx(share, abs=0.01)

"""The option `--units`, the same for every verb that shows quantities."""

from __future__ import annotations

from typing import Any

import typer

from truck_blowout_sim.comparison.units import SYSTEMS
from truck_blowout_sim.errors import InputError, quoted


def _known(units: str) -> str:
    if units not in SYSTEMS:
        raise InputError(f"--units {quoted(units)}", expected=" or ".join(SYSTEMS))
    return units


UNITS: Any = typer.Option("us", "--units", callback=_known,
                          help="us (mph, ft, psi, lbf) or si (m/s, m, kPa, kN).")

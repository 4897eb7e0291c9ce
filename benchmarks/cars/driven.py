"""The diagnosis of a real car: what it finds, and the fit before and after.

    python -m benchmarks.cars.driven FIRST_HALF SECOND_HALF [-o docs/proof_cars.md]

Both files are the public recordings of Stanford's Ferrari 250LM. One half trains, the other is only
predicted. Then each vehicle file alone is driven with the recorded hand wheel and speed.

Validated with: test/benchmarks/test_cars.py.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from math import degrees
from pathlib import Path
from typing import Any

from benchmarks.page import Page, Place, Table, start_function

NOMINAL = "ferrari_250lm"
YAW_RATE, SIDEWAYS = "tractor_yaw_rate_radps", "tractor_vy_mps"


def found_table(diagnosis: Mapping[str, Any]) -> Table:
    """Verdict, what is wrong, how sure.

    Args:
        diagnosis: ``diagnosis.json``.
    """
    made = Table("", "found")
    made.row("verdict", f"`{diagnosis['verdict']}`")
    for effect in diagnosis["effects"]:
        made.row(f"`{effect['name']}`", f"{effect['sentence']} `{effect['equation']}`")
    made.row("how sure", diagnosis["summary"]["sure"])
    return made


def driven_table(nominal: Mapping[str, Mapping[str, Any]],
                 diagnosed: Mapping[str, Mapping[str, Any]]) -> Table:
    """Errors of both vehicle files.

    Args:
        nominal, diagnosed: ``comparison.json``, by the words for the half.
    """
    made = Table("rms error, every sample", "nominal car", "diagnosed car", "less by")
    for half, before in nominal.items():
        for channel, words, scale in ((YAW_RATE, "yaw rate [deg/s]", degrees(1.0)),
                                      (SIDEWAYS, "side velocity [m/s]", 1.0)):
            a, b = (one["channels"][channel]["rms"] for one in (before, diagnosed[half]))
            made.row(f"{words}, half {half}", f"{a * scale:.2f}", f"{b * scale:.2f}",
                     f"{100.0 * (1.0 - b / a):.0f} %")
    return made


def _answer(*words: object) -> dict[str, Any]:
    made = subprocess.run([sys.executable, "-m", "truck_blowout_sim", *map(str, words), "--json"],
                          stdout=subprocess.PIPE, check=True)
    return dict(json.loads(made.stdout))


def measure(first: Path, second: Path, page: Page = None) -> None:
    """Diagnose and drive; two tables."""
    place, halves = Place(page, "car"), {"that trained": first, "never seen": second}
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder)
        found = found_table(_answer("diagnose", first, "--holdout", second, "--vehicle", NOMINAL,
                                    "--settings", "measured_car", "-o", out / "diagnosis"))
        vehicles = {"nominal": NOMINAL, "diagnosed": out / "diagnosis" / "vehicle.yaml"}
        driven = {name: {half: _answer("compare", file, "--vehicle", vehicle, "-o",
                                       out / name / str(k))
                         for k, (half, file) in enumerate(halves.items())}
                  for name, vehicle in vehicles.items()}
    place.write(found, driven_table(driven["nominal"], driven["diagnosed"]))


if __name__ == "__main__":
    start_function(measure)

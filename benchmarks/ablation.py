"""What parts of the diagnosis are worth.

    python -m benchmarks.ablation CASES OUT WITHOUT [WORKERS]

WITHOUT is `forms` (numbers by which good models differ in form), `noise` (widths as stated, not as
the runs show them) or `laws` (one law an effect). OUT gets the lines that `truck-blowout prove
--cases CASES -o OUT` then scores like any others.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Any

from truck_blowout_sim.diagnosis.settings import Settings
from truck_blowout_sim.proof.blindfold import blindfold
from truck_blowout_sim.proof.cases import find_cases
from truck_blowout_sim.proof.run import run_cases
from truck_blowout_sim.vehicle import Packed

# of config/diagnosis/default.yaml: in these, good models differ in form
FORMS = ("_carcass", "_spring", "steered_friction", "_frame", "rim_radius", "flat_volume",
         "deflation", "flat_trail", "flat_relaxation", "gas_exponent", "steering_lag",
         "steering_curve", "brake_curve")  # fmt: skip
ROOM = "truck_blowout_sim.diagnosis"
STEP_S = 0.0025  # as `truck-blowout prove`


def without_forms() -> None:
    """Every such number as the sheet has it."""
    room: Any = import_module(f"{ROOM}.diagnose")
    load: Callable[[Packed, str], Settings] = room.load_settings

    def fewer(packed: Packed, name: str) -> Settings:
        settings = load(packed, name)
        return replace(settings, nuisances=tuple(
            n for n in settings.nuisances if not n.name.endswith(FORMS)))

    room.load_settings = fewer


def without_noise() -> None:
    """The widths that the settings state, whatever the runs show."""
    room: Any = import_module(f"{ROOM}.case.calibration")
    room.whiten = lambda study: None


def without_laws() -> None:
    """The first law of each effect alone."""
    room: Any = import_module(f"{ROOM}.name.candidates")
    room.LIBRARY = tuple(effect for effect in room.LIBRARY if not effect.variant)


PARTS: dict[str, Callable[[], None]] = {
    "forms": without_forms, "noise": without_noise, "laws": without_laws}


def _begin(part: str) -> None:
    PARTS[part]()
    blindfold()


def main(cases: str, out: str, part: str, workers: str = "2") -> None:
    """Diagnose every case that has no line yet."""
    for line in run_cases(find_cases(Path(cases)), Path(out), workers=int(workers), step_s=STEP_S,
                          with_baselines=False, begin=partial(_begin, part)):
        print(line["case"], flush=True)


if __name__ == "__main__":
    if len(sys.argv) < 4 or sys.argv[3] not in PARTS:
        sys.exit(str(__doc__))
    main(*sys.argv[1:])

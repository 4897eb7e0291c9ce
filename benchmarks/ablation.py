"""What parts of the diagnosis are worth.

    python -m benchmarks.ablation run CASES OUT WITHOUT [WORKERS]
    python -m benchmarks.ablation table whole=FOLDER WITHOUT=FOLDER … [-o docs/proof_studies.md]

WITHOUT is `forms` (numbers by which good models differ in form), `noise` (widths as stated, not as
the runs show them) or `laws` (one law an effect). OUT gets the lines that `truck-blowout prove
--cases CASES -o OUT` then scores like any others; `table` joins such folders, all of the same
cases.

Validated with: test/benchmarks/test_ablation.py.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Annotated, Any

import typer

from benchmarks.page import Page, Table, start
from benchmarks.proved import figures_of, of
from truck_blowout_sim.diagnosis.settings import Settings
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.proof.blindfold import blindfold
from truck_blowout_sim.proof.cases import find_cases
from truck_blowout_sim.proof.run import run_cases
from truck_blowout_sim.report.marked import put_on_page
from truck_blowout_sim.vehicle import Packed

# of config/diagnosis/default.yaml: in these, good models differ in form
FORMS = ("_carcass", "_spring", "steered_friction", "_frame", "rim_radius", "flat_volume",
         "deflation", "flat_trail", "flat_relaxation", "gas_exponent", "steering_lag",
         "steering_curve", "brake_curve")  # fmt: skip
ROOM = "truck_blowout_sim.diagnosis"
STEP_S = 0.0025  # as `truck-blowout prove`
# rows of proof/rows.py, and the heads of their columns
COUNTS: Mapping[str, str] = {
    "false alarms, nothing missing": "false alarms",
    "effects seen by an ideal detector, among the causes named": "visible effects named",
    "effects beyond six spreads of fault-free vehicles, among the causes named":
        "effects beyond six spreads named",
    "a wrong name stated, something missing": "wrong names",
}
WORDS: Mapping[str, str] = {
    "whole": "whole", "noise": "widths as stated, not estimated", "laws": "one law an effect",
    "forms": "no numbers for the form of a model",
}  # fmt: skip
app = typer.Typer(no_args_is_help=True, add_completion=False, help=__doc__)


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


@app.command()
def run(cases: Path, out: Path, without: str,
        workers: Annotated[int, typer.Argument(help="processes")] = 2) -> None:
    """Diagnose every case that has no line yet."""
    if without not in PARTS:
        raise InputError(f"{without!r}", file="WITHOUT", expected=f"one of {', '.join(PARTS)}")
    run_all(cases, out, workers, partial(_begin, without))


def run_all(cases: Path, out: Path, workers: int, begin: Callable[[], None]) -> None:
    """Diagnose what has no line yet; each process does ``begin`` first, which blindfolds it."""
    for line in run_cases(find_cases(cases), out, workers=workers, step_s=STEP_S,
                          with_baselines=False, begin=begin):
        print(line["case"], flush=True)


@app.command()
def table(runs: list[str], page: Page = None) -> None:
    """Counts of each run side by side; RUNS: PART=FOLDER, as `truck-blowout prove` wrote it."""
    figures = {}
    for word in runs:
        part, _, folder = word.partition("=")
        if part not in WORDS:
            raise InputError(f"{part!r}", file=word, expected=f"one of {', '.join(WORDS)}")
        figures[part] = figures_of(Path(folder))
    made = ablation_table(figures)
    if page is not None:
        put_on_page(page, "ablation", str(made))


def _cases(figures: Mapping[str, Any]) -> list[str]:
    return [*(one["case"] for one in figures["each"]), *figures["failed"]]


def ablation_table(figures: Mapping[str, Mapping[str, Any]]) -> Table:
    """A row each part that was left out.

    Args:
        figures: of ``proof.json``, by part.

    Raises:
        InputError: the runs are not of the same cases.
    """
    if len({frozenset(_cases(one)) for one in figures.values()}) > 1:
        raise InputError("runs of different cases", expected="the same cases in every folder")
    reached = {part: {row["row"]: row for row in one["rows"]} for part, one in figures.items()}
    shown = [row for row in COUNTS if any(one[row]["trials"] for one in reached.values())]
    made = Table("", *(COUNTS[row] for row in shown))
    for part, one in reached.items():
        made.row(WORDS[part], *(of(one[row]) for row in shown))
    return made


if __name__ == "__main__":
    start(app)

"""How much answers depend on the judgments in the code of the diagnosis.

    python -m benchmarks.judgments list [-o docs/diagnosis.md]
    python -m benchmarks.judgments run CASES OUT [--draw 1] [--workers 1]
    truck-blowout prove --cases CASES -o OUT --no-baselines
    python -m benchmarks.judgments table w1=WHOLE,OUT w2=WHOLE,OUT … [-o docs/proof_studies.md]

No publication gives these numbers, and they decide between explanations: what a free instant costs,
when an explanation is no rival. `run` multiplies each by a factor of its own, drawn evenly on a log
scale between 2/3 and 3/2, and diagnoses the cases with these; WHOLE is what `prove` wrote with the
numbers as they are. If figures had been fitted to some recordings, those would get worse.

Known limits: outside `sensors/`; numbers of search grids and of convergence are not judgments.
Validated with: test/benchmarks/test_judgments.py.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

from benchmarks.ablation import ROOM, run_all
from benchmarks.page import Page, Table, start
from benchmarks.proved import figures_of, of, two_a_world
from truck_blowout_sim.proof.blindfold import blindfold
from truck_blowout_sim.report.marked import put_on_page

FURTHEST = 1.5  # times as much, or as little
ROWS: Mapping[str, str] = {
    "effects beyond six spreads of fault-free vehicles, among the causes named": "named",
    "of no list: unknown": "of no list: unknown",
    "a wrong name stated, something missing": "wrong names",
    "false alarms, nothing missing": "false alarms",
}  # fmt: skip
app = typer.Typer(no_args_is_help=True, add_completion=False, help=__doc__)


@dataclass(frozen=True)
class Judgment:
    """A number of the code that decides between explanations.

    Attributes:
        module: below ``truck_blowout_sim.diagnosis``; ``name``: of the constant.
        meaning: what it decides.
        share: whether it is a share, which cannot exceed one.
    """

    module: str
    name: str
    meaning: str
    share: bool = True

    @property
    def value(self) -> float:
        """As the code has it."""
        return float(getattr(import_module(f"{ROOM}.{self.module}"), self.name))

    def varied(self, factor: float) -> float:
        """So many times as large, at most one if it is a share."""
        return min(self.value * factor, 1.0) if self.share else self.value * factor


JUDGMENTS = (
    Judgment("case.calibration", "_KNOWN", "prior sigmas to which baseline runs must hold a number "
             "to count as known"),
    Judgment("case.sliding", "_PARTED_RAD", "radians by which side slip and heading differ from "
             "the model's within two seconds where one of them slides, so that what follows does "
             "not count", share=False),
    Judgment("case.sliding", "_SAME_SPEED", "difference of speed from the model's below which a "
             "log counts again after that, of the model's"),
    Judgment("effects.base", "WRONG_SHEET", "spread of a number where its sheet is wrong, times "
             "that between trucks", share=False),
    Judgment("effects.base", "CHANGED_IN_S", "seconds that a change which grows and stays takes at "
             "most", share=False),
    Judgment("fit.seconds", "_WIDE", "1 sigma of an event's amount, of the largest possible"),
    Judgment("fit.shown", "_ANEW", "variance of a truck's numbers that is new each day, of that "
             "between trucks"),
    Judgment("fit.shown", "WRONG_SHEETS", "numbers of a sheet that are wrong beyond what trucks "
             "differ by, of all"),
    Judgment("fit.width_error", "RUN_SCATTER", "1 sigma from run to run of the logarithm of the "
             "mean square that a model leaves", share=False),
    Judgment("locate.by_chance", "_RUNS", "runs that this prior is worth", share=False),
    Judgment("locate.left_over", "NAMING_SHARE", "excess of training over baseline that a name "
             "must remove, of all"),
    Judgment("locate.lagging", "_SHARED", "lag of the opposite wheel from which on a drag is not "
             "one wheel's, of its own"),
    Judgment("locate.lagging", "_DOUBT", "drags that may be called a wheel's by chance, of all"),
    Judgment("locate.lines", "_MODELS_DIFFER", "what a model may err by at the distance at which "
             "the vehicle swings anyway, of that swing"),
    Judgment("locate.periodic", "_ALWAYS", "power of a line in baseline runs from which on it is "
             "always there, of that in training"),
    Judgment("name.events", "_TIMED_COST", "evidence that choosing an instant in a run costs",
             share=False),
    Judgment("name.events", "_TIMED_SHARE", "evidence that an event's shape costs, of its own"),
    Judgment("name.events", "_HALF", "evidence below which an event is no rival, of the best"),
    Judgment("name.events", "_LARGE", "evidence from which on a tire may have been lost unseen, "
             "times what is asked", share=False),
    Judgment("name.judging", "_LAW", "residual that inexact laws may move from one cause to "
             "another, of all"),
    Judgment("name.judging", "ALIAS_SHARE", "evidence that an alias has, at least, of that of "
             "the best"),
    Judgment("name.judging", "_EVENT_WORTH", "evidence of an event beside that of a steady cause"),
    Judgment("name.pairing", "_MUCH", "support of a cause that the holdout rejects, from which on "
             "a second one is sought, times what is asked", share=False),
    Judgment("name.pairing", "_HALF", "support that two causes must have alone to be tried "
             "together, of what is asked"),
    Judgment("name.search", "_MOST", "excess that a cause must explain to be excused from what a "
             "stronger one left, of all"),
)


def vary(draw: int) -> None:
    """Replace each judgment, in every module that has it, by a drawn multiple of it."""
    import_module(f"{ROOM}.diagnose")
    rng = np.random.default_rng(draw)
    turned = {one: one.varied(float(np.exp(rng.uniform(-1.0, 1.0) * np.log(FURTHEST))))
              for one in JUDGMENTS}
    for one, value in turned.items():
        own: Any = import_module(f"{ROOM}.{one.module}")
        users = [own] if one.name.startswith("_") else [
            module for name, module in sys.modules.items()
            if name.startswith(ROOM) and hasattr(module, one.name)]
        for module in users:
            setattr(module, one.name, value)


def _begin(draw: int) -> None:
    vary(draw)
    blindfold()


def judgments_table() -> Table:
    """What each judgment is, and where."""
    made = Table("judgment", "value", "constant")
    for one in JUDGMENTS:
        path = f"{one.module.replace('.', '/')}.py"
        made.row(one.meaning, f"{one.value:g}", f"`{path}`, `{one.name}`")
    return made


@app.command("list")
def list_(page: Page = None) -> None:
    """Every judgment with its value."""
    made = judgments_table()
    if page is not None:
        put_on_page(page, "judgments", str(made))


@app.command()
def run(cases: Path, out: Path,
        draw: Annotated[int, typer.Option(help="which draw of the factors")] = 1,
        workers: Annotated[int, typer.Option(help="processes")] = 1) -> None:
    """Diagnose every case that has no line yet, with judgments as drawn."""
    run_all(cases, out, workers, partial(_begin, draw))


@app.command()
def table(runs: list[str], page: Page = None) -> None:
    """Figures with the judgments as they are and as drawn; RUNS: WORLD=WHOLE,VARIED."""
    figures = {world: (figures_of(whole), figures_of(varied))
               for world, whole, varied in two_a_world(runs, "WHOLE,VARIED, folders of `prove -o`")}
    made = varied_table(figures)
    if page is not None:
        put_on_page(page, "judgments-varied", str(made))


def varied_table(figures: Mapping[str, tuple[Mapping[str, Any], Mapping[str, Any]]]) -> Table:
    """A row each world: answers that stay the same, and rows of the proof before and after.

    Args:
        figures: of ``proof.json``, judgments as they are and as drawn, by world.
    """
    made = Table("judgments as they are → varied", "same answer", *ROWS.values())
    for world, pair in figures.items():
        whole, varied = map(_answers, pair)
        both = whole.keys() & varied.keys()
        same = sum(whole[case] == varied[case] for case in both)
        rows = [{row["row"]: row for row in each["rows"]} for each in pair]
        made.row(world.upper(), f"{same} of {len(both)}",
                 *(" → ".join(of(one[row]) for one in rows) for row in ROWS))
    return made


def _answers(figures: Mapping[str, Any]) -> dict[str, tuple[str, tuple[str, ...]]]:
    """Verdict and names of each case."""
    return {one["case"]: (one["verdict"], tuple(one["named"])) for one in figures["each"]}


if __name__ == "__main__":
    start(app)

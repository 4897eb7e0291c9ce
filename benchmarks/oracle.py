"""What the search costs: the diagnosis of cases whose true name it is told.

    python -m benchmarks.oracle make CASES OUT
    truck-blowout prove --cases OUT -o TOLD --no-baselines
    python -m benchmarks.oracle table w1=WHOLE,TOLD w3=WHOLE,TOLD … [-o docs/proof_studies.md]

`make` copies the cases with an effect of the library that the table counts; in each, every other
name is excluded, as by `--without`. Place, amount, instant, and the chance that nothing is missing
stay open. What the diagnosis then does not name, a better search among names would not have found.
WHOLE is what `prove` wrote for all cases.

Known limits: no strict bound, as the scatter of amounts is learned from fewer hypotheses.

Validated with: test/benchmarks/test_oracle.py.
"""

from __future__ import annotations

import json
import shutil
from collections.abc import Collection, Mapping
from pathlib import Path
from statistics import median
from typing import Any

import typer

from benchmarks.page import Page, Table, start
from benchmarks.proved import figures_of, of, two_a_world
from truck_blowout_sim.diagnosis.effects import LIBRARY as EFFECTS
from truck_blowout_sim.proof.cases import LIBRARY, SIGMA_B, find_cases, read_truth
from truck_blowout_sim.proof.rows import VISIBLE
from truck_blowout_sim.report.marked import put_on_page

ROW = "effects beyond six spreads of fault-free vehicles, among the causes named"
app = typer.Typer(no_args_is_help=True, add_completion=False, help=__doc__)


def others(names: Collection[str]) -> list[str]:
    """Every name of the library but these."""
    return sorted({effect.name for effect in EFFECTS} - set(names))


@app.command()
def make(cases: Path, out: Path) -> None:
    """Copy the cases with an effect of the library; all but its name are excluded.

    Where it is known to be less than six spreads of fault-free vehicles, no row counts it.
    """
    count = 0
    for case in find_cases(cases):
        causes = [one for one in read_truth(case.answer).causes if one.kind == "physics"]
        names = {one.name for one in causes}
        if all(one.beyond_spread is not None and one.beyond_spread < VISIBLE for one in causes):
            continue
        folder, count = out / "cases" / case.id, count + 1
        shutil.copytree(case.folder, folder)
        (out / "answers").mkdir(exist_ok=True)
        shutil.copy(case.answer, out / "answers" / case.answer.name)
        without = sorted({*case.without(), *others(names)})
        told = {"vehicle": case.vehicle(), "without": without}
        (folder / LIBRARY).write_text(json.dumps(told), encoding="utf-8")
    if (cases / SIGMA_B).is_file():
        shutil.copy(cases / SIGMA_B, out / SIGMA_B)
    print(f"{count} cases")


@app.command()
def table(runs: list[str], page: Page = None) -> None:
    """Effects named without and with the true name; RUNS: WORLD=WHOLE,TOLD."""
    figures = {}
    for world, whole, told in two_a_world(runs, "WHOLE,TOLD, folders of `prove -o`"):
        figures[world] = (figures_of(whole), figures_of(told))
    made = oracle_table(figures)
    if page is not None:
        put_on_page(page, "oracle", str(made))


def oracle_table(figures: Mapping[str, tuple[Mapping[str, Any], Mapping[str, Any]]]) -> Table:
    """A row each world: effects named by the search, and with the name told.

    Args:
        figures: of ``proof.json``, whole and told, by world.
    """
    made = Table("effects beyond six spreads", "named", "named, the true name told",
                 "error on unseen runs", "the true name told", "sheet values")
    for world, pair in figures.items():
        made.row(world.upper(), *(_count(one) for one in pair), *_errors(*pair))
    return made


def _count(figures: Mapping[str, Any]) -> str:
    return of(next(row for row in figures["rows"] if row["row"] == ROW))


def _errors(whole: Mapping[str, Any], told: Mapping[str, Any]) -> list[str]:
    """Medians over the cases of both: as diagnosed, the name told, before either."""
    one, other = (_holdout(figures) for figures in (whole, told))
    both = sorted(one.keys() & other.keys())
    columns = ([one[case][1] for case in both], [other[case][1] for case in both],
               [one[case][0] for case in both])
    return [_three_digits(median(values)) if values else "–" for values in columns]


def _three_digits(value: float) -> str:
    return f"{float(f'{value:.3g}'):,g}"


def _holdout(figures: Mapping[str, Any]) -> dict[str, tuple[float, float]]:
    """Mean square on unseen runs before and after, by case, where an effect stands out."""
    plain = {one["case"] for one in figures["causes"] if one["kind"] == "physics"}
    return {each["case"]: (each["holdout"]["before"], each["holdout"]["after"])
            for each in figures["each"] if each["holdout"] and each["case"] in plain}


if __name__ == "__main__":
    start(app)

"""What no search could find: the diagnosis told the very motion that an effect makes.

    python -m benchmarks.motion tell CASES -o TOLD.jsonl [--case NAME …]
    python -m benchmarks.motion table w1=PROOF,TOLD.jsonl … [-o docs/proof_studies.md]

Each case is driven again with and without its effects, on the same commands and the same road. The
difference in all recorded channels is one hypothesis of unknown amount, asked by the rule of
step 7 of every run, unseen ones too, as a single question: no place, instant, law or frequency is
searched. So no search among forces can support what this does not; checks of what is left may still
notice it. Both effects of a pair count as one. CASES hold effects of a world, PROOF is what
`truck-blowout prove -o` wrote for them.

Known limits: beside the numbers of the sheet alone, nothing named; scatter is that of all other
hypotheses of the case. A vehicle that turns over on the same commands without its effects is left
out.
Validated with: test/diagnosis/test_motion.py.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from numpy.typing import NDArray

from benchmarks.page import Page, Table, start
from benchmarks.proved import figures_of, two_a_world
from proving_ground.generate import builder
from proving_ground.visibility import spec_of
from truck_blowout_sim.diagnosis.algebra.linear import Projector
from truck_blowout_sim.diagnosis.case.antilock import as_braked
from truck_blowout_sim.diagnosis.case.calibration import calibrate
from truck_blowout_sim.diagnosis.case.driven import driven
from truck_blowout_sim.diagnosis.case.recorded import Recorded
from truck_blowout_sim.diagnosis.case.runs import Run, bin_means
from truck_blowout_sim.diagnosis.case.study import Study, row_ranges
from truck_blowout_sim.diagnosis.fit.shown import Shown, parts_of
from truck_blowout_sim.diagnosis.name.candidates import known_names
from truck_blowout_sim.diagnosis.name.shortlist import shortlist
from truck_blowout_sim.diagnosis.settings import load_settings
from truck_blowout_sim.proof.cases import ROLES, Case, find_cases, read_truth
from truck_blowout_sim.proof.rows import VISIBLE
from truck_blowout_sim.recordings import read_recording
from truck_blowout_sim.report.marked import put_on_page
from truck_blowout_sim.vehicle import load_vehicle, pack

Floats = NDArray[np.float64]
Signals = tuple[Floats, Mapping[str, Floats]]   # times, change by channel
THEM = ("motion", "told")                       # key of the hypothesis
GROUPS = {"unknown": "of no list", "single": "one effect", "pair": "two effects"}
app = typer.Typer(no_args_is_help=True, add_completion=False, help=__doc__)


def changes(case: Case) -> dict[str, Signals]:
    """What the effects of a case change in every run; in baseline runs what they would."""
    spec = spec_of(case.id)
    answer = json.loads(case.answer.read_text(encoding="utf-8"))
    severities = [one["severity"] for one in answer["effects"][:len(spec.effects)]]
    made, found = builder(spec), {}
    for name, manoeuvre, seed in made.runs:
        there = made.actives(severities, manoeuvre, seed)
        now, other = ([], there) if name.startswith("baseline") else (there, [])
        truth = made._drive(manoeuvre, now, seed)
        one, two = made.clean(truth), made.clean(made._replay(truth, other, even=False))
        count = min(len(next(iter(values.values()))) for values in (one, two))
        sign = -1.0 if name.startswith("baseline") else 1.0
        found[name] = (truth.time_s[:count], {
            channel: sign * (one[channel][:count] - two[channel][:count]) for channel in one})
    return found


def study_of(case: Case) -> Study:
    """The case as the diagnosis has it once the truck is calibrated."""
    packed = pack(load_vehicle(case.vehicle()))
    recordings = {role: [read_recording(path) for path in case.recordings(role)]
                  for role in ROLES}
    packed, _ = as_braked(packed, [*recordings["train"], *recordings["baseline"]])
    rules = replace(load_settings(packed, "default"), without=known_names(case.without()))
    study = Recorded(recordings["train"], recordings["baseline"], recordings["holdout"], packed,
                     rules).study()
    calibrate(study)
    return study


def column(run: Run, signals: Signals) -> Floats:
    """[rows] a change of the channels as the run would show it, whitened."""
    time_s, values = signals
    change: Floats = np.zeros(run.measured.shape)
    for k, channel in enumerate(run.channels):
        if channel in values:
            change[:, k] = np.nan_to_num(bin_means(time_s, values[channel], run.edges_s)[0])
    return run.change(change, np.zeros_like(change))


def support_of(study: Study, told: Mapping[str, Signals]) -> tuple[float, float]:
    """Support of the motion that was told, and what a single question asks."""
    chance = shortlist(study, (), None, 0.0).chance
    runs, rows = (*study.runs, *study.holdout), row_ranges(study)
    columns = [column(run, told[run.recording.name]) for run in runs]
    residuals = [study.residual(), *(run.residual(model) for run, model in zip(
        study.holdout, study.holdout_models, strict=True))]
    parts, first, manners = [], 0, driven(study)
    for run, one, manner in zip(runs, columns, manners, strict=True):
        parts += parts_of(run, first, one, run.role != "baseline", study.settings.episode_s, manner)
        first += one.size
    there = np.concatenate([one * (run.role != "baseline")
                            for run, one in zip(runs, columns, strict=True)])
    nuisances = np.concatenate([study.columns, *study.holdout_columns])
    projector = Projector.of(nuisances, study.kept(), study.gram_of(range(len(runs))))
    residual = np.concatenate(residuals)
    left = projector.remove(residual - there)
    shown = Shown.of(projector, projector.remove(residual), parts, (0.0,), (0.0, 1.0), left)
    fitted = there[:rows[-1].stop]
    scatter = chance.beside(THEM, fitted, study.columns.T @ fitted, left)
    return (0.0 if shown is None else scatter.support(shown)), chance.alone.asked


@app.command()
def tell(cases: Path, output: Annotated[Path, typer.Option("--output", "-o")],
         case: Annotated[list[str] | None, typer.Option()] = None) -> None:
    """One line of JSON a case with physics missing: support when told, and what is asked."""
    done = {line["case"] for line in _lines(output)} if output.is_file() else set()
    for one in find_cases(cases):
        if one.id in done or (case and one.id not in case) or not spec_of(one.id).effects:
            continue
        truth = read_truth(one.answer)
        if not all(c.visibility is None or c.visibility >= VISIBLE for c in truth.causes):
            continue
        try:
            told = changes(one)
        except FloatingPointError as error:
            print(f"{one.id}: {error}; left out", flush=True)
            continue
        support, asked = support_of(study_of(one), told)
        line = {"case": one.id, "group": truth.group, "support": round(support, 3),
                "asked": round(asked, 3)}
        with output.open("a", encoding="utf-8") as file:
            file.write(json.dumps(line) + "\n")
        print(line, flush=True)


def _lines(path: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]


@app.command()
def table(runs: list[str], page: Page = None) -> None:
    """Cases found, and those that are supported when told; RUNS: WORLD=PROOF,TOLD.jsonl."""
    worlds = {}
    for world, proof, told in two_a_world(runs, "PROOF,TOLD.jsonl"):
        worlds[world] = (figures_of(proof)["each"],
                         {line["case"]: line for line in _lines(told)})
    made = motion_table(worlds)
    if page is not None:
        put_on_page(page, "motion", str(made))


def motion_table(worlds: Mapping[str, tuple[Sequence[Any], Mapping[str, Mapping[str, Any]]]]
                 ) -> Table:
    """A row each world and group of cases that were told.

    Args:
        worlds: `each` of ``proof.json``, and lines of `tell` by case.
    """
    made = Table("", "found", "found, or supported when told", "not found",
                 "of these supported when told")
    for world, (each, told) in worlds.items():
        found = {one["case"]: _found(one) for one in each}
        for group, words in GROUPS.items():
            lines = [line for case, line in told.items()
                     if line["group"] == group and case in found]
            missed = [line for line in lines if not found[line["case"]]]
            more = sum(line["support"] >= line["asked"] for line in missed)
            if lines:
                hits = len(lines) - len(missed)
                made.row(f"{world.upper()}, {words}", f"{hits} of {len(lines)}",
                         f"{hits + more} of {len(lines)}", str(len(missed)), str(more))
    return made


def _found(score: Mapping[str, Any]) -> bool:
    """Whether the answer is right: `unknown` where the effect is of no list, else the names."""
    if score["group"] == "unknown":
        return bool(score["verdict"] == "unknown")
    return all(cause["aliased"] for cause in score["causes"])


if __name__ == "__main__":
    start(app)

"""Score a run and write what a sceptic wants to see: figures, every case, pictures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from truck_blowout_sim.comparison.plain_json import json_text
from truck_blowout_sim.proof.baselines.sparse_regression import optimizer_name
from truck_blowout_sim.proof.case_tables import cases_csv, parameters_csv
from truck_blowout_sim.proof.cases import Case, Truth, read_truth
from truck_blowout_sim.proof.causes import causes_told, wrongly_told
from truck_blowout_sim.proof.figures import pictures
from truck_blowout_sim.proof.rows import as_json, rows, rows_table, uniformity
from truck_blowout_sim.proof.score import no_answer, score_case
from truck_blowout_sim.proof.seal import SealCheck, check_seals
from truck_blowout_sim.proof.short import short_table
from truck_blowout_sim.proof.summary import null_floor, summarize
from truck_blowout_sim.proof.table import markdown
from truck_blowout_sim.proof.worlds import seen_effects
from truck_blowout_sim.recordings.atomic import replacing

Figures = dict[str, Any]


def score_run(cases: Sequence[Case], lines: Mapping[str, Mapping[str, Any]], out: Path,
              manifest: Path | None = None) -> Figures:
    """Check the seals, score every case that has a line, write all files.

    Raises:
        InputError: an answer or the manifest cannot be read.
    """
    seals = check_seals(cases, manifest, lines.keys() & {case.id for case in cases})
    truths = {case.id: read_truth(case.answer) for case in cases if case.id in lines}
    return score_answers(truths, lines, seals, out)


def score_answers(truths: Mapping[str, Truth], lines: Mapping[str, Mapping[str, Any]],
                  seals: SealCheck, out: Path) -> Figures:
    """Score answers by what was concealed, write all files into ``out``."""
    answered = [case for case in truths if lines[case]["answer"]]
    floor = null_floor(lines, [case for case in answered if truths[case].group == "null"])
    scores = [score_case(lines[case], truths[case], floor) for case in answered]
    failed = {case: lines[case]["error"] for case in truths if case not in answered}
    figures = summarize(scores, failed, [truths[case].group for case in failed])
    figures["seals"] = asdict(seals)
    figures["optimizer_of_sparse_regression"] = optimizer_name()
    figures["code"] = sorted({str(lines[case].get("code")) for case in truths})
    every = sorted([*scores, *(no_answer(case, truths[case]) for case in failed)],
                   key=lambda score: score.case)
    found, uniform = rows(every, truths), uniformity(scores)
    figures["rows"], figures["null_p_values_uniform"] = as_json(found), uniform
    figures["seen"] = seen_effects([
        (cause.name, cause.visibility, scored.aliased) for score in every
        for scored, cause in zip(score.causes, truths[score.case].causes, strict=True)
        if cause.kind == "physics" and score.group in ("single", "pair")
        and cause.sigma_b is not None])
    figures["causes"] = causes_told(every, truths)
    figures["wrongly_told"] = wrongly_told(scores, truths)
    figures["each"] = [asdict(score) for score in scores]
    out.mkdir(parents=True, exist_ok=True)
    _write(out / "proof.json", json_text(figures))
    head = seals.sentence() + (
        "" if len(figures["code"]) < 2 else
        f" The lines were made by {len(figures['code'])} versions of the code.")
    _write(out / "proof.md", markdown(figures, head, rows_table(found, uniform)))
    _write(out / "cases.csv", cases_csv(every, truths))
    _write(out / "parameters.csv", parameters_csv(figures))
    _write(out / "summary.md", short_table(figures) + "\n")
    for picture in pictures(figures):
        (out / f"{picture.name}.png").write_bytes(picture.png())
    return figures


def _write(path: Path, text: str) -> None:
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8", newline="\n")

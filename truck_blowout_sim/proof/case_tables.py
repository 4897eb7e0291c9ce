"""Every case and every estimated parameter of a run, as CSV tables.

Validated with: test/proof/test_summary.py.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from truck_blowout_sim.proof.cases import Truth
from truck_blowout_sim.proof.score import CaseScore

CASE_COLUMNS = ("case", "concealed", "sigma", "sigma_b", "verdict", "named", "solved",
                "holdout_before", "holdout_after")
PARAMETER_COLUMNS = ("effect", "truth", "found", "relative_error", "in_interval_90")


def cases_csv(scores: Sequence[CaseScore], truths: Mapping[str, Truth]) -> str:
    """One row a case.

    `concealed` joins causes by `+`. `sigma_b`, where it was measured, is what an ideal detector
    sees of each. `named` joins effects by `;`, each with the rest of its alias set in brackets.
    `solved` is `yes`, `verdict` (the verdict alone is right) or `no`. The holdout columns are mean
    squares in instrument noise squared.
    """
    return _table(CASE_COLUMNS, (_case(score, truths[score.case]) for score in scores))


def parameters_csv(figures: Mapping[str, Any]) -> str:
    """One row an estimated parameter whose truth is the same quantity."""
    return _table(PARAMETER_COLUMNS, (
        (p["name"], f"{p['truth']:.4g}", f"{p['found']:.4g}", f"{p['relative_error']:.2f}",
         "yes" if p["covered"] else "no") for p in figures["parameters"]["each"]))


def _table(columns: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(rows)
    return text.getvalue()


def _case(score: CaseScore, truth: Truth) -> tuple[str, ...]:
    hidden = " + ".join(f"{c.name} {_place(c.where)}".strip() for c in truth.causes)
    named = "; ".join(name + (f" ({', '.join(aliases[1:])})" if len(aliases) > 1 else "")
                      for name, aliases in zip(score.named, score.aliases, strict=True))
    solved = "yes" if score.solved else "verdict" if score.right else "no"
    fit = score.holdout
    seen = " + ".join(_number(c.sigma_b) for c in truth.causes if c.sigma_b is not None)
    return (score.case, hidden or "nothing", _number(score.sigma), seen,
            score.verdict.replace("_", " "), named, solved,
            _number(fit.before if fit else None), _number(fit.after if fit else None))


def _place(where: Mapping[str, str | None]) -> str:
    return where["tire"] or where["hub"] or where["axle"] or where["body"] or ""


def _number(value: float | None) -> str:
    return "" if value is None else f"{value:.3g}"

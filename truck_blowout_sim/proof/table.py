"""The report of a run as Markdown: figures against what is sought.

Every case and every parameter stand in CSV tables beside it (`case_tables.py`).

Validated with: test/proof/test_summary.py.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from truck_blowout_sim.proof.by_effect import effect_table
from truck_blowout_sim.proof.statistics import Proportion

SOUGHT: Mapping[str, str] = {
    "effect named at alias-set level": "≥ 90 %",
    "effect named first, raw": "≥ 80 %",
    "truth inside the alias set, where something was named": "≥ 95 %",
    "false discovery on nulls": "≤ 2 %",
    "unknown recognised": "≥ 85 %",
    "unknown misnamed": "≤ 5 %",
    "sensor against physics": "≥ 95 %",
    "body": "≥ 97 %",
    "axle, wheel channels present": "≥ 90 %",
    "both of a pair, alias-set level": "≥ 70 %",
}
VERDICTS = ("consistent", "miscalibrated", "sensor_artefact", "missing_physics", "unknown")
RIVAL_WORDS: Mapping[str, str] = {
    "no_change": "no change (sheet values)",
    "recalibrated": "everything recalibrated",
    "gaussian_process": "Gaussian process on the residual",
    "sparse_regression": "sparse regression on residual accelerations",
    "diagnosed": "diagnosed model",
}


def markdown(figures: Mapping[str, Any], seal: str, required: Sequence[str] = ()) -> str:
    """Everything, as one document; `required`: lines of the table of what must hold."""
    parts = [seal, "", "## What must hold", "", *required, "", "## Figures", "",
             *_proportions(figures), "", *_numbers(figures), "",
             "## Verdicts", "", *_confusion(figures), "", "## Power", "", *_power(figures), "",
             "## Effect by effect", "", *effect_table(figures["effects"]), "",
             "## p-values where nothing is missing", "", *_reliability(figures), "",
             "## Rivals on holdout", "", *_rivals(figures), "", "## Parameters", "",
             *_parameters(figures), "", "Every case: `cases.csv`.", *_failed(figures)]
    return "\n".join(parts) + "\n"


def counted(entry: Mapping[str, Any]) -> str:
    """A proportion of ``proof.json`` in words."""
    return str(Proportion(entry["hits"], entry["trials"]))


def _proportions(figures: Mapping[str, Any]) -> list[str]:
    rows = ["| figure | sought | reached (hits/cases; 95 % Wilson) |", "|---|---|---|"]
    return rows + [f"| {name} | {SOUGHT.get(name, '')} | {counted(entry)} |"
                   for name, entry in figures["proportions"].items()]


def number(value: float | None, unit: str = "", digits: int = 3) -> str:
    """A figure of ``proof.json``, a dash where there is none."""
    return "–" if value is None else f"{value:.{digits}g}{unit}"


def _numbers(figures: Mapping[str, Any]) -> list[str]:
    onset, fit, par = figures["onset"], figures["holdout"], figures["parameters"]
    rows = [
        ("mean size of the alias set", "≤ 2", number(figures["mean_alias_set_size"])),
        *((f"onset error, {kind}: median, 90th percentile", "≤ 0.05 s, ≤ 0.2 s" if kind == "abrupt"
           else "", f"{number(row['median_s'], ' s')}, {number(row['p90_s'], ' s')} "
           f"({row['count']})") for kind, row in onset.items()),
        ("parameter: median relative error", "≤ 0.10",
         f"{number(par['median_relative_error'])} ({par['count']})"),
        ("90 % intervals that hold the truth: parameters", "85–95 %", counted(par["coverage"])),
        ("the same: onsets", "85–95 %", counted(onset["all"]["coverage"])),
        ("holdout improved", "≥ 95 %", counted(fit["improved"])),
        ("holdout, median share removed of the excess over the instruments' noise", "",
         f"{number(fit['median_removed_of_excess_over_instruments'])} "
         f"({fit['count_over_instruments']})"),
        ("the same over what nulls leave (stands for the best possible)", "≥ 0.80",
         f"{number(fit['median_removed_of_excess_over_null_floor'])} "
         f"({fit['count_over_null_floor']})"),
        ("CPU time a case, median", "", number(figures["cpu_s"]["median"], " s")),
    ]
    return ["| figure | sought | reached (number of cases) |", "|---|---|---|",
            *(f"| {name} | {sought} | {reached} |" for name, sought, reached in rows)]


def _confusion(figures: Mapping[str, Any]) -> list[str]:
    rows = ["| concealed | " + " | ".join(v.replace("_", " ") for v in VERDICTS)
            + " | solved |", "|---" * (len(VERDICTS) + 2) + "|"]
    return rows + [f"| {group} | " + " | ".join(str(counts.get(v, 0)) for v in VERDICTS)
                   + f" | {counted(figures['solved'][group])} |"
                   for group, counts in figures["confusion"].items()]


def _power(figures: Mapping[str, Any]) -> list[str]:
    rows = ["| sigma | noticed | truth in alias set | truth named first |", "|---|---|---|---|"]
    for row in figures["power"]:
        low, high = row["sigma"]
        span = f"{low:g}–{high:g}" if high else f"≥ {low:g}"
        rows.append(f"| {span} | {counted(row['noticed'])} | {counted(row['aliased'])} | "
                    f"{counted(row['raw'])} |")
    return rows


def _reliability(figures: Mapping[str, Any]) -> list[str]:
    rows = ["| stated p-value at most | nulls (95 % Wilson) |", "|---|---|"]
    return rows + [f"| {level} | {counted(entry)} |"
                   for level, entry in figures["null_p_values_at_most"].items()]


def _rivals(figures: Mapping[str, Any]) -> list[str]:
    rows = ["Mean square over speeds and yaw rates on holdout, in instrument noise squared; cases "
            "with physics missing.", "",
            "| | cases | median | diagnosed model is better |", "|---|---|---|---|"]
    return rows + [f"| {RIVAL_WORDS[name]} | {row['count']} | "
                   f"{number(row['median_mean_square'])} | {counted(row['diagnosed_is_better'])} |"
                   for name, row in figures["rivals"].items()]


def _parameters(figures: Mapping[str, Any]) -> list[str]:
    said = [f"- `{name}`: {why}" for name, why in figures["parameters"]["not_comparable"].items()]
    return ["Truth and estimate of each: `parameters.csv`. Not compared, because truth and model "
            "state different quantities:", "", *said]


def _failed(figures: Mapping[str, Any]) -> list[str]:
    failed = figures["failed"]
    return ["", "Broke down, wrong in the table of verdicts, counted nowhere else:", "",
            *(f"- {case}: {why}" for case, why in failed.items())] if failed else []

"""The proof in one table, for the first page of a document.

Validated with: test/proof/test_short.py.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from truck_blowout_sim.proof.statistics import Proportion
from truck_blowout_sim.proof.table import RIVAL_WORDS, SOUGHT

WORDS: Mapping[str, str] = {
    "effect named at alias-set level": "effect of 10 sigma or more among the causes named",
    "effect named first, raw": "the same, named first",
    "false discovery on nulls": "anything named, or unknown, where nothing is missing",
    "unknown recognised": "effect of no list called unknown",
    "unknown misnamed": "effect of no list given a name",
    "sensor against physics": "instrument told from truck",
    "both of a pair, alias-set level": "both of two effects named",
}


def short_table(figures: Mapping[str, Any]) -> str:
    """What was sought and reached, in a dozen rows of Markdown."""
    rows = [(words, SOUGHT[name], figures["proportions"][name]) for name, words in WORDS.items()]
    rows += [("unseen runs predicted better than before", "≥ 95 %", figures["holdout"]["improved"]),
             ("90 % intervals of parameters that hold the truth", "85–95 %",
              figures["parameters"]["coverage"])]
    rows += [(f"unseen runs predicted better than by: {RIVAL_WORDS[name]}", "",
              row["diagnosed_is_better"]) for name, row in figures["rivals"].items()
             if row["diagnosed_is_better"]["trials"]]
    lines = [f"| {words} | {sought} | {Proportion(entry['hits'], entry['trials'])} |"
             for words, sought, entry in rows]
    return "\n".join([_head(figures), "", "| | sought | reached (hits/cases; 95 % Wilson) |",
                      "|---|---|---|", *lines])


def _head(figures: Mapping[str, Any]) -> str:
    """Which cases, and whether they were sealed."""
    seals, failed = figures["seals"], len(figures["failed"])
    text = f"{figures['cases'] + failed} cases" + (f" (`{seals['set']}`)" if seals["set"] else "")
    text += f", {len(seals['holds'])} under a seal that holds"
    return text + (f"; {failed} broke down and are not counted below." if failed else ".")

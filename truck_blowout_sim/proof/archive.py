"""Published answers: one compressed file of a world, enough to count again without a diagnosis.

A line of JSON a case: its answer as sealed (the text, so that its hash can be checked), sigma_b of
its effects, and what the diagnosis answered, without the errors of single channels that no table
uses. A draw may be scored in parts: lines of further cases join those that are there.

Validated with: test/proof/test_archive.py.
"""

from __future__ import annotations

import hashlib
import json
import lzma
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.proof.cases import Case, truth_of, visibility_of
from truck_blowout_sim.proof.prove import Figures, score_answers
from truck_blowout_sim.proof.seal import check_hashes
from truck_blowout_sim.recordings.atomic import replacing

_KEPT = ("verdict", "effects", "alias_sets", "null_p_value", "summary", "pulled")


@dataclass(frozen=True)
class Entry:
    """One case.

    Attributes:
        case: its name.
        truth: text of its sealed answer.
        visibility: `sigma_b`, `individual` and `apart` of its effects, where measured.
        line: what the diagnosis answered, as in `results.jsonl`.
    """

    case: str
    truth: str
    visibility: Mapping[str, list[float]]
    line: Mapping[str, Any]


def entries_of(cases: Sequence[Case], lines: Mapping[str, Mapping[str, Any]]) -> list[Entry]:
    """Entries of all cases that have a line of results."""
    return [Entry(case.id, case.answer.read_text(encoding="utf-8"), visibility_of(case.answer),
                  _short(lines[case.id], case.folder)) for case in cases if case.id in lines]


def answered_again(published: Iterable[Entry], lines: Mapping[str, Mapping[str, Any]]
                   ) -> list[Entry]:
    """Entries of the published cases that have another line of results, with that line."""
    return [replace(entry, line=_short(lines[entry.case], Path()))
            for entry in published if entry.case in lines]


def joined(before: Iterable[Entry], further: Iterable[Entry]) -> list[Entry]:
    """Both in order of name; of a case in both, the further one."""
    every = {entry.case: entry for entry in (*before, *further)}
    return [every[case] for case in sorted(every)]


def write_entries(path: Path, entries: Sequence[Entry]) -> None:
    """Write the file; the same entries give the same bytes."""
    text = "".join(json.dumps(asdict(entry), allow_nan=False) + "\n" for entry in entries)
    with replacing(path) as temporary:
        temporary.write_bytes(lzma.compress(text.encode(), preset=9))


def read_entries(path: Path) -> list[Entry]:
    """Entries of a file.

    Raises:
        InputError: it is missing, damaged, or no such file.
    """
    try:
        text = lzma.decompress(path.read_bytes()).decode()
        return [Entry(**json.loads(line)) for line in text.splitlines()]
    except (OSError, lzma.LZMAError, UnicodeDecodeError, TypeError, json.JSONDecodeError) as error:
        raise InputError(f"no published answers: {error}", file=path,
                         expected="what scripts/publish_answers.py writes") from error


def score_entries(entries: Sequence[Entry], manifest: Path, out: Path, origin: Path) -> Figures:
    """Count again what :func:`score_run` counted; ``origin`` is named where an entry is wrong.

    Raises:
        InputError: an answer or the manifest cannot be read.
    """
    hashes = {entry.case: (hashlib.sha256(entry.truth.encode()).hexdigest(),
                           str(entry.line["recordings_sha256"])) for entry in entries}
    truths = {entry.case: truth_of(entry.truth, entry.visibility, origin) for entry in entries}
    lines = {entry.case: entry.line for entry in entries}
    return score_answers(truths, lines, check_hashes(hashes, manifest), out)


def _short(line: Mapping[str, Any], folder: Path) -> dict[str, Any]:
    answer = line["answer"]
    if not answer:     # where the cases lay says nothing elsewhere
        return {**line, "error": str(line["error"]).replace(f"{folder}/", "")}
    kept = {key: answer[key] for key in _KEPT if key in answer}
    return {**line, "answer": {**kept, "fit": {"holdout": {
        when: answer["fit"]["holdout"][when] for when in ("before", "after")}}}}

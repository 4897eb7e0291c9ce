"""Check that answers and recordings are those that were sealed.

A manifest names every case with the SHA-256 of its answer and of its recordings (over
"<file> <hash>" lines in order of name). It is published before a scored run; after the run anyone
can see that no answer moved.

Validated with: test/proof/test_cases.py.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.proof.cases import Case


@dataclass(frozen=True)
class SealCheck:
    """What the check of a set against a manifest gave.

    Attributes:
        manifest: file that was checked against; None: there was none.
        holds: cases whose answer and recordings are as sealed.
        broken: cases that differ; ``absent``: cases that the manifest does not name.
    """

    manifest: str | None
    holds: tuple[str, ...] = ()
    broken: tuple[str, ...] = ()
    absent: tuple[str, ...] = ()

    def sentence(self) -> str:
        """For the reader of a table."""
        if self.manifest is None:
            return "No manifest: these answers were not sealed."
        text = f"Seals checked against `{self.manifest}`: {len(self.holds)} hold"
        text += f", {len(self.broken)} broken" if self.broken else ", none broken"
        return text + (f", {len(self.absent)} cases not in it." if self.absent else ".")


def file_hash(path: Path) -> str:
    """SHA-256 of a file's bytes."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


def folder_hash(folder: Path) -> str:
    """SHA-256 over names and hashes of the folder's CSV files, in order of name."""
    total = hashlib.sha256()
    for path in sorted(folder.glob("*.csv")):
        total.update(f"{path.name} {file_hash(path)}\n".encode())
    return total.hexdigest()


def check_seals(cases: Sequence[Case], manifest: Path | None) -> SealCheck:
    """Compare cases with a manifest.

    Raises:
        InputError: the manifest cannot be read.
    """
    if manifest is None:
        return SealCheck(None)
    try:
        sealed = json.loads(manifest.read_text(encoding="utf-8"))["cases"]
    except (OSError, KeyError, TypeError, json.JSONDecodeError) as error:
        raise InputError(f"not a manifest: {error!r}", file=manifest,
                         expected="JSON with the hashes of all cases") from error
    holds, broken, absent = [], [], []
    for case in cases:
        if case.id not in sealed:
            absent.append(case.id)
        elif sealed[case.id] == {"answer_sha256": file_hash(case.answer),
                                 "recordings_sha256": folder_hash(case.folder)}:
            holds.append(case.id)
        else:
            broken.append(case.id)
    return SealCheck(str(manifest), tuple(holds), tuple(broken), tuple(absent))

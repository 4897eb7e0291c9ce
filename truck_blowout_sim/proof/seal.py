"""Check that answers and recordings are those that were sealed.

A manifest names every case with the SHA-256 of its answer and of its recordings (over
"<file> <hash>" lines in order of name). It is published before a scored run; after the run anyone
can see that no answer moved.

Validated with: test/proof/test_cases.py.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.proof.cases import LIBRARY, Case

MANIFEST = "manifest.json"


@dataclass(frozen=True)
class SealCheck:
    """What the check of a set against a manifest gave.

    Attributes:
        manifest: file that was checked against; None: there was none.
        set: the manifest's name of the set; ``seal``: its one hash over all answers.
        holds: cases whose answer and recordings are as sealed.
        broken: cases whose answer differs.
        remade: cases with the sealed answer and other recordings.
        absent: cases that the manifest does not name.
        sealed: how many it names; ``not_scored``: those of them that have no line of results.
    """

    manifest: str | None
    set: str = ""
    seal: str = ""
    holds: tuple[str, ...] = ()
    broken: tuple[str, ...] = ()
    remade: tuple[str, ...] = ()
    absent: tuple[str, ...] = ()
    sealed: int = 0
    not_scored: tuple[str, ...] = ()

    def sentence(self) -> str:
        """For the reader of a table."""
        if self.manifest is None:
            return "No manifest: these answers were not sealed."
        text = f"Seals checked against `{self.manifest}`"
        text += f" ({self.seal[:16]})" if self.seal else ""
        text += f": {len(self.holds)} hold"
        text += f", {len(self.broken)} broken" if self.broken else ", none broken"
        # Recordings repeat byte for byte on one kind of processor only.
        text += (f", {len(self.remade)} with the sealed answer and other recordings"
                 if self.remade else "")
        text += f", {len(self.absent)} cases not in it" if self.absent else ""
        return text + (f"; {len(self.not_scored)} of {self.sealed} sealed cases are not scored."
                       if self.not_scored else ".")


def file_hash(path: Path) -> str:
    """SHA-256 of a file's bytes."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


def folder_hash(folder: Path) -> str:
    """SHA-256 over names and hashes of the folder's files, in order of name: all that a case is."""
    total = hashlib.sha256()
    for path in sorted([*folder.glob("*.csv"), *folder.glob(LIBRARY)]):
        total.update(f"{path.name} {file_hash(path)}\n".encode())
    return total.hexdigest()


def find_manifest(root: Path, name: str = "") -> Path | None:
    """The published manifest of the set that lies in a folder, else the one beside its cases.

    Args:
        root: folder of the set.
        name: the set's name; by default what the manifest beside the cases says.

    Raises:
        InputError: the manifest beside the cases cannot be read.
    """
    beside = root / MANIFEST
    if not name and beside.is_file():
        name = str(_read(beside).get("set", ""))
    published = _published(name)
    return published or (beside if beside.is_file() else None)


def _published(name: str) -> Path | None:
    """The manifest that ships with the proving ground, found without importing it."""
    spec = find_spec("proving_ground")
    for folder in (spec.submodule_search_locations or ()) if spec and name else ():
        path = Path(folder) / "sealed" / f"{name}.json"
        if path.is_file():
            return path
    return None


def _read(manifest: Path) -> dict[str, Any]:
    try:
        tree = json.loads(manifest.read_text(encoding="utf-8"))
        cases = tree["cases"].items()
        total = "".join(f"{case} {hashes['answer_sha256']}\n" for case, hashes in cases)
    except (OSError, AttributeError, KeyError, TypeError, json.JSONDecodeError) as error:
        raise InputError(f"not a manifest: {error!r}", file=manifest,
                         expected="JSON with the hashes of all cases") from error
    if tree.get("seal", "") not in ("", hashlib.sha256(total.encode()).hexdigest()):
        raise InputError("the seal is not that of the cases listed", file=manifest,
                         expected="the manifest as it was written")
    return dict(tree)


def check_seals(cases: Sequence[Case], manifest: Path | None,
                scored: Collection[str] | None = None) -> SealCheck:
    """Compare cases with a manifest.

    ``scored``: ids of the cases that have a line of results; None: all have.

    Raises:
        InputError: the manifest cannot be read, or contradicts itself.
    """
    if manifest is None:
        return SealCheck(None)
    return check_hashes({case.id: (file_hash(case.answer), folder_hash(case.folder))
                         for case in cases}, manifest, scored)


def check_hashes(hashes: Mapping[str, tuple[str, str]], manifest: Path,
                 scored: Collection[str] | None = None) -> SealCheck:
    """The same by the hashes of answer and recordings of each case.

    Raises:
        InputError: the manifest cannot be read, or contradicts itself.
    """
    sealed = _read(manifest)
    found: dict[str, list[str]] = {"holds": [], "broken": [], "remade": [], "absent": []}
    for case, own in hashes.items():
        found[_state(own, sealed["cases"].get(case))].append(case)
    have = set(hashes) if scored is None else set(scored)
    return SealCheck(str(manifest), str(sealed.get("set", "")), str(sealed.get("seal", "")),
                     sealed=len(sealed["cases"]),
                     not_scored=tuple(sorted(set(sealed["cases"]) - have)),
                     **{state: tuple(ids) for state, ids in found.items()})


def _state(own: tuple[str, str], hashes: Mapping[str, str] | None) -> str:
    if hashes is None:
        return "absent"
    if hashes.get("answer_sha256") != own[0]:
        return "broken"
    return "holds" if hashes.get("recordings_sha256") == own[1] else "remade"

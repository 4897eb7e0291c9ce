"""Sealing: hashes of the answers, published before a scored run so that no answer can move.

A manifest names every case with the SHA-256 of its answer file and of its recordings, and one
hash over all answers. It tells nothing about an answer; anyone can check that the answers shown
afterwards are those of before.
"""

from __future__ import annotations

import hashlib
import json
from pathlib import Path
from typing import Any

MANIFEST = "manifest.json"
LIBRARY = "library.json"


def file_hash(path: Path) -> str:
    """SHA-256 of a file's bytes."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


def folder_hash(folder: Path) -> str:
    """SHA-256 over names and hashes of a folder's files, in order of name: all that a case is."""
    total = hashlib.sha256()
    for path in sorted([*folder.glob("*.csv"), *folder.glob(LIBRARY)]):
        total.update(f"{path.name} {file_hash(path)}\n".encode())
    return total.hexdigest()


def make_manifest(out: Path, name: str) -> dict[str, Any]:
    """The manifest of all finished cases below `out`."""
    cases = {}
    for answer in sorted((out / "answers").glob("*.json")):
        cases[answer.stem] = {"answer_sha256": file_hash(answer),
                              "recordings_sha256": folder_hash(out / "cases" / answer.stem)}
    total = hashlib.sha256()
    for case, hashes in cases.items():
        total.update(f"{case} {hashes['answer_sha256']}\n".encode())
    return {"set": name, "count": len(cases), "seal": total.hexdigest(), "cases": cases}


def write_manifest(out: Path, name: str, to: Path | None = None) -> Path:
    """Write the manifest beside the cases, or to a place where it is published."""
    path = to or out / MANIFEST
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(make_manifest(out, name), indent=1) + "\n", encoding="utf-8")
    return path


def broken_seals(out: Path, manifest: Path) -> list[str]:
    """Cases whose answer or recordings differ from a manifest, or are absent."""
    sealed = json.loads(manifest.read_text(encoding="utf-8"))
    now = make_manifest(out, sealed["set"])["cases"]
    return [case for case, hashes in sealed["cases"].items() if now.get(case) != hashes]

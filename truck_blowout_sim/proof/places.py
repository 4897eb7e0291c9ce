"""Where a repository keeps what it publishes of the proof.

Validated with: test/proof/test_archive.py (the published answers are where the pages come from).
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Places:
    """Of one world below the repository's ``root``.

    Attributes:
        root: folder with ``docs`` and ``proving_ground``.
        world: its name, as ``w1``.
    """

    root: Path
    world: str

    @property
    def manifest(self) -> Path:
        """Seals of the present draw."""
        return self.root / "proving_ground" / "sealed" / f"sealed_{self.world}.json"

    @property
    def answers(self) -> Path:
        """Raw answers, see `archive.py`."""
        return self.root / "docs" / f"proof_{self.world}_answers.jsonl.xz"

    @property
    def again(self) -> Path:
        """Raw answers of later code to the same cases; not all were diagnosed again."""
        return self.root / "docs" / f"proof_{self.world}_again.jsonl.xz"

    @property
    def later_manifest(self) -> Path:
        """Seals of a smaller draw, made for later code."""
        return self.root / "proving_ground" / "sealed" / f"later_{self.world}.json"

    @property
    def later(self) -> Path:
        """Raw answers of that code to that draw."""
        return self.root / "docs" / f"proof_{self.world}_later.jsonl.xz"

    @property
    def cases(self) -> Path:
        """Table of cases and what was answered."""
        return self.root / "docs" / f"proof_{self.world}_cases.csv"

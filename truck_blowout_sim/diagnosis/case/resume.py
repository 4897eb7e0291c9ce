"""Finished simulations kept on disk, so that an interrupted diagnosis continues where it was.

A diagnosis asks for the same simulations in the same order whenever it is given the same; they are
all its time. So nothing else need be kept. One file, only ever appended to: a line that says of
which case it is, then a record a simulation (key, shape, numbers, checksum). What a kill or a full
disk cut off does not match its checksum and is dropped at the next start.

Validated with: test/diagnosis/test_resume.py.
"""

from __future__ import annotations

import contextlib
import json
import os
import struct
import zlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import BinaryIO, Protocol

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.case.fingerprints import KEY_SIZE, simulation_key
from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.case.simulations import Job, known_or_abreast
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
Say = Callable[[str], None]
_HEAD = struct.Struct(f"<{KEY_SIZE}sII")
_CHECK = struct.Struct("<I")
_FILE = "simulations"


class Keeps(Protocol):
    """Whatever knows simulations of a case that need not be made again."""

    def begin(self, case: Mapping[str, str]) -> None:
        """Told which case it is, by the hashes of what decides an answer."""

    def simulated(self, run: Run, truck: Packed) -> Floats:
        """Bin means of a truck over a run, the same bits as :meth:`Run.simulated`."""

    def simulated_abreast(self, jobs: Sequence[Job]) -> list[Floats]:
        """Bin means of up to eight, the same bits as `simulations.simulated_abreast`."""


@dataclass(eq=False)
class Kept:
    """The simulations of one case in one folder.

    Attributes:
        folder: where; made by :meth:`begin`.
        say: told in one line whether it continues or starts anew, and why.
    """

    folder: Path
    say: Say = lambda line: None
    _file: int = -1
    _places: dict[bytes, tuple[int, int, int]] = field(default_factory=dict)

    @property
    def begun(self) -> bool:
        """Whether there is a case, and so something that the next start takes up."""
        return self._file >= 0

    def begin(self, case: Mapping[str, str]) -> None:
        """Take up what is kept of this very case, or start anew.

        Args:
            case: hashes of what decides an answer, by the word for it.

        Raises:
            OSError: the folder cannot be written.
        """
        self.folder.mkdir(parents=True, exist_ok=True)
        path = self.folder / _FILE
        line = json.dumps(dict(case)).encode() + b"\n"
        end = self._take_up(path, line)
        self._file = os.open(path, os.O_RDWR | os.O_APPEND | os.O_CREAT, 0o644)
        os.ftruncate(self._file, end)
        if not end:
            os.write(self._file, line)

    def simulated(self, run: Run, truck: Packed) -> Floats:
        """Bin means of a truck over a run: those kept, else simulated and kept."""
        key = simulation_key(run, truck)
        if key in self._places:
            return self._read(key)
        bins = run.simulated(truck)
        self._add(key, bins)
        return bins

    def simulated_abreast(self, jobs: Sequence[Job]) -> list[Floats]:
        """Bin means of up to eight: those kept, the others simulated abreast and kept."""
        return known_or_abreast(jobs, lambda key: self._read(key) if key in self._places else None,
                                self._add)

    def close(self, *, forget: bool = False) -> None:
        """Let go of the file; ``forget``: remove it, and the folder if nothing else is in it."""
        if self._file >= 0:
            os.close(self._file)
            self._file = -1
        if forget:
            (self.folder / _FILE).unlink(missing_ok=True)
            with contextlib.suppress(OSError):
                self.folder.rmdir()

    def _take_up(self, path: Path, line: bytes) -> int:
        """Learn where the records of a file are; the size of what can be used of it."""
        if not path.is_file():
            return 0
        with path.open("rb") as file:
            first = file.readline()
            if first != line:
                if changed := _changed(first, line):
                    self.say(f"{self.folder} was kept for other {changed}: starting anew")
                return 0
            end = len(first)
            for key, at, n, m in _records(file):
                self._places[key] = (at, n, m)
                end = at + 8 * n * m + _CHECK.size
        if self._places:
            self.say(f"continuing an interrupted diagnosis: {len(self._places)} simulations "
                     f"are kept in {self.folder}")
        return end

    def _read(self, key: bytes) -> Floats:
        """What is kept of a simulation."""
        at, n, m = self._places[key]
        raw = os.pread(self._file, 8 * n * m, at)
        return np.frombuffer(raw, dtype=np.float64).reshape(n, m).copy()

    def _add(self, key: bytes, bins: Floats) -> None:
        """Append a record in one write, which threads cannot mix; no disk is worth an answer."""
        if self._file < 0:
            return
        body = _HEAD.pack(key, *bins.shape) + np.ascontiguousarray(bins).tobytes()
        with contextlib.suppress(OSError):
            os.write(self._file, body + _CHECK.pack(zlib.crc32(body)))


@contextlib.contextmanager
def keeping(folder: Path, say: Say = lambda line: None) -> Iterator[Kept]:
    """Keep simulations in a folder while the body runs; remove them when it has succeeded."""
    kept = Kept(folder, say)
    try:
        yield kept
        kept.close(forget=True)
    finally:
        kept.close()


def _records(file: BinaryIO) -> Iterator[tuple[bytes, int, int, int]]:
    """Key, place of the numbers and shape of each sound record, up to the first that is not."""
    while len(head := file.read(_HEAD.size)) == _HEAD.size:
        key, n, m = _HEAD.unpack(head)
        at = file.tell()
        left = os.fstat(file.fileno()).st_size - at
        if 8 * n * m + _CHECK.size > left:
            return
        numbers, check = file.read(8 * n * m), file.read(_CHECK.size)
        if _CHECK.pack(zlib.crc32(numbers, zlib.crc32(head))) != check:
            return
        yield key, at, n, m


def _changed(old: bytes, new: bytes) -> str:
    """Words for the parts in which two cases differ; empty if the old one cannot be read."""
    try:
        before, now = json.loads(old), json.loads(new)
        return " and ".join(word for word in now if before.get(word) != now[word])
    except (ValueError, AttributeError):
        return ""

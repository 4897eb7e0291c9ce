"""Hashes of what goes into a diagnosis: the same digits for the same bits, any change shows.

Validated with: test/diagnosis/test_resume.py.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields
from functools import lru_cache

import numpy as np

from truck_blowout_sim import __version__
from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.settings import Settings
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.resources import code_hash
from truck_blowout_sim.vehicle import Packed

KEY_SIZE = 16


def case_parts(recordings: Mapping[str, Sequence[Recording]], packed: Packed, settings: Settings,
               options: Sequence[object]) -> dict[str, str]:
    """One hash for each part that decides an answer, by the word a person is told.

    Args:
        recordings: by role; ``options``: whatever else was asked for.
    """
    measured = [part for role, group in recordings.items() for one in group
                for part in (role, *_parts_of(one))]
    return {
        "recordings": _digest(measured).hex(),
        "vehicle": _digest([*_truck(packed), repr(packed.index), packed.vehicle.name]).hex(),
        "settings": _digest([repr(settings)]).hex(),
        "options": _digest([repr(tuple(options))]).hex(),
        "program version": f"{__version__} {code_hash()}",
    }


def simulation_key(run: Run, truck: Packed, *, abreast: bool = False) -> bytes:
    """Key of a truck's bin means over a run: a hash of all that they follow from.

    A fraction of a millisecond, where the simulation takes tens. ``abreast``: it went as one of
    eight, which rounds otherwise, from the instant on at which these left their driven trucks.
    """
    since_s = run.since_s if abreast and run.course else -np.inf
    return _digest([_driven(run), *_truck(truck), abreast, since_s])


@lru_cache(maxsize=64)
def _driven(run: Run) -> bytes:
    """Hash of what drives a run and how its bins are made; one that is asked again is known."""
    drive, initial = run.drive, run.drive.initial
    parts = [getattr(drive, f.name) for f in fields(drive) if f.name != "initial"]
    return _digest([*parts, repr(initial), run.edges_s, run.correction, repr(run.columns),
                    repr(run.leaning)])


def _truck(packed: Packed) -> tuple[object, ...]:
    return packed.params, packed.topology


def _parts_of(recording: Recording) -> Iterator[object]:
    yield from (recording.name, repr(recording.blowouts), repr(sorted(recording.metadata.items())))
    for name in sorted(recording.channels):
        yield from (name, recording[name].time_s, recording[name].value)


def _digest(parts: Sequence[object]) -> bytes:
    """Hash of arrays by their bits and of everything else by its text, each with its kind."""
    total = hashlib.blake2b(digest_size=KEY_SIZE)
    for part in parts:
        if isinstance(part, np.ndarray):
            total.update(f"{part.dtype.str}{part.shape}".encode())
            total.update(np.ascontiguousarray(part).data)
        else:
            text = str(part).encode()
            total.update(f"text {len(text)}".encode() + text)
    return total.digest()

"""What the files of a study amount to: another digest where an edit would give other runs."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields

import numpy as np

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.simulation.studies.cases import Study
from truck_blowout_sim.simulation.studies.design import Axis, Value

_DIGITS = 12


def contents_hash(study: Study, axes: Sequence[Axis]) -> str:
    """Twelve digits of all that scenario, vehicle, road, tire and blowout files say.

    Of a case without any change, and of one for each varied word, as it may name another file.
    """
    words = [{axis.key: value} for axis in axes for value in axis.values if isinstance(value, str)]
    total = hashlib.sha256()
    for values in ({}, *words):
        for part in _parts(study, values):
            total.update(part)
    return total.hexdigest()[:_DIGITS]


def _parts(study: Study, values: Mapping[str, Value]) -> Iterator[bytes]:
    """The truck, the scenario and what drives a case, as bytes."""
    try:
        packed, scenario, drive = study.prepared(values)
    except InputError as error:
        yield str(error).encode()
        return
    yield packed.params.tobytes()
    yield packed.topology.tobytes()
    yield repr(scenario.spec).encode()
    for one in fields(drive):
        part = getattr(drive, one.name)
        yield part.tobytes() if isinstance(part, np.ndarray) else repr(part).encode()

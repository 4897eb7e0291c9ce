"""Whether a case fits into memory: its sensitivities grow with the square of the number of runs.

Each run has rows of its own, and a column for its start speed over the rows of all others.
"""

from __future__ import annotations

import os

import numpy as np

from truck_blowout_sim.diagnosis.case.study import Study, instrument_names
from truck_blowout_sim.errors import InputError

_COPIES = 4  # of the sensitivities: run by run, joined, joined with the unseen runs, weighed
_GB = 1e9


def sensitivities_bytes(study: Study) -> int:
    """Size of the sensitivities of all runs, unseen ones too."""
    runs = (*study.runs, *study.holdout)
    columns = len(study.settings.nuisances) + len(runs) + len(instrument_names(study))
    return sum(run.measured.size for run in runs) * columns * np.dtype(np.float64).itemsize


def check_memory(study: Study) -> None:
    """Refuse a case that this machine cannot hold.

    Raises:
        InputError: says how much it needs, and what makes it smaller.
    """
    need, have = _COPIES * sensitivities_bytes(study), machine_bytes()
    if have is not None and need > have:
        count = len(study.runs) + len(study.holdout)
        raise InputError(
            f"{count} runs need about {need / _GB:.3g} GB of memory",
            expected=f"less than the {have / _GB:.3g} GB of this machine: half as many runs need a "
            "quarter; shorter runs or fewer channels help, too")


def machine_bytes() -> int | None:
    """Memory of this machine; None where the system does not say."""
    try:
        return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (AttributeError, OSError, ValueError):
        return None

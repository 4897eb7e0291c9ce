"""Recordings that cannot be used, or not together, are bad input and no program failure."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import wraps
from itertools import combinations
from typing import ParamSpec, TypeVar

import numpy as np

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Recording

Arguments = ParamSpec("Arguments")
Result = TypeVar("Result")
_NOT_FINITE = ("infs or NaNs", "NaN", "not finite")


def determined(function: Callable[Arguments, Result]) -> Callable[Arguments, Result]:
    """Turn a system of equations without solution into one clear line.

    Raises:
        InputError: the recordings leave a matrix singular or not finite.
    """

    @wraps(function)
    def asked(*args: Arguments.args, **kwargs: Arguments.kwargs) -> Result:
        try:
            return function(*args, **kwargs)
        except (np.linalg.LinAlgError, ArithmeticError) as error:
            raise _unusable(error) from error
        except ValueError as error:
            if any(words in str(error) for words in _NOT_FINITE):
                raise _unusable(error) from error
            raise

    return asked


def check_each_once(roles: Mapping[str, Sequence[Recording]]) -> None:
    """Refuse a run that is given twice, under whatever name.

    Twice in a role it would count double; in two roles it would be predicted by its own fit.

    Args:
        roles: what is done with the runs, and the runs.

    Raises:
        InputError: two of them hold the same samples.
    """
    given = [(role, run) for role, runs in roles.items() for run in runs]
    for (role, run), (other_role, other) in combinations(given, 2):
        if run.channels and dict(run.channels) == dict(other.channels):
            raise InputError(f"is given twice: {role} as {run.name}, {other_role} as {other.name}",
                             file=other.name, expected="each run once")  # fmt: skip


def _unusable(error: Exception) -> InputError:
    return InputError(
        f"the recordings do not determine a solution ({error})",
        expected="channels that vary, with finite values of a size that a vehicle can have",
    )

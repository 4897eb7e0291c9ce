"""Recordings that the algebra cannot use are bad input and no failure of the program."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import ParamSpec, TypeVar

import numpy as np

from truck_blowout_sim.errors import InputError

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


def _unusable(error: Exception) -> InputError:
    return InputError(
        f"the recordings do not determine a solution ({error})",
        expected="channels that vary, with finite values of a size that a vehicle can have",
    )

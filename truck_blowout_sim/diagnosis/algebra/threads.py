"""One thread for linear algebra.

The matrices of a diagnosis are small: BLAS threads wait for each other in every product, and take
the cores from the simulations. With one of them an answer took 0.4 to 0.6 of the time on two cores;
the check of the instruments takes half of the processor time, and little less wall time alone.

Known limits: the limit holds for the whole process while the function runs. Where threadpoolctl is
not installed, nothing is limited.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from functools import wraps
from typing import ParamSpec, TypeVar

try:
    from threadpoolctl import threadpool_limits
except ImportError:
    threadpool_limits = None

Arguments = ParamSpec("Arguments")
Result = TypeVar("Result")


def one_blas_thread(function: Callable[Arguments, Result]) -> Callable[Arguments, Result]:
    """Run a function with BLAS on one thread."""

    @wraps(function)
    def limited(*args: Arguments.args, **kwargs: Arguments.kwargs) -> Result:
        limit: AbstractContextManager[object] = (
            threadpool_limits(limits=1, user_api="blas") if threadpool_limits else nullcontext())
        with limit:
            return function(*args, **kwargs)

    return limited

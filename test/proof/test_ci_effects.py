"""Half of the cases of the `ci` set whose truck lacks one thing, from truth to table."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

# Least number of cases solved, verdict and names; one less than when this was written may pass.
LEAST = {"single": 3}


@pytest.mark.timeout(1800)
def test_what_the_truck_lacks_is_named(
    prove_ci: Callable[..., dict[str, Any]],
    solved: Callable[[dict[str, Any]], tuple[dict[str, int], list[str]]],
) -> None:
    reached, told = solved(prove_ci("single"))
    assert reached["single"] >= LEAST["single"], told

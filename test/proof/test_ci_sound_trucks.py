"""Half of the cases of the `ci` set whose truck lacks nothing of the library, from truth to table.

Nothing is missing, an instrument is at fault, or what acts is of no list.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

# Least number of cases solved, verdict and names; one less than when this was written may pass.
LEAST = {"null": 2, "sensor": 1, "all": 5}


@pytest.mark.timeout(1800)
def test_no_effect_is_named_where_none_acts(
    prove_ci: Callable[..., dict[str, Any]],
    solved: Callable[[dict[str, Any]], tuple[dict[str, int], list[str]]],
) -> None:
    reached, told = solved(prove_ci("null", "sensor", "unknown"))
    assert {group: reached[group] for group in LEAST if reached[group] < LEAST[group]} == {}, told

"""`python -m benchmarks`: speed of the core; `python -m benchmarks.nodes`: of the nodes."""

from __future__ import annotations

from benchmarks.core import main
from benchmarks.page import start_function

if __name__ == "__main__":
    start_function(main)

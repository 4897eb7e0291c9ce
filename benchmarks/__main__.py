"""`python -m benchmarks`: speed of the core; `python -m benchmarks.nodes`: of the nodes."""

from __future__ import annotations

from benchmarks.core import main

if __name__ == "__main__":
    main()

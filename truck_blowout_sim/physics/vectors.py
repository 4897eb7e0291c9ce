"""Vector instructions for the pass over all tires.

LLVM weighs a loop instruction by instruction. With registers of 512 bits it compiles the pass to
vectors of eight doubles; with 256 bits it expects no gain from four and keeps the pass scalar,
although vectors make a step twice as fast. Told that every instruction costs the same, it takes
the widest vectors that the processor has.

References: LLVM, "Auto-Vectorization in LLVM"; ``opt --help-hidden``.
Known limits: the setting holds for all that Numba compiles in this process from then on, the
user's own functions included; it changes how loops are compiled and not what they compute.
Validated with: test/physics/test_jit.py.
"""

from __future__ import annotations

from functools import cache

import llvmlite.binding as llvm


@cache
def prefer_vectors() -> None:
    """Let LLVM use vectors in every loop that allows them; it takes the setting once."""
    llvm.set_option("truck_blowout_sim", "-force-target-instruction-cost=1")

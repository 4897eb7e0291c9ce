"""The worlds in which a diagnosis must hold: who drives what, and how it is recorded.

`w1` is the truck of the first world, `w2` a truck of a form of its own, `w3` a car of another
simulator, `w4` any of them recorded as roughly as real logs are. Cases of a world are numbered from
0; a case is repeatable from its world and number.
"""

from __future__ import annotations

from proving_ground.worlds.draws import CYCLE
from proving_ground.worlds.table import FIRST_SEED, WORLDS, world_cases

__all__ = ["CYCLE", "FIRST_SEED", "WORLDS", "world_cases"]

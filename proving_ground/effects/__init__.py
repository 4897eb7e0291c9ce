"""Concealed effects by name: what each sets in the truck, how strong, and where it may sit.

`LISTED` holds the canonical names, `FAMILIES` which of them belong together; `UNLISTED` holds
effects that no list names.
"""

from __future__ import annotations

from proving_ground.effects.base import Active, EffectKind, Place
from proving_ground.effects.brakes import BRAKES
from proving_ground.effects.families import FAMILIES
from proving_ground.effects.outside import OUTSIDE
from proving_ground.effects.running_gear import GEAR, RUNNING_GEAR
from proving_ground.effects.tires import TIRES_EFFECTS
from proving_ground.effects.unlisted import UNLISTED

LISTED: dict[str, EffectKind] = {
    kind.name: kind for kind in (*TIRES_EFFECTS, *RUNNING_GEAR, *BRAKES, *OUTSIDE, *GEAR)
}
# The sealed tables walk these in this order; names that came later are drawn by the worlds.
IN_TABLES = tuple(kind.name for kind in (*TIRES_EFFECTS, *RUNNING_GEAR, *BRAKES, *OUTSIDE))

__all__ = ["FAMILIES", "IN_TABLES", "LISTED", "UNLISTED", "Active", "EffectKind", "Place"]

"""A begun mapping as the text of a YAML file, every guess marked.

Validated with: test/recordings/test_bring_your_own_log.py.
"""

from __future__ import annotations

import json

from truck_blowout_sim.recordings.mapping.inventory import Further, Inventory
from truck_blowout_sim.recordings.mapping.proposing import Proposal
from truck_blowout_sim.recordings.units import not_known

_YAML_WORDS = ("y", "n", "yes", "no", "on", "off", "true", "false", "null")
_HEAD = """\
# A mapping begun for {file} by `truck-blowout inspect --write-map`.
# Every line marked GUESS was guessed: read it, correct it, then use it:
#   truck-blowout compare {file} --map THIS_FILE
# value = sign * (number + offset), then converted from `unit` to SI.
# Axes: x forward, y left, z up; yaw, yaw rate and hand wheel to the left are positive.
"""
_UNSTATED = "  # GUESS: its unit is not stated"
_NOTHING = "  # {}: nothing was recognized; e.g. tractor_vx_mps: {{from: COLUMN, unit: km/h}}\n"
_GRAVITY_REMOVED = ("metadata: {accelerometers: gravity removed}"
                    "  # GUESS: the vertical acceleration is 0 in the mean\n")
_TAIL = """
# Where the log does not mark the tire that lost its air:
# blowouts: [{tire: steer_left, at_s: 4.92}]
# A clock known to be off:    shift_s: {COLUMN_OR_TOPIC: -0.2}
# Another file of this test:  also: [steering.csv]
# Recorded, but no measurement: exclude: [tractor_roll_rad]
# Where an instrument sits, seen from base_link: sensors: {tractor: {x_m: -1.2, z_m: 0.4}}
"""


def mapping_text(inventory: Inventory) -> str:
    """The mapping file that `inspect --write-map` writes."""
    out = [_HEAD.format(file=inventory.file)]
    out.append(_main_time(inventory))
    out += ["also:\n"] * bool(inventory.further) + [_also(one) for one in inventory.further]
    out.append("channels:" + ("\n" if inventory.proposals else " {}\n"))
    out += [_entry(proposal) for proposal in inventory.proposals]
    if not inventory.proposals:
        out.append(_NOTHING.format("channels"))
    if inventory.gravity_removed:
        out.append(_GRAVITY_REMOVED)
    out.append(_TAIL)
    unused = [line for line in inventory.lines if not line.channel]
    if unused:
        out.append("\n# Not used:\n")
        out += [f"#   {line.name}{f' [{line.unit}]' if line.unit else ''}:"
                f" {line.low:g} to {line.high:g}\n" for line in unused]  # fmt: skip
    return "".join(out)


def _main_time(inventory: Inventory) -> str:
    column, unit = inventory.time_guess or (inventory.time_column, inventory.time_unit)
    if not column:
        return ""
    guess = "  # GUESS: from the steps" if inventory.time_guess else (
        _UNSTATED if inventory.time_guessed else "")  # fmt: skip
    words, guess = _time(column, unit, inventory.unknown_time_unit, guess)
    return f"time: {words}{guess}\n"


def _time(column: str, unit: str, unknown: str, guess: str) -> tuple[str, str]:
    """Entry and comment; without a unit where the log's is not known: the reader asks for it."""
    if unknown:
        return f"{{from: {_text(column)}}}", f"  # GUESS: {not_known(unknown)}"
    stated = "" if unit == "clock" else f", unit: {unit or 's'}"
    return f"{{from: {_text(column)}{stated}}}", guess


def _also(further: Further) -> str:
    if not further.time_column:
        return f"  - {{file: {_text(further.file)}}}\n"
    words, guess = _time(further.time_column, further.time_unit, further.unknown_time_unit,
                         _UNSTATED if further.guessed else "")  # fmt: skip
    return f"  - {{file: {_text(further.file)}, time: {words}}}{guess}\n"


def _entry(proposal: Proposal) -> str:
    parts = [f"from: {_text(proposal.column)}"]
    if proposal.file:
        parts.append(f"file: {_text(proposal.file)}")
    if proposal.unit:
        parts.append(f"unit: {_text(proposal.unit)}")
    if proposal.sign != 1.0:
        parts.append(f"sign: {proposal.sign:g}")
    if proposal.offset:
        parts.append(f"offset: {proposal.offset:g}")
    if proposal.radius_m:
        parts.append(f"radius_m: {proposal.radius_m:g}")
    return f"  {proposal.channel}: {{{', '.join(parts)}}}  # GUESS: {'; '.join(proposal.why)}\n"


def _text(value: str) -> str:
    """As YAML reads it back as the same text: plain where that is safe, else quoted."""
    plain = value.replace("_", "").replace(".", "").replace("/", "")
    safe = plain.isalnum() and value[0].isalpha() and value.lower() not in _YAML_WORDS
    return value if safe else json.dumps(value, ensure_ascii=False)

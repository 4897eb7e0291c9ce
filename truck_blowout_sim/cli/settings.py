"""Words of the command line that change a vehicle: `NAME=VALUE`."""

from __future__ import annotations

from collections.abc import Sequence

from truck_blowout_sim.errors import InputError, quoted
from truck_blowout_sim.vehicle import Packed
from truck_blowout_sim.vehicle.document import Place
from truck_blowout_sim.vehicle.packing.bounds import number_of


def set_values(truck: Packed, words: Sequence[str]) -> Packed:
    """A copy of a truck with ``NAME=VALUE`` words set.

    A value is a number in SI, or the word a file would have: ``tire.steer_left.model=linear``.

    Raises:
        InputError: a word of another form, no such parameter, or a value it cannot have.
    """
    for word in words:
        name, sign, text = (part.strip() for part in word.partition("="))
        if not (name and sign):
            raise InputError(f"--set {quoted(word)}", expected="NAME=VALUE")
        try:
            block = truck.block(name)
            number = number_of(block, name.rpartition(".")[2], text, Place("", 0, ""))
            truck = truck.with_values({name: number})
        except InputError as error:
            raise InputError(f"--set {quoted(word)}: {error.problem}", expected=error.expected
                             ) from None
    return truck

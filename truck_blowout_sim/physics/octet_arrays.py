# mypy: disable-error-code="no-untyped-call,untyped-decorator"
"""Arrays of octets: numpy arrays whose last axis is the eight trucks, as compiled code sees them.

References: Numba manual, "Low-level extension API".
Known limits: compiled code takes arrays of `room_for_eight` alone, which lie where vectors must.
Validated with: test/simulation/test_abreast.py.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar, cast

import numpy as np
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic
from numpy.typing import NDArray

from truck_blowout_sim.physics.octet import EIGHT, octet

Floats = NDArray[np.float64]
Array = TypeVar("Array", bound=NDArray[Any])
_BYTES = 8 * EIGHT


def room_for_eight(*shape: int, value: float = 0.0) -> Floats:
    """An array [*shape, 8] that begins on a whole vector, all of one value."""
    count = int(np.prod(shape)) * EIGHT
    raw = np.full(count + EIGHT, value)
    first = -raw.ctypes.data % _BYTES // raw.itemsize
    return raw[first:first + count].reshape(*shape, EIGHT)


@intrinsic
def _view(_context: Any, array: Any) -> Any:
    """In compiled code: an array [*shape, 8] of floats as an array [*shape] of octets."""
    seen = types.Array(octet, array.ndim - 1, "C")

    def view(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        have = context.make_array(array)(context, builder, args[0])
        made = context.make_array(seen)(context, builder)
        shape = cgutils.unpack_tuple(builder, have.shape, array.ndim)[:-1]
        strides = cgutils.unpack_tuple(builder, have.strides, array.ndim)[:-1]
        word = context.get_value_type(types.intp)
        made.data = builder.bitcast(have.data, made.data.type)
        made.nitems = builder.sdiv(have.nitems, word(EIGHT))
        made.itemsize = word(_BYTES)
        made.shape = cgutils.pack_array(builder, shape)
        made.strides = cgutils.pack_array(builder, strides)
        # the caller holds the array
        made.meminfo = cgutils.get_null_value(made.meminfo.type)
        made.parent = cgutils.get_null_value(made.parent.type)
        return made._getvalue()

    if not isinstance(array, types.Array) or array.layout != "C" or array.dtype != types.float64:
        return None
    return seen(array), view


@intrinsic
def _unowned(_context: Any, array: Any) -> Any:
    """In compiled code: the same array without its owner."""
    def bare(context: Any, builder: Any, _signature: Any, args: Any) -> Any:
        made = context.make_array(array)(context, builder, args[0])
        made.meminfo = cgutils.get_null_value(made.meminfo.type)
        made.parent = cgutils.get_null_value(made.parent.type)
        return made._getvalue()

    return (array(array), bare) if isinstance(array, types.Array) else None


octets = cast("Callable[[Floats], Floats]", _view)
# an array whose parts cost nothing to take: nobody counts who holds them. The caller holds it all
bare = cast("Callable[[Array], Array]", _unowned)

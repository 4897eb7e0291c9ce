# mypy: disable-error-code="no-untyped-call,untyped-decorator"
"""A number for each of eight trucks, in one vector register: what the step works on abreast.

To the compiler an ``Octet`` is a number like any other: the source of the step, given octets where
it usually gets floats, is compiled a second time. Comparisons give a ``Mask``, a truth for each of
the eight, which branches only through `choose`.

References: Numba manual, "Low-level extension API"; LLVM language reference, "Vector Type".
Known limits: what has no instruction (atan2, asin) is called once for each truck.
Validated with: test/physics/test_choose.py, test/simulation/test_abreast.py.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable
from functools import partial
from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.core.typeconv.castgraph import Conversion
from numba.core.typing.templates import AbstractTemplate, Signature, infer_global, signature
from numba.extending import lower_builtin, lower_cast, models, register_model

EIGHT = 8
VECTOR = ir.VectorType(ir.DoubleType(), EIGHT)
TRUTHS = ir.VectorType(ir.IntType(1), EIGHT)
_COMPARED = {operator.lt: "<", operator.le: "<=", operator.gt: ">", operator.ge: ">=",
             operator.eq: "==", operator.ne: "!="}
_ARITHMETIC = {operator.add: "fadd", operator.sub: "fsub", operator.mul: "fmul",
               operator.truediv: "fdiv", operator.iadd: "fadd", operator.isub: "fsub",
               operator.imul: "fmul", operator.itruediv: "fdiv"}
_LOGIC = {operator.and_: "and_", operator.or_: "or_"}
_ONE_BY_ONE = {math.atan2: 2, math.asin: 1, math.tanh: 1}


class Octet(types.Type):
    """Eight float64, one a truck."""

    def __init__(self) -> None:
        super().__init__("octet")

    def can_convert_from(self, _context: Any, other: Any) -> Any:
        """A number is the same number for every truck."""
        return Conversion.safe if isinstance(other, (types.Float, types.Integer)) else None

    def unify(self, _context: Any, other: Any) -> Any:
        """What is a number here and an octet there is an octet."""
        return self if isinstance(other, (Octet, types.Float, types.Integer)) else None


class Mask(types.Type):
    """Eight truths, one a truck."""

    def __init__(self) -> None:
        super().__init__("mask")

    def can_convert_from(self, _context: Any, other: Any) -> Any:
        """A truth holds for every truck."""
        return Conversion.safe if isinstance(other, types.Boolean) else None

    def unify(self, _context: Any, other: Any) -> Any:
        """What is a truth here and a mask there is a mask."""
        return self if isinstance(other, (Mask, types.Boolean)) else None


octet, mask = Octet(), Mask()


@register_model(Octet)
class _OctetModel(models.PrimitiveModel):
    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, VECTOR)


@register_model(Mask)
class _MaskModel(models.PrimitiveModel):
    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, TRUTHS)


def spread(builder: Any, value: Any, kind: Any) -> Any:
    """The same value in all eight places."""
    vector = builder.insert_element(ir.Constant(kind, ir.Undefined), value,
                                    ir.Constant(ir.IntType(32), 0))
    zeros = ir.Constant(ir.VectorType(ir.IntType(32), EIGHT), None)
    return builder.shuffle_vector(vector, ir.Constant(kind, ir.Undefined), zeros)


def places() -> list[Any]:
    """The eight places as constants."""
    return [ir.Constant(ir.IntType(32), k) for k in range(EIGHT)]


def vector_call(builder: Any, name: str, *values: Any) -> Any:
    """Call an intrinsic that takes and gives octets, such as ``llvm.sqrt``."""
    kind = ir.FunctionType(VECTOR, [VECTOR] * len(values))
    return builder.call(cgutils.get_or_insert_function(builder.module, kind, f"{name}.v8f64"),
                        values)


@lower_cast(types.Float, Octet)
@lower_cast(types.Integer, Octet)
def _number_to_octet(context: Any, builder: Any, kind: Any, _to: Any, value: Any) -> Any:
    return spread(builder, context.cast(builder, value, kind, types.float64), VECTOR)


@lower_cast(types.Boolean, Mask)
def _truth_to_mask(_context: Any, builder: Any, _kind: Any, _to: Any, value: Any) -> Any:
    return spread(builder, value, TRUTHS)


def _teach(function: Any, number: int, wanted: Any, result: Any) -> None:
    """Tell the compiler that a function of ``number`` arguments takes octets (or masks) as well."""
    others = (types.Float, types.Integer) if wanted is octet else (types.Boolean,)

    class Template(AbstractTemplate):
        key = function

        def generic(self, args: Any, kws: Any) -> Signature | None:
            if kws or len(args) != number or wanted not in args:
                return None
            if not all(have is wanted or isinstance(have, others) for have in args):
                return None
            return signature(result, *[wanted] * number)

    infer_global(function)(Template)


def _emit(instruction: str, _context: Any, builder: Any, _signature: Any, args: Any) -> Any:
    """Lower to one instruction."""
    return getattr(builder, instruction)(*args)


def _compare(sign: str, _context: Any, builder: Any, _signature: Any, args: Any) -> Any:
    ask = builder.fcmp_unordered if sign == "!=" else builder.fcmp_ordered
    return ask(sign, *args)


def _choose(sign: str, _context: Any, builder: Any, _signature: Any, args: Any) -> Any:
    """Least or greatest, as Numba picks it for floats: where one is NaN, the first."""
    first, *rest = args
    for value in rest:
        first = builder.select(builder.fcmp_ordered(sign, value, first), value, first)
    return first


def _intrinsic(name: str, _context: Any, builder: Any, _signature: Any, args: Any) -> Any:
    return vector_call(builder, name, *args)


def _one_by_one(function: Any, context: Any, builder: Any, _signature: Any, args: Any) -> Any:
    """Call a function of the library for each truck."""
    plain = signature(types.float64, *[types.float64] * len(args))
    resolved = context.typing_context.resolve_function_type(function, plain.args, {})
    call = context.get_function(function, resolved)
    result = ir.Constant(VECTOR, ir.Undefined)
    for place in places():
        value = call(builder, [builder.extract_element(a, place) for a in args])
        result = builder.insert_element(result, value, place)
    return result


def _teach_all() -> None:
    """Everything that the step does with octets and masks."""
    done: list[tuple[Any, int, Any, Any, Callable[..., Any]]] = [
        *((each, 2, octet, octet, partial(_emit, name)) for each, name in _ARITHMETIC.items()),
        *((each, 2, octet, mask, partial(_compare, sign)) for each, sign in _COMPARED.items()),
        *((each, 2, mask, mask, partial(_emit, name)) for each, name in _LOGIC.items()),
        *((each, number, octet, octet, partial(_one_by_one, each))
          for each, number in _ONE_BY_ONE.items()),
        (operator.neg, 1, octet, octet, partial(_emit, "fneg")),
        (abs, 1, octet, octet, partial(_intrinsic, "llvm.fabs")),
        (math.sqrt, 1, octet, octet, partial(_intrinsic, "llvm.sqrt")),
        (min, 2, octet, octet, partial(_choose, "<")),
        (max, 2, octet, octet, partial(_choose, ">")),
        (max, 3, octet, octet, partial(_choose, ">")),
    ]
    for function, number, wanted, result, lower in done:
        _teach(function, number, wanted, result)
        lower_builtin(function, *[type(wanted)] * number)(_plain(lower))


def _plain(lower: Callable[..., Any]) -> Callable[..., Any]:
    """A function of its own, as the compiler wants one, of a partial."""
    def lowered(context: Any, builder: Any, signature_: Any, args: Any) -> Any:
        return lower(context, builder, signature_, args)

    return lowered


_teach_all()

# mypy: disable-error-code="no-untyped-call,untyped-decorator"
"""What the compiler makes of `choose`: a select, a test of eight bits, loads place by place.

References: LLVM language reference, "select"; Numba manual, "Low-level extension API".
Known limits: an octet is a place only within the first 2**53 numbers.
Validated with: test/physics/test_choose.py, test/simulation/test_abreast.py.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable
from typing import Any, cast

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.core.typing.templates import signature
from numba.extending import lower_builtin, type_callable

from truck_blowout_sim.physics import choose
from truck_blowout_sim.physics.octet import (
    EIGHT,
    VECTOR,
    Mask,
    Octet,
    mask,
    octet,
    places,
    spread,
    vector_call,
)

_Any = types.Any
_PLAIN = (types.Float, types.Integer, types.Boolean)


@type_callable(choose.where)
def _type_where(context: Any) -> Callable[..., Any]:
    def typer(condition: Any, a: Any, b: Any) -> Any:
        kind = context.unify_types(a, b)
        if condition is mask and isinstance(kind, _PLAIN):
            kind = mask if isinstance(kind, types.Boolean) else octet
        return kind and signature(kind, condition, kind, kind)

    return typer


@lower_builtin(choose.where, _Any, _Any, _Any)
def _where(_context: Any, builder: Any, _signature: Any, args: Any) -> Any:
    return builder.select(*args)


@type_callable(choose.any_of)
def _type_any_of(_context: Any) -> Callable[..., Any]:
    return lambda condition: types.boolean


@lower_builtin(choose.any_of, types.Boolean)
def _any_of_one(_context: Any, _builder: Any, _signature: Any, args: Any) -> Any:
    return args[0]


@lower_builtin(choose.any_of, Mask)
@lower_builtin(choose.seldom, Mask)
def _any_of_eight(_context: Any, builder: Any, _signature: Any, args: Any) -> Any:
    bits = ir.IntType(EIGHT)
    return builder.icmp_unsigned("!=", builder.bitcast(args[0], bits), ir.Constant(bits, 0))


def _all(builder: Any, mask: Any) -> Any:
    """Whether it holds for every truck."""
    bits = ir.IntType(EIGHT)
    return builder.icmp_unsigned("==", builder.bitcast(mask, bits), ir.Constant(bits, -1))


@type_callable(choose.seldom)
def _type_seldom(_context: Any) -> Callable[..., Any]:
    return lambda condition: types.boolean


@lower_builtin(choose.seldom, types.Boolean)
def _seldom_one(context: Any, _builder: Any, _signature: Any, _args: Any) -> Any:
    return context.get_constant(types.boolean, True)


@type_callable(choose.shared)
def _type_shared(_context: Any) -> Callable[..., Any]:
    return lambda value: types.float64 if value is octet else value


@lower_builtin(choose.shared, _Any)
def _shared(_context: Any, builder: Any, signature_: Any, args: Any) -> Any:
    return (builder.extract_element(args[0], places()[0]) if signature_.args[0] is octet
            else args[0])


@type_callable(choose.whole)
def _type_whole(_context: Any) -> Callable[..., Any]:
    return lambda value: octet if value is octet else types.int64


@lower_builtin(choose.whole, types.Float)
def _whole_one(_context: Any, builder: Any, _signature: Any, args: Any) -> Any:
    return builder.fptosi(args[0], ir.IntType(64))


@lower_builtin(choose.whole, Octet)
def _whole_eight(_context: Any, builder: Any, _signature: Any, args: Any) -> Any:
    return vector_call(builder, "llvm.floor", args[0])


@type_callable(choose.nearest)
def _type_nearest(_context: Any) -> Callable[..., Any]:
    return lambda value: octet if value is octet else types.float64


@lower_builtin(choose.nearest, types.Float)
def _nearest_one(_context: Any, builder: Any, _signature: Any, args: Any) -> Any:
    return builder.call(builder.module.declare_intrinsic("llvm.rint", [ir.DoubleType()]), args)


@lower_builtin(choose.nearest, Octet)
def _nearest_eight(_context: Any, builder: Any, _signature: Any, args: Any) -> Any:
    return vector_call(builder, "llvm.rint", args[0])


@type_callable(choose.cosine_and_sine)
def _type_cosine_and_sine(_context: Any) -> Callable[..., Any]:
    def typer(angle: Any) -> Any:
        return types.UniTuple(octet if angle is octet else types.float64, 2)

    return typer


@lower_builtin(choose.cosine_and_sine, types.Float)
def _cosine_and_sine_one(context: Any, builder: Any, signature_: Any, args: Any) -> Any:
    plain = signature(types.float64, types.float64)
    found = [context.get_function(function, context.typing_context.resolve_function_type(
        function, plain.args, {}))(builder, args) for function in (math.cos, math.sin)]
    return context.make_tuple(builder, signature_.return_type, found)


@lower_builtin(choose.cosine_and_sine, Octet)
def _cosine_and_sine_eight(context: Any, builder: Any, signature_: Any, args: Any) -> Any:
    """By polynomials: a call for each truck would take a tenth of a step."""
    from truck_blowout_sim.physics.trig import heading  # which is compiled by what stands here

    return context.compile_internal(builder, cast("Any", heading).py_func, signature_, args)


@type_callable(choose.pick)
def _type_pick(_context: Any) -> Callable[..., Any]:
    def typer(values: Any, at: Any) -> Any:
        place = octet if at is octet else types.intp
        return signature(values.dtype, values, place)

    return typer


@lower_builtin(choose.pick, types.CPointer, types.Integer)
@lower_builtin(choose.pick, types.Array, types.Integer)
def _pick_one(context: Any, builder: Any, signature_: Any, args: Any) -> Any:
    return context.get_function(operator.getitem, signature_)(builder, args)


@lower_builtin(choose.pick, types.CPointer, Octet)
@lower_builtin(choose.pick, types.Array, Octet)
def _pick_eight(context: Any, builder: Any, signature_: Any, args: Any) -> Any:
    """A place that is not a number is place 0, so that nothing else is touched."""
    (numbers, at), kind = args, signature_.args[0]
    if isinstance(kind, types.Array):
        numbers = context.make_array(kind)(context, builder, numbers).data
    number = builder.fcmp_ordered("ord", at, at)
    at = builder.select(number, at, ir.Constant(VECTOR, None))
    at = builder.fptosi(at, ir.VectorType(ir.IntType(64), EIGHT))
    first = builder.extract_element(at, places()[0])
    same = builder.icmp_signed("==", at, spread(builder, first, at.type))
    result = cgutils.alloca_once(builder, VECTOR)
    with builder.if_else(_all(builder, same)) as (one, several):
        with one:
            builder.store(builder.load(builder.gep(numbers, [first])), result)
        with several:
            builder.store(_pick_each(builder, numbers, at), result)
    return builder.load(result)


def _pick_each(builder: Any, numbers: Any, at: Any) -> Any:
    """Load truck by truck."""
    first = builder.bitcast(numbers, ir.PointerType(ir.DoubleType()))
    result = ir.Constant(VECTOR, ir.Undefined)
    for k, place in enumerate(places()):
        index = builder.extract_element(at, place)
        index = builder.add(builder.mul(index, ir.Constant(index.type, EIGHT)),
                            ir.Constant(index.type, k))
        result = builder.insert_element(result, builder.load(builder.gep(first, [index])), place)
    return result


@type_callable(choose.power_where)
def _type_power_where(_context: Any) -> Callable[..., Any]:
    def typer(condition: Any, base: Any, exponent: Any) -> Any:
        if octet in (base, exponent) or condition is mask:
            return signature(octet, mask, octet, octet)
        return signature(types.float64, types.boolean, types.float64, types.float64)

    return typer


def _power(context: Any, builder: Any, base: Any, exponent: Any) -> Any:
    kind = signature(types.float64, types.float64, types.float64)
    return context.get_function(operator.pow, kind)(builder, (base, exponent))


@lower_builtin(choose.power_where, types.Boolean, types.Float, types.Float)
def _power_where_one(context: Any, builder: Any, _signature: Any, args: Any) -> Any:
    condition, base, exponent = args
    result = cgutils.alloca_once_value(builder, base)
    with builder.if_then(condition):
        builder.store(_power(context, builder, base, exponent), result)
    return builder.load(result)


@lower_builtin(choose.power_where, Mask, Octet, Octet)
def _power_where_eight(context: Any, builder: Any, _signature: Any, args: Any) -> Any:
    """Only for the trucks that need it, once where all agree: it takes longer than a tire."""
    condition, base, exponent = args
    first = [builder.extract_element(a, places()[0]) for a in args]
    same = builder.fcmp_ordered("==", base, spread(builder, first[1], VECTOR))
    same = builder.and_(same, builder.fcmp_ordered("==", exponent,
                                                   spread(builder, first[2], VECTOR)))
    same = builder.and_(same, condition)
    result = cgutils.alloca_once(builder, VECTOR)
    with builder.if_else(_all(builder, same)) as (one, several):
        with one:
            builder.store(spread(builder, _power(context, builder, *first[1:]), VECTOR), result)
        with several:
            builder.store(_power_each(context, builder, args), result)
    return builder.load(result)


def _power_each(context: Any, builder: Any, args: Any) -> Any:
    """Truck by truck."""
    result = args[1]
    for place in places():
        one = [builder.extract_element(a, place) for a in args]
        value = _power_where_one(context, builder, None, one)
        result = builder.insert_element(result, value, place)
    return result


@type_callable(choose.trucks_in)
def _type_trucks_in(_context: Any) -> Callable[..., Any]:
    return lambda values: types.intp


@lower_builtin(choose.trucks_in, _Any)
def _trucks_in(context: Any, _builder: Any, signature_: Any, _args: Any) -> Any:
    many = signature_.args[0].dtype is octet
    return context.get_constant(types.intp, EIGHT if many else 1)

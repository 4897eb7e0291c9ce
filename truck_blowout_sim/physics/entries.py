# mypy: disable-error-code="no-untyped-call,untyped-decorator"
"""Entries of the core: functions of which exactly one compiled object exists, or one of each form.

An entry (the step, the observer, the energy) takes bare pointers and is compiled once. Compiled
callers hold its symbol and no copy of its code, so every caller and every start, the one that
compiles included, runs the same machine code and gets the same bits. Numba alone would link a copy
into each caller, optimized again, and which copy runs would depend on what the cache holds.

The second form, for eight trucks abreast, is compiled of the same source where a compiled caller
hands over octets; so only then.

References: Numba manual, "Low-level extension API"; llvmlite, "Execution engine".
Known limits: arrays handed to an entry must be contiguous; an entry returns a number or nothing.
Validated with: test/physics/test_jit.py.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Mapping
from functools import partial
from importlib import import_module
from typing import Any

import llvmlite.binding as llvm
import numpy as np
from llvmlite import ir
from numba import cfunc, types
from numba.core import cgutils
from numba.core.typing.templates import AbstractTemplate, Signature, infer_global
from numba.extending import intrinsic, lower_builtin

from truck_blowout_sim.physics.octet import octet
from truck_blowout_sim.physics.vectors import prefer_vectors

# what an entry's annotations mean to the compiler and to ctypes, for one truck
_KINDS: dict[str, tuple[Any, Any]] = {
    "Floats": (types.CPointer(types.float64), np.float64),
    "Integers": (types.CPointer(types.int64), np.int64),
    "float": (types.float64, ctypes.c_double),
    "int": (types.int64, ctypes.c_int64),
    "None": (types.void, None),
}
_ARRAYS = ("Floats", "Integers")


class Form:
    """A compiled function with one address.

    Args:
        function: annotated with ``Floats``, ``Integers``, ``float`` and ``int`` alone.
        options: how to compile it.
        number: what ``Floats`` holds: a float64 or an octet.
    """

    def __init__(self, function: Callable[..., Any], options: Mapping[str, object], number: Any
                 ) -> None:
        self.function, self.number = function, number
        self.symbol = f"{function.__module__}.{function.__name__}"
        if number is octet:
            self.symbol += f".{number.name}"
        *self._kinds, self._result = function.__annotations__.values()
        self._options: Mapping[str, Any] = options
        self._compiled: Any = None
        self._call: Any = None

    def load(self) -> None:
        """Compile it or fetch it from the cache, and make its address known to compiled callers."""
        if self._call is not None:
            return
        prefer_vectors()
        self._compiled = cfunc(self.result_type(*self.argument_types), **self._options)(
            self.function)
        llvm.add_symbol(self.symbol, self._compiled.address)
        plain = [ctypes.c_void_p if kind in _ARRAYS else _KINDS[kind][1] for kind in self._kinds]
        self._call = ctypes.CFUNCTYPE(_KINDS[self._result][1], *plain)(self._compiled.address)

    @property
    def argument_types(self) -> list[Any]:
        """What compiled code hands over."""
        return [types.CPointer(self.number) if kind == "Floats" else _KINDS[kind][0]
                for kind in self._kinds]

    @property
    def result_type(self) -> Any:
        """What it returns."""
        return _KINDS[self._result][0]


class Entry(Form):
    """A `Form` for one truck, callable from Python and from compiled code, and one for eight.

    Attributes:
        abreast: the form for eight trucks, which compiled code alone calls.
    """

    def __init__(self, function: Callable[..., Any], options: Mapping[str, object]) -> None:
        super().__init__(function, options, types.float64)
        self.__doc__, self.__name__ = function.__doc__, function.__name__
        self.abreast = Form(function, options, octet)
        _teach_compiler(self)

    def __call__(self, *args: Any) -> Any:
        """Call it from Python, for one truck.

        Raises:
            TypeError: an array of another kind of number, or one with gaps.
        """
        self.load()
        return self._call(*(_plain(kind, value)
                            for kind, value in zip(self._kinds, args, strict=True)))

    def form(self, args: Any) -> Form:
        """The form that takes these arguments of compiled code."""
        return self.abreast if any(getattr(have, "dtype", None) is octet for have in args) else self


def _plain(kind: str, value: Any) -> Any:
    """The address of an array, once it is what an entry expects; a number as it is."""
    if kind not in _ARRAYS:
        return value
    if value.dtype != _KINDS[kind][1] or not value.flags.c_contiguous:
        raise TypeError(f"expected a contiguous array of {_KINDS[kind][1].__name__}")
    return value.ctypes.data


def load_entry(module: str, name: str, abreast: bool) -> None:
    """Load an entry by name: what a cached caller does before it is linked."""
    found: Entry = getattr(import_module(module), name)
    (found.abreast if abreast else found).load()


def _fits(have: Any, want: Any) -> bool:
    """Whether a compiled caller's argument can be handed over."""
    if not isinstance(want, types.CPointer) or isinstance(have, types.CPointer):
        return True
    return isinstance(have, types.Array) and have.dtype == want.dtype and have.layout == "C"


def _teach_compiler(this: Entry) -> None:
    """Let compiled code call an entry: arrays go over as pointers to their first element."""

    class Template(AbstractTemplate):
        key = this

        def generic(self, args: Any, kws: Any) -> Any:
            form = this.form(args)
            wanted = form.argument_types
            if kws or len(args) != len(wanted) or not all(map(_fits, args, wanted)):
                return None
            kept = (have if isinstance(want, types.CPointer) else want
                    for have, want in zip(args, wanted, strict=True))
            return Signature(form.result_type, tuple(kept), None)

    infer_global(this, types.Function(Template))

    @lower_builtin(this, types.VarArg(types.Any))
    def call(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        form = this.form(signature.args)
        form.load()
        # a cached caller must find the symbol before it is linked
        module, _, name = this.symbol.rpartition(".")
        context.active_code_library._reload_init.add(
            partial(load_entry, module, name, form is this.abreast))
        plain = [context.make_array(kind)(context, builder, value).data
                 if isinstance(kind, types.Array) else value
                 for kind, value in zip(signature.args, args, strict=True)]
        nothing = form.result_type is types.void
        result = ir.VoidType() if nothing else context.get_value_type(form.result_type)
        target = cgutils.get_or_insert_function(
            builder.module, ir.FunctionType(result, [value.type for value in plain]), form.symbol)
        value = builder.call(target, plain)
        return context.get_dummy_value() if nothing else value


@intrinsic(prefer_literal=True)
def on_stack(context: Any, like: Any, size: Any) -> Any:
    """Numbers on the stack of the compiled caller, uninitialized; ``size`` is a constant.

    They are of the kind that ``like`` holds: floats, or octets.
    """
    def reserve(context: Any, builder: Any, _signature: Any, _args: Any) -> Any:
        return cgutils.alloca_once(builder, context.get_data_type(like.dtype),
                                   size=size.literal_value)

    if not isinstance(size, types.IntegerLiteral):
        return None
    return types.CPointer(like.dtype)(like, size), reserve

"""Parameters of a node as a table: declared, checked, explained from the same rows."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from rcl_interfaces.msg import (
    FloatingPointRange,
    IntegerRange,
    ParameterDescriptor,
    SetParametersResult,
)
from rclpy.exceptions import InvalidParameterValueException
from rclpy.node import Node
from rclpy.parameter import Parameter as RosParameter

from truck_blowout_sim.errors import InputError, quoted

Value = bool | int | float | str | list[str]


@dataclass(frozen=True)
class Spec:
    """One row.

    Attributes:
        name: parameter name, unit as suffix where it has one.
        default: value if nothing else is given; its type is the parameter's type.
        text: what it means, one sentence.
        unit: unit in words, empty for names and switches.
        low, high: accepted range of a number.
        live: may be changed while the node runs.
    """

    name: str
    default: Value
    text: str
    unit: str = ""
    low: float = -math.inf
    high: float = math.inf
    live: bool = False

    def checked(self, value: object) -> Value:
        """The value in the row's own type.

        Raises:
            InputError: wrong type, not finite, or out of range.
        """
        if isinstance(self.default, float) and type(value) is int:
            value = float(value)  # `100` in a YAML file is as good as `100.0`
        if isinstance(self.default, list):
            value = _texts(value)
        if type(value) is not type(self.default):
            raise InputError(
                f"{quoted(value)} is no {_type_name(self.default)}",
                file="parameter", where=self.name, expected=self.expected(),
            )  # fmt: skip
        if isinstance(value, (int, float)) and not self.low <= value <= self.high:
            raise InputError(f"{value:g} is out of range", file="parameter", where=self.name,
                             expected=self.expected())  # fmt: skip
        return value

    def expected(self) -> str:
        """Type, unit and range in words."""
        words = f"a {_type_name(self.default)}" + (f" in {self.unit}" if self.unit else "")
        if math.isfinite(self.low) or math.isfinite(self.high):
            words += f" from {self.low:g} to {self.high:g}"
        return words

    def descriptor(self) -> ParameterDescriptor:
        """What `ros2 param describe` shows."""
        unit = f" [{self.unit}]" if self.unit else ""
        out = ParameterDescriptor(
            description=self.text + unit, read_only=not self.live, dynamic_typing=True
        )
        if math.isfinite(self.low) or math.isfinite(self.high):
            out.additional_constraints = self.expected()
            low, high = max(self.low, -sys.float_info.max), min(self.high, sys.float_info.max)
            # a whole number here would go out as garbage: messages do not check their fields
            if isinstance(self.default, int):
                whole = IntegerRange(from_value=int(low), to_value=int(high), step=1)
                out.integer_range = [whole]
            else:
                bounds = FloatingPointRange(from_value=float(low), to_value=float(high))
                out.floating_point_range = [bounds]
        return out


def declare(node: Node, specs: Sequence[Spec]) -> dict[str, Value]:
    """Declare every row and return the values that YAML or the command line gave.

    Raises:
        InputError: a value does not fit its row.
    """
    values: dict[str, Value] = {}
    for spec in specs:
        try:
            stored: RosParameter[Any] = node.declare_parameter(
                spec.name, spec.default, spec.descriptor()
            )
        except InvalidParameterValueException as error:
            raise InputError(
                str(error), file="parameter", where=spec.name, expected=spec.expected()
            ) from error
        values[spec.name] = spec.checked(stored.value)
    return values


def check_changes(
    specs: Sequence[Spec], changes: Iterable[RosParameter[Any]]
) -> SetParametersResult:
    """Judge a request to change parameters of a running node."""
    rows = {spec.name: spec for spec in specs}
    for change in changes:
        if change.name in rows:
            try:
                rows[change.name].checked(change.value)
            except InputError as error:
                return SetParametersResult(successful=False, reason=str(error))
    return SetParametersResult(successful=True)


def markdown(specs: Sequence[Spec]) -> str:
    """The rows as a list for the documentation."""
    live = any(spec.live for spec in specs)
    lines = ["A parameter marked *live* can be changed while the node runs.", ""] if live else []
    for spec in specs:
        default = "`''`" if spec.default == "" else f"`{_yaml(spec.default)}`"
        marks = ", ".join([" ".join(filter(None, (default, spec.unit))), *["*live*"] * spec.live])
        lines.append(f"- `{spec.name}` ({marks}): {spec.text}")
    return "\n".join(lines) + "\n"


def _texts(value: object) -> object:
    """A list of texts, also from a lone one; anything else as it is, without becoming a list."""
    texts = [value] if isinstance(value, str) else value
    if isinstance(texts, Sequence) and all(isinstance(one, str) for one in texts):
        return list(texts)
    return tuple(texts) if isinstance(texts, list) else value


def _yaml(value: Value) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)


def _type_name(value: Value) -> str:
    return {bool: "boolean", int: "whole number", float: "number", str: "text",
            list: "list of texts"}[type(value)]  # fmt: skip

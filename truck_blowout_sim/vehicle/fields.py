"""How a section of a vehicle file is described: a frozen dataclass whose fields carry a rule.

The dataclass is at once the schema a file is checked against, the typed value the package works
with, and the line of the reference in `docs/reference/keys`. A field without default is required.
"""

# ruff: noqa: ANN401 (as dataclasses.field does, these stand in for a value of any type)
from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import MISSING
from typing import Any, NamedTuple

RULE = "rule"


class Rule(NamedTuple):
    """What a field of a section accepts."""

    kind: str  # "number", "numbers", "switch", "choice", "text", "section", "sections"
    doc: str
    low: float = float("-inf")
    high: float = float("inf")
    open_low: bool = False
    infinite: bool = False
    options: tuple[str, ...] = ()
    section: Any = None


def number(
    doc: str,
    *,
    low: float = float("-inf"),
    above: float | None = None,
    high: float = float("inf"),
    infinite: bool = False,
    default: float | None = None,
) -> Any:
    """A number from `low` (or greater than `above`) to `high`; infinite only where said."""
    bound = low if above is None else above
    return _field(
        Rule("number", doc, bound, high, above is not None, infinite),
        MISSING if default is None else default,
    )


def positive(doc: str, *, default: float | None = None) -> Any:
    """A number greater than zero."""
    return number(doc, above=0.0, default=default)


def at_least_zero(doc: str, *, default: float | None = None) -> Any:
    """A number that is not negative."""
    return number(doc, low=0.0, default=default)


def fraction(doc: str, *, default: float | None = None) -> Any:
    """A number from 0 to 1."""
    return number(doc, low=0.0, high=1.0, default=default)


def numbers(doc: str, *, low: float = float("-inf")) -> Any:
    """A list of numbers; empty where it is not given."""
    return _field(Rule("numbers", doc, low), ())


def switch(doc: str, *, default: bool | None = None) -> Any:
    """True or false."""
    return _field(Rule("switch", doc), MISSING if default is None else default)


def choice(doc: str, options: tuple[str, ...], *, default: str | None = None) -> Any:
    """One of the words in `options`."""
    return _field(Rule("choice", doc, options=options), MISSING if default is None else default)


def text(doc: str, *, default: str | None = None) -> Any:
    """A word or a sentence."""
    return _field(Rule("text", doc), MISSING if default is None else default)


def section(of: type[Any], doc: str, *, optional: bool = False) -> Any:
    """A section described by another dataclass; None where an optional one is absent."""
    return _field(Rule("section", doc, section=of), None if optional else MISSING)


def sections(of: type[Any] | None, doc: str, *, required: bool = False) -> Any:
    """Named sections of one kind, in the order of the file; `of` None: named texts."""
    rule = Rule("sections", doc, section=of)
    if required:
        return _field(rule, MISSING)
    return dataclasses.field(default_factory=dict, metadata={RULE: rule})


def _field(rule: Rule, default: Any) -> Any:
    return dataclasses.field(default=default, metadata={RULE: rule})


def rules(of: type[Any]) -> Mapping[str, Rule]:
    """The rule of every field of a section, by key."""
    return {f.name: f.metadata[RULE] for f in dataclasses.fields(of) if RULE in f.metadata}


def required(of: type[Any]) -> tuple[str, ...]:
    """Keys of a section that have no default."""
    return tuple(
        f.name
        for f in dataclasses.fields(of)
        if f.default is MISSING and f.default_factory is MISSING
    )

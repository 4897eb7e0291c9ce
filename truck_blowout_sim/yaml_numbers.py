"""YAML whose numbers are those that people write.

PyYAML follows YAML 1.1: `20:1` is 1201 to it (base 60), `01040` is 544 (octal), and `1e-3` a text.
Here integers and floats are those of YAML 1.2; dates, yes and no stay as in PyYAML.

References: YAML 1.2.2, section 10.3.2 (core schema).
Known limits: underscores between digits are read over, as in YAML 1.1.
Validated with: test/test_yaml_numbers.py.
"""

from __future__ import annotations

import re
from typing import Any

import yaml

_INT_TAG, _FLOAT_TAG = "tag:yaml.org,2002:int", "tag:yaml.org,2002:float"
_INT = re.compile(r"[-+]?[0-9][0-9_]*|0o[0-7]+|0x[0-9a-fA-F]+")
_FLOAT = re.compile(r"[-+]?(?:\.[0-9][0-9_]*|[0-9][0-9_]*(?:\.[0-9_]*)?)(?:[eE][-+]?[0-9]+)?"
                    r"|[-+]?\.(?:inf|Inf|INF)|\.(?:nan|NaN|NAN)")  # fmt: skip


def _int(_: object, node: yaml.ScalarNode) -> int:
    text = _checked(_INT, node)
    return int(text, {"0o": 8, "0x": 16}.get(text[:2], 10))


def _float(_: object, node: yaml.ScalarNode) -> float:
    return float(_checked(_FLOAT, node).replace(".inf", "inf").replace(".nan", "nan"))


def _checked(form: re.Pattern[str], node: yaml.ScalarNode) -> str:
    """The text of a number; one that is only tagged as a number is refused."""
    text = str(node.value)
    if not form.fullmatch(text):
        raise yaml.constructor.ConstructorError(
            None, None, f"{text!r} is not a number", node.start_mark)  # fmt: skip
    return text.replace("_", "").lower()


def _with_numbers(base: type[yaml.SafeLoader]) -> type[yaml.SafeLoader]:
    """A loader like another one, but for numbers."""
    kept = {first: [(tag, form) for tag, form in rules if tag not in (_INT_TAG, _FLOAT_TAG)]
            for first, rules in base.yaml_implicit_resolvers.items()}  # fmt: skip
    loader: Any = type(f"Numbers{base.__name__}", (base,), {"yaml_implicit_resolvers": kept})
    for tag, form, construct in ((_INT_TAG, _INT, _int), (_FLOAT_TAG, _FLOAT, _float)):
        whole = re.compile(f"(?:{form.pattern})$")
        loader.add_implicit_resolver(tag, whole, list("-+.0123456789"))
        loader.add_constructor(tag, construct)
    made: type[yaml.SafeLoader] = loader
    return made


LOADER = _with_numbers(yaml.SafeLoader)
FAST_LOADER = _with_numbers(getattr(yaml, "CSafeLoader", yaml.SafeLoader))


def load_yaml(text: str) -> object:
    """The content of a YAML text, by safe types only.

    Raises:
        yaml.YAMLError: it is none.
    """
    return yaml.load(text, Loader=LOADER)

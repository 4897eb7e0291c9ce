"""Tables that a program writes into a page of Markdown, between two marks.

Validated with: test/report/test_marked.py.
"""

from __future__ import annotations

from pathlib import Path

from truck_blowout_sim.errors import InputError


def marks(name: str) -> tuple[str, str]:
    """The comments before and behind what is written."""
    return f"<!-- {name}: begin -->", f"<!-- {name}: end -->"


def put_between(text: str, name: str, inside: str) -> str:
    """A document with what stands between two marks replaced.

    Raises:
        InputError: the marks are not there, once each and in order.
    """
    first, last = marks(name)
    before, begin, rest = text.partition(first)
    _, end, after = rest.partition(last)
    if not (begin and end) or first in rest or last in after:
        raise InputError("no place for the table", expected=f"{first} and {last}, once each")
    return f"{before}{first}\n{inside}\n{last}{after}"


def page_with(page: Path, name: str, inside: str) -> str:
    """A file's text with what stands between two marks replaced; the file stays.

    Raises:
        InputError: no such file, or the marks are not there, once each and in order.
    """
    try:
        return put_between(page.read_text(encoding="utf-8"), name, inside)
    except FileNotFoundError as error:
        raise InputError("no such page", file=page) from error
    except InputError as error:
        raise InputError(error.problem, file=page, expected=error.expected) from None


def put_on_page(page: Path, name: str, inside: str) -> None:
    """Write that text into the file."""
    page.write_text(page_with(page, name, inside), encoding="utf-8")

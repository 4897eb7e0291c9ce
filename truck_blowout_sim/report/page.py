"""Build one page that needs no other file: text, tables and pictures inside.

Validated with: test/report/test_page.py (no address leads outside, text is escaped).
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from truck_blowout_sim.recordings.atomic import replacing
from truck_blowout_sim.report.style import Picture

_TEMPLATES = Path(__file__).parent / "templates"


def render(template: str, content: Mapping[str, object]) -> str:
    """Fill a template; every text is escaped, a missing value is an error."""
    return _environment().get_template(template).render(**content)


def write_text(text: str, path: Path) -> None:
    """Write a file whole or not at all.

    Raises:
        StorageError: it cannot be written.
    """
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8", newline="\n")


def write_pictures(pictures: tuple[Picture, ...], folder: Path) -> tuple[Path, ...]:
    """Write each picture as PNG, named after it.

    Raises:
        StorageError: one cannot be written.
    """
    paths = tuple(folder / f"{picture.name}.png" for picture in pictures)
    for picture, path in zip(pictures, paths, strict=True):
        with replacing(path) as temporary:
            temporary.write_bytes(picture.png())
    return paths


@cache
def _environment() -> Environment:
    return Environment(
        loader=FileSystemLoader(_TEMPLATES),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )

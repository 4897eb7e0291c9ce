"""The figures of a node in a table; each row states the machine's load, which changes them."""

from __future__ import annotations

from benchmarks.page import Table, load, number


class Figures(Table):
    """Figures one below the other, beside what is sought."""

    def __init__(self) -> None:
        super().__init__("", "measured", "sought", "load average")

    def figure(self, name: str, value: float, unit: str = "", sought: str = "") -> None:
        """Add one row."""
        self.row(name, f"{number(value)} {unit}".strip(), sought, f"{load():.1f}")

"""Run the notebooks under docs/notebooks and save them with their outputs.

No kernel is needed: the cells run in one namespace, in order, as they do in the tests. What a cell
prints and the figures that it shows become its outputs.
"""

from __future__ import annotations

import base64
import contextlib
import io
import json
import os
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

FOLDER = Path(__file__).resolve().parents[1] / "docs" / "notebooks"
_DPI = 80


@contextlib.contextmanager
def inside(folder: str) -> Iterator[None]:
    """Work in a folder for a while."""
    before = os.getcwd()
    os.chdir(folder)
    try:
        yield
    finally:
        os.chdir(before)


def execute(notebook: dict[str, Any]) -> None:
    """Run all code cells in a scratch folder and keep what they print and draw."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    namespace: dict[str, Any] = {}
    with tempfile.TemporaryDirectory() as scratch, inside(scratch):
        for count, cell in enumerate((c for c in notebook["cells"] if c["cell_type"] == "code"), 1):
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed):
                exec(compile("".join(cell["source"]), f"cell {count}", "exec"), namespace)
            cell["execution_count"] = count
            cell["outputs"] = _outputs(printed.getvalue(), plt)
            plt.close("all")


def _outputs(printed: str, plt: Any) -> list[dict[str, Any]]:  # noqa: ANN401
    outputs: list[dict[str, Any]] = []
    if printed:
        outputs.append({"output_type": "stream", "name": "stdout",
                        "text": printed.splitlines(keepends=True)})
    for number in plt.get_fignums():
        buffer = io.BytesIO()
        plt.figure(number).savefig(buffer, format="png", dpi=_DPI, metadata={"Software": None})
        data = {"image/png": base64.b64encode(buffer.getvalue()).decode("ascii"),
                "text/plain": ["<Figure>"]}
        outputs.append({"output_type": "display_data", "metadata": {}, "data": data})
    return outputs


def main() -> None:
    for path in sorted(FOLDER.glob("*.ipynb")):
        notebook = json.loads(path.read_text(encoding="utf-8"))
        execute(notebook)
        path.write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
        sys.stdout.write(f"{path.name} run{os.linesep}")


if __name__ == "__main__":
    main()

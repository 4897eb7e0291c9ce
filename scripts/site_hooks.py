"""Hooks of the documentation site: notebooks become pages, links out of docs/ become names.

mkdocs calls these by name (mkdocs.yml, `hooks`). A notebook is shown with the outputs it was saved
with; pictures are put into the page, so that it needs no other file. Linked files of keys are shown
on the page.
"""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

# The theme's help for searching pages that are opened from the disk comes from a server elsewhere.
ELSEWHERE = re.compile(r'<script src="https?://[^"]*"></script>')
KEYS = re.compile(r"^- \[(.+)\]\((reference/keys/\w+\.yaml)\)$", re.MULTILINE)
OUTSIDE = re.compile(r"\]\(\.\./((?:README|CONTRIBUTING|CHANGELOG|QUALITY_DECLARATION)\.md)\)")


def on_page_read_source(page: Any, config: Any) -> str | None:  # noqa: ANN401
    """The text of a page; of a notebook, its cells as Markdown."""
    path = page.file.abs_src_path
    if not path.endswith(".ipynb"):
        return None
    with open(path, encoding="utf-8") as file:
        notebook = json.load(file)
    return "\n\n".join(_cell(cell) for cell in notebook["cells"])


def on_files(files: Any, config: Any) -> Any:  # noqa: ANN401
    """Notebooks are pages, too."""
    for file in files:
        if file.src_uri.endswith(".ipynb"):
            file.is_documentation_page = lambda: True
            file.dest_uri = file.src_uri.removesuffix(".ipynb") + ".html"
    return files


def on_page_markdown(markdown: str, page: Any, config: Any, files: Any) -> str:  # noqa: ANN401
    """Show the linked files of keys on the page; name pages beside docs/ instead of linking."""
    folder = Path(config["docs_dir"])

    def shown(link: re.Match[str]) -> str:
        keys = (folder / link[2]).read_text(encoding="utf-8")
        return f"### {link[1]}\n\n```yaml\n{keys}```\n"

    return OUTSIDE.sub(r"](#)", KEYS.sub(shown, markdown))


def on_post_page(output: str, page: Any, config: Any) -> str:  # noqa: ANN401
    """Nothing is loaded from the network when a page is read."""
    return ELSEWHERE.sub("", output)


def _cell(cell: dict[str, Any]) -> str:
    source = "".join(cell["source"])
    if cell["cell_type"] == "markdown":
        return source
    parts = [f"```python\n{source}\n```"]
    for output in cell.get("outputs", []):
        data = output.get("data", {})
        if "image/png" in data:
            parts.append(f"![result](data:image/png;base64,{data['image/png'].strip()})")
        elif text := "".join(output.get("text", data.get("text/plain", []))):
            parts.append(f"```text\n{text.rstrip()}\n```")
    return "\n\n".join(parts)

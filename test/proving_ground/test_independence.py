from __future__ import annotations

import ast
from pathlib import Path

import proving_ground

FOREIGN = ("physics", "simulation", "vehicle", "diagnosis", "comparison", "report")


def test_truth_shares_no_code_with_model_or_diagnosis() -> None:
    files = list(Path(proving_ground.__file__).parent.rglob("*.py"))
    assert len(files) > 20
    for path in files:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
            if isinstance(node, ast.ImportFrom):
                names = [f"{node.module}.{alias.name}" for alias in node.names]
            for name in names:
                parts = name.split(".")
                assert not (parts[0] == "truck_blowout_sim" and set(parts) & set(FOREIGN)), path

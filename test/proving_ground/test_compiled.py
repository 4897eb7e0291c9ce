from __future__ import annotations

from pathlib import Path

import numba
import pytest

from proving_ground import compiled


def test_the_cache_follows_every_source_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("compiled", "tire"):
        (tmp_path / f"{name}.py").write_text(name)
    monkeypatch.setattr(compiled, "__file__", str(tmp_path / "compiled.py"))
    before = compiled.digest()
    (tmp_path / "tire.py").write_text("another law")
    assert compiled.digest() != before


def test_compiling_leaves_the_cache_of_others_alone() -> None:
    before = numba.config.CACHE_DIR

    def double(x: float) -> float:
        return 2.0 * x

    made = compiled.compiled_whole(double)
    assert made(4.0) == 8.0
    assert before == numba.config.CACHE_DIR
    assert str(made._cache.cache_path).startswith(compiled.FOLDER)  # type: ignore[attr-defined]

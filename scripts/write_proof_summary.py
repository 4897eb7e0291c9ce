"""Put a proof's short table into README.md and its picture into docs/.

Use: python scripts/write_proof_summary.py out/proof
"""

from __future__ import annotations

import json
import shutil
import sys
from pathlib import Path

from truck_blowout_sim.proof.short import put_between, short_table

ROOT = Path(__file__).resolve().parents[1]
PICTURE = "docs/proof_power.png"
CAPTION = "Share of concealed effects that were noticed and named, by visibility"


def main(words: list[str]) -> int:
    if len(words) != 1 or not (Path(words[0]) / "proof.json").is_file():
        print(__doc__, file=sys.stderr)
        return 2
    proof, readme = Path(words[0]), ROOT / "README.md"
    figures = json.loads((proof / "proof.json").read_text(encoding="utf-8"))
    shutil.copy(proof / "power.png", ROOT / PICTURE)
    inside = f"{short_table(figures)}\n\n![{CAPTION}]({PICTURE})"
    readme.write_text(put_between(readme.read_text(encoding="utf-8"), inside), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

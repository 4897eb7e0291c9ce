"""tell_story.py RECORDING DIAGNOSIS_FOLDER PAGE [WORDS=ADDRESS ...]: the whole way on one page.

Compares the recording with the given and with the diagnosed vehicle, and joins both with the
diagnosis. `make run` ends with it.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

from truck_blowout_sim import compare, load_vehicle
from truck_blowout_sim.report.story_page import Story, write_story

VEHICLE = "international_9400i_trailmobile"


def main() -> None:
    recording, folder, page = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    links = [(words, address) for words, _, address in (w.partition("=") for w in sys.argv[4:])]
    found = json.loads((folder / "diagnosis.json").read_text(encoding="utf-8"))
    story = Story(compare(recording, load_vehicle(VEHICLE)),
                  compare(recording, load_vehicle(folder / "vehicle.yaml")), found, links)
    print(write_story(story, page))


if __name__ == "__main__":
    main()

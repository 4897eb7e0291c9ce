"""draw_blowout_picture.py PICTURE: the default truck half a second after its blowout.

Runs the scenario of the 2013 test and photographs the page of `truck-blowout view` in a headless
Chromium.
"""

from __future__ import annotations

import base64
import sys
import tempfile
from pathlib import Path

from truck_blowout_sim import load_vehicle, simulate
from truck_blowout_sim.motion import motion_of
from truck_blowout_sim.report.viewer import RunToShow, write_viewer
from truck_blowout_sim.report.viewer.browser import Browser

TIME_S, SIZE = 0.5, (1280, 640)
CAMERA = (
    "app.eye.camera.position.set(t.anchor.x + 11.5, t.anchor.y + 6.2, 2.3);"
    "app.eye.controls.target.set(t.anchor.x + 1.8, t.anchor.y, 1.15); app.eye.controls.update();"
    "app.eye.last = {at: t.anchor.clone(), heading: t.heading};"
)


def main() -> None:
    vehicle = load_vehicle("international_9400i_trailmobile")
    run = simulate(vehicle, "steer_axle_blowout")
    with tempfile.TemporaryDirectory() as folder:
        page = write_viewer([RunToShow(run, motion_of(run, vehicle), vehicle)],
                            Path(folder) / "view.html")
        with Browser(page, SIZE) as browser:
            browser.wait_for("!!window.viewer")
            browser.evaluate("window.viewer.then(() => app.film())")
            browser.evaluate(f"app.seek({TIME_S}) || ((t) => {{ {CAMERA} }})(app.trucks[0]) || 1")
            words = f"{TIME_S}, {SIZE[0]}, {SIZE[1]}, 'image/jpeg', 2"
            picture = browser.evaluate(f"app.picture({words})")
    Path(sys.argv[1]).write_bytes(base64.b64decode(picture.partition(",")[2]))


if __name__ == "__main__":
    main()

"""What the player serves, with the names of `ros2 bag play`."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from rclpy.node import Node
from std_srvs.srv import Trigger

if TYPE_CHECKING:
    from truck_blowout_sim.nodes.player_node import Player

Reply = tuple[bool, str]


def serve(node: Node, player: Player) -> None:
    """Create `~/pause`, `~/resume`, `~/toggle_paused`, `~/is_paused`, `~/play_next`, `~/seek`."""

    def pause() -> Reply:
        player.set_paused(True)
        return True, "paused"

    def resume() -> Reply:
        player.set_paused(False)
        return True, "playing"

    def toggle() -> Reply:
        return resume() if player.paused else pause()

    def is_paused() -> Reply:
        # Trigger has one flag: here it is the answer.
        return player.paused, "paused" if player.paused else "playing"

    def play_next() -> Reply:
        if not player.paused:
            return False, "play_next works while paused: call pause first"
        words = player.play_next()
        return bool(words), words or "at the end of the recording"

    def seek() -> Reply:
        start_s = player.playlist.recording.start_s
        target_s = start_s + float(player.values["seek_to_s"])
        if target_s > player.end_s:
            return False, f"seek_to_s lies behind the end, {player.end_s - start_s:.3f} s"
        player.seek(target_s)
        return True, f"at {target_s - start_s:.3f} s; the simulator was not moved"

    for name, act in (
        ("pause", pause),
        ("resume", resume),
        ("toggle_paused", toggle),
        ("is_paused", is_paused),
        ("play_next", play_next),
        ("seek", seek),
    ):
        node.create_service(Trigger, f"~/{name}", _answer(act))


def _answer(
    act: Callable[[], Reply],
) -> Callable[[Trigger.Request, Trigger.Response], Trigger.Response]:
    def answer(_: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        response.success, response.message = act()
        return response

    return answer

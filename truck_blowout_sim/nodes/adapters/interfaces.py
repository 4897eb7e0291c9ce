"""simulation_interfaces: its services in front of the simulator's own.

| service | does |
|---|---|
| get_simulator_features | lists what follows |
| get_simulation_state, set_simulation_state | playing, paused, stopped (paused in the initial state), quitting |
| step_simulation | as many publishing periods as asked, while paused |
| simulate_steps (action) | the same, with feedback after each period; can be canceled |
| reset_simulation | scope default, all, or state; time goes on, so scope time alone is not supported |
"""  # noqa: E501  # a table

from __future__ import annotations

from collections.abc import Callable, Generator
from typing import TYPE_CHECKING, Any

from rclpy.action.server import ActionServer, CancelResponse
from rclpy.node import Node

from truck_blowout_sim.nodes.services import once_ready

if TYPE_CHECKING:
    from truck_blowout_sim.nodes.simulator_node import Simulator

_FEATURES = (
    "SIMULATION_RESET",
    "SIMULATION_RESET_STATE",
    "SIMULATION_STATE_GETTING",
    "SIMULATION_STATE_SETTING",
    "SIMULATION_STATE_PAUSE",
    "STEP_SIMULATION_SINGLE",
    "STEP_SIMULATION_MULTIPLE",
    "STEP_SIMULATION_ACTION",
)


def attach(node: Node, simulator: Simulator) -> bool:
    """Serve, if simulation_interfaces is installed; returns whether it is."""
    try:
        from simulation_interfaces import action, msg, srv
    except ImportError:
        return False
    served = InterfaceServices(simulator, msg, srv)
    for name, kind, act in (
        ("get_simulator_features", srv.GetSimulatorFeatures, served.features),
        ("get_simulation_state", srv.GetSimulationState, served.get_state),
        ("set_simulation_state", srv.SetSimulationState, served.set_state),
        ("step_simulation", srv.StepSimulation, served.step),
        ("reset_simulation", srv.ResetSimulation, served.reset),
    ):
        node.create_service(kind, name, act)
    ActionServer(
        node, action.SimulateSteps, "simulate_steps", StepsAction(simulator, msg, action).execute,
        cancel_callback=lambda _: CancelResponse.ACCEPT,
    )  # fmt: skip
    return True


class InterfaceServices:
    """The services' callbacks.

    Args:
        simulator: what they act on.
        msg, srv: the modules of simulation_interfaces.
    """

    def __init__(self, simulator: Simulator, msg: Any, srv: Any) -> None:  # noqa: ANN401
        self._simulator = simulator
        self._result = msg.Result
        self._state = msg.SimulationState
        self._features = msg.SimulatorFeatures
        self._set = srv.SetSimulationState
        self._reset = srv.ResetSimulation
        self._stopped = False

    def features(self, _: Any, response: Any) -> Any:  # noqa: ANN401
        """What is supported."""
        response.features.features = [getattr(self._features, name) for name in _FEATURES]
        response.features.custom_info = "one truck; blowouts by std_srvs/Trigger services"
        return response

    def get_state(self, _: Any, response: Any) -> Any:  # noqa: ANN401
        """Playing, paused or stopped."""
        response.state.state = self._present()
        response.result.result = self._result.RESULT_OK
        return response

    def set_state(self, request: Any, response: Any) -> Any:  # noqa: ANN401
        """Play, pause, stop, quit."""
        wanted, state = request.state.state, self._state
        if wanted == self._present():
            response.result.result = self._set.Response.ALREADY_IN_TARGET_STATE
            response.result.error_message = "already in this state"
            return response
        if wanted == state.STATE_PAUSED and self._present() == state.STATE_STOPPED:
            response.result.result = self._set.Response.INCORRECT_TRANSITION
            response.result.error_message = "stopped: play first"
            return response
        acts: dict[int, Callable[[], tuple[bool, str]]] = {
            state.STATE_PLAYING: self._simulator.resume,
            state.STATE_PAUSED: self._simulator.pause,
            state.STATE_STOPPED: self._stop,
            state.STATE_QUITTING: self._simulator.quit,
        }
        if wanted not in acts:
            response.result.result = self._result.RESULT_FEATURE_UNSUPPORTED
            return response
        act = acts[wanted]
        reply = (act if wanted == state.STATE_QUITTING else once_ready(self._simulator, act))()
        if reply[0]:
            self._stopped = wanted == state.STATE_STOPPED
        return self._answer(response, reply, self._result.RESULT_OPERATION_FAILED)

    def step(self, request: Any, response: Any) -> Any:  # noqa: ANN401
        """As many publishing periods as asked."""
        reply = once_ready(self._simulator, lambda: self._simulator.step_by(request.steps))()
        return self._answer(response, reply, self._result.RESULT_OPERATION_FAILED)

    def reset(self, request: Any, response: Any) -> Any:  # noqa: ANN401
        """Initial state; time goes on."""
        scopes = self._reset.Request
        if request.scope not in (scopes.SCOPE_DEFAULT, scopes.SCOPE_STATE, scopes.SCOPE_ALL):
            response.result.result = self._result.RESULT_FEATURE_UNSUPPORTED
            response.result.error_message = "simulated time goes on, nothing is spawned"
            return response
        reply = once_ready(self._simulator, self._simulator.reset)()
        return self._answer(response, reply, self._result.RESULT_OPERATION_FAILED)

    def _stop(self) -> tuple[bool, str]:
        self._simulator.pause()
        return self._simulator.reset()

    def _present(self) -> int:
        if not self._simulator.paused:
            return int(self._state.STATE_PLAYING)
        # the simulator's own services may have let it run or step since
        stopped = self._stopped and self._simulator.plant.elapsed_ns == 0
        return int(self._state.STATE_STOPPED if stopped else self._state.STATE_PAUSED)

    def _answer(self, response: Any, reply: tuple[bool, str], failure: int) -> Any:  # noqa: ANN401
        response.result.result = self._result.RESULT_OK if reply[0] else failure
        response.result.error_message = "" if reply[0] else reply[1]
        return response


class _NextTurn:
    """Awaited, it lets the executor handle what else waits."""

    def __await__(self) -> Generator[None, None, None]:
        yield


class StepsAction:
    """Executes the action `simulate_steps`.

    Args:
        simulator: what is stepped.
        msg, action: the modules of simulation_interfaces.
    """

    def __init__(self, simulator: Simulator, msg: Any, action: Any) -> None:  # noqa: ANN401
        self._simulator = simulator
        self._result = msg.Result
        self._action = action.SimulateSteps

    async def execute(self, goal: Any) -> Any:  # noqa: ANN401
        """Step, report, and look for a cancellation after each period."""
        wanted, result = goal.request.steps, self._action.Result()
        feedback = self._action.Feedback()
        for done in range(1, wanted + 1):
            if goal.is_cancel_requested:
                goal.canceled()
                result.result.result = self._result.RESULT_OPERATION_FAILED
                result.result.error_message = f"canceled after {done - 1} of {wanted} steps"
                return result
            there, words = once_ready(self._simulator, lambda: self._simulator.step_by(1))()
            if not there:
                goal.abort()
                result.result.result = self._result.RESULT_OPERATION_FAILED
                result.result.error_message = words
                return result
            feedback.completed_steps, feedback.remaining_steps = done, wanted - done
            goal.publish_feedback(feedback)
            await _NextTurn()
        goal.succeed()
        result.result.result = self._result.RESULT_OK
        return result

"""The simulator as another node sees it: its services and parameters."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from time import monotonic
from typing import Any

from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters
from rclpy.client import Client
from rclpy.executors import Executor
from rclpy.node import Node
from rclpy.task import Future
from std_srvs.srv import SetBool, Trigger

from truck_blowout_sim.errors import InputError

_ASK_AGAIN_S = 0.2


class SimulatorClient:
    """Calls the simulator; waiting spins the executor, so call from the loop, not a callback.

    Args:
        node: owner of the clients.
        name: name of the simulator node, relative.
        stopped: asked while waiting; true ends the wait.
    """

    def __init__(self, node: Node, name: str, stopped: Callable[[], bool]) -> None:
        self._node = node
        self._stopped = stopped
        self._triggers: dict[str, Client[Any, Any]] = {}
        self._parameters: Client[Any, Any] = node.create_client(
            SetParameters, f"{name}/set_parameters"
        )
        self._record: Client[Any, Any] = node.create_client(SetBool, "record")
        self.pending = 0

    @contextmanager
    def to_the_end(self) -> Iterator[None]:
        """Inside, waits go on although the player was asked to end."""
        stopped, self._stopped = self._stopped, lambda: False
        try:
            yield
        finally:
            self._stopped = stopped

    def wait(self, executor: Executor, timeout_s: float) -> bool:
        """Wait until the simulator is ready, its model compiled; false after the timeout."""
        end_s = monotonic() + timeout_s
        ready = self._trigger("ready")
        while self._until(executor, lambda: bool(ready.service_is_ready()), end_s):
            try:
                reply = self._answer(executor, ready, Trigger.Request(), end_s)
            except InputError:
                return False
            if reply.success:
                return True
            self.until(executor, lambda: False, _ASK_AGAIN_S)
        return False

    def call(self, executor: Executor, service: str, *, timeout_s: float = 10.0) -> str:
        """Call a Trigger service of the simulator and return its sentence.

        Raises:
            InputError: it is not served, does not answer, or refuses.
        """
        return self._sentence(executor, self._trigger(service), Trigger.Request(), timeout_s)

    def record(self, executor: Executor, wanted: bool, *, timeout_s: float = 30.0) -> str:
        """Start or stop the simulator's bag and return its sentence.

        Raises:
            InputError: as `call`.
        """
        return self._sentence(executor, self._record, SetBool.Request(data=wanted), timeout_s)

    def recording_to(self, executor: Executor, *, timeout_s: float = 2.0) -> str | None:
        """The path asked for the simulator's open bag; None without one or without that service.

        Raises:
            InputError: as `call`.
        """
        client, end_s = self._trigger("is_recording"), monotonic() + timeout_s
        if not self._until(executor, lambda: bool(client.service_is_ready()), end_s):
            return None
        reply = self._answer(executor, client, Trigger.Request(), end_s)
        return str(reply.message) if reply.success else None

    def set_parameters(
        self, executor: Executor, values: Mapping[str, float | str], *, timeout_s: float = 10.0
    ) -> None:
        """Set parameters of the simulator, numbers or texts.

        Raises:
            InputError: it does not answer, or refuses one.
        """
        request = SetParameters.Request(
            parameters=[Parameter(name=name, value=_value(v)) for name, v in values.items()]
        )
        end_s = monotonic() + timeout_s
        response = self._answer(executor, self._parameters, request, end_s)
        refusals = [result.reason for result in response.results if not result.successful]
        if refusals:
            raise InputError(f"the simulator refused parameters: {'; '.join(refusals)}")

    def blow(self, part: str, done: Callable[[str], None]) -> bool:
        """Ask for a blowout, without waiting.

        Args:
            part: tire or hub.
            done: called with the simulator's sentence when it answers.

        Returns:
            Whether anybody serves it.
        """
        client = self._trigger(f"blowout/{part}")
        if not client.service_is_ready():
            return False
        self.pending += 1

        def answered(future: Future[Any]) -> None:
            self.pending -= 1
            reply = future.result()
            done(reply.message if reply is not None else "no answer")

        client.call_async(Trigger.Request()).add_done_callback(answered)
        return True

    def prepare_blowouts(self, parts: set[str]) -> None:
        """Look for the services before they are needed."""
        for part in sorted(parts):
            self._trigger(f"blowout/{part}")

    def settle(self, executor: Executor, timeout_s: float) -> None:
        """Wait for answers that are still under way."""
        self.until(executor, lambda: not self.pending, timeout_s)

    def until(self, executor: Executor, done: Callable[[], bool], timeout_s: float) -> bool:
        """Spin until something is so; false after the timeout."""
        return self._until(executor, done, monotonic() + timeout_s)

    def _trigger(self, service: str) -> Client[Any, Any]:
        if service not in self._triggers:
            self._triggers[service] = self._node.create_client(Trigger, service)
        return self._triggers[service]

    def _sentence(
        self, executor: Executor, client: Client[Any, Any], request: object, timeout_s: float
    ) -> str:
        end_s = monotonic() + timeout_s
        if not self._until(executor, lambda: bool(client.service_is_ready()), end_s):
            raise InputError(f"nobody serves {client.srv_name}", expected="a running simulator")
        response = self._answer(executor, client, request, end_s)
        if not response.success:
            raise InputError(f"{client.srv_name} refused: {response.message}")
        return str(response.message)

    def _answer(
        self, executor: Executor, client: Client[Any, Any], request: object, end_s: float
    ) -> Any:  # noqa: ANN401  # the type of the service's response
        future = client.call_async(request)
        if not self._until(executor, lambda: bool(future.done()), end_s):
            client.remove_pending_request(future)
            raise InputError(f"{client.srv_name} did not answer", expected="a running simulator")
        return future.result()

    def _until(self, executor: Executor, done: Callable[[], bool], end_s: float) -> bool:
        while not done():
            if self._stopped() or monotonic() >= end_s:
                return False
            executor.spin_once(timeout_sec=0.02)
        return True


def _value(value: float | str) -> ParameterValue:
    if isinstance(value, str):
        return ParameterValue(type=ParameterType.PARAMETER_STRING, string_value=value)
    return ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=value)

"""Real nodes as processes, real messages over DDS, a domain to themselves."""

from __future__ import annotations

import fcntl
import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from types import ModuleType
from typing import IO, Any

import pytest

pytest.importorskip("rclpy", reason="rclpy is not installed")

import rclpy
from rcl_interfaces.srv import GetParameters
from rclpy.context import Context
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

from truck_blowout_sim.nodes.runtime import new_executor

REPOSITORY = Path(__file__).resolve().parents[2]
SIMULATOR = "/truck/simulator"
LATCHED = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
DEEP = QoSProfile(depth=5000, reliability=ReliabilityPolicy.RELIABLE)

TRANSPORT = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Discovery and scheduling are the machine's: twice more (RERUN) before a failure counts."""
    here = Path(__file__).parent
    if config.pluginmanager.hasplugin("rerunfailures"):  # a ROS build farm has plain pytest
        for item in (one for one in items if here in one.path.parents):
            item.add_marker(pytest.mark.flaky(reruns=2, reruns_delay=2))


def _lock_a_domain() -> tuple[int, IO[str]]:
    for domain in range(10, 100):
        handle = (Path(tempfile.gettempdir()) / f"truck_blowout_sim_domain_{domain}.lock").open("w")
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            handle.close()
        else:
            return domain, handle
    raise RuntimeError("no free ROS domain")


@pytest.fixture(scope="session")
def domain() -> Iterator[int]:
    """A ROS domain that no other test process on this machine uses."""
    number, handle = _lock_a_domain()
    os.environ.update(TRANSPORT)
    yield number
    handle.close()


class Running:
    """A node in a process of its own."""

    def __init__(self, words: list[str], env: dict[str, str], log: Path, **options: Any) -> None:  # noqa: ANN401
        self.log_path = log
        self._log = log.open("w")
        # as from a terminal, also where the tests run under nohup
        before = signal.signal(signal.SIGHUP, signal.SIG_DFL)
        self.process = subprocess.Popen(
            words, env=env, stdout=self._log, stderr=subprocess.STDOUT, **options
        )
        signal.signal(signal.SIGHUP, before)

    @property
    def output(self) -> str:
        return self.log_path.read_text()

    def wait_for(self, text: str, timeout_s: float = 300.0) -> str:
        """Wait until the node has said something; returns all it said."""
        end_s = time.monotonic() + timeout_s
        while text not in self.output:
            assert self.process.poll() is None, f"ended early:\n{self.output}"
            assert time.monotonic() < end_s, f"never said {text!r}:\n{self.output}"
            time.sleep(0.02)
        return self.output

    def stop(self, number: int = signal.SIGINT, timeout_s: float = 120.0) -> int:
        """Send a signal and return the exit status."""
        if self.process.poll() is None:
            self.process.send_signal(number)
        return self.wait(timeout_s)

    def wait(self, timeout_s: float = 300.0) -> int:
        status = self.process.wait(timeout_s)
        self._log.close()
        return status

    def kill(self) -> None:
        with suppress(ProcessLookupError):
            self.process.kill()
        self.process.wait(10)
        self._log.close()


class Start:
    """Starts nodes: start("simulator", "--initial-speed-mps", "20")."""

    def __init__(self, domain: int, folder: Path) -> None:
        self.domain = domain
        self.folder = folder
        self.running: list[Running] = []

    def __call__(self, name: str, *words: object, **options: Any) -> Running:  # noqa: ANN401
        module = f"truck_blowout_sim.nodes.{name}"
        return self.program(sys.executable, "-m", module, *words, **options)

    def program(self, *words: object, **options: Any) -> Running:  # noqa: ANN401
        """Start any program in the nodes' environment."""
        env = {
            **os.environ,
            **TRANSPORT,
            "ROS_DOMAIN_ID": str(self.domain),
            "ROS_LOG_DIR": str(self.folder / "ros_log"),
            "PYTHONPATH": str(REPOSITORY),
        }
        log = self.folder / f"{len(self.running)}.log"
        self.running.append(Running([str(word) for word in words], env, log, **options))
        return self.running[-1]

    def end(self, first: int = 0) -> None:
        """End what still runs, from a node on: asked first, so that its domain forgets it."""
        left = [node for node in self.running[first:] if node.process.poll() is None]
        for node in left:
            node.process.terminate()
        for node in left:
            try:
                node.wait(20.0)
            except subprocess.TimeoutExpired:
                node.kill()


@pytest.fixture(scope="module")
def start(domain: int, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Start]:
    """Starts nodes; ends what is left."""
    made = Start(domain, tmp_path_factory.mktemp("nodes"))
    yield made
    made.end()


@pytest.fixture(autouse=True)
def _no_node_outlives_the_test_that_started_it(request: pytest.FixtureRequest) -> Iterator[None]:
    # A test that failed leaves its nodes behind; run again, it would hear them, too. The nodes of
    # fixtures of a wider scope have been started by now.
    start = request.getfixturevalue("start") if "start" in request.fixturenames else None
    before = len(start.running) if start else 0
    yield
    if start:
        start.end(before)


class Client:
    """A node inside the test."""

    latched = LATCHED

    def __init__(self, domain: int) -> None:
        self.context = Context()
        rclpy.init(context=self.context, domain_id=domain)
        self.node = Node("test_client", context=self.context)
        self.executor = new_executor(self.context)
        self.executor.add_node(self.node)
        self._heard: list[str] = []

    def close(self) -> None:
        self.executor.shutdown()
        self.node.destroy_node()
        rclpy.shutdown(context=self.context)

    def spin(self, duration_s: float) -> None:
        end_s = time.monotonic() + duration_s
        while (left_s := end_s - time.monotonic()) > 0:
            self.executor.spin_once(timeout_sec=left_s)

    def until(self, done: Callable[[], object], timeout_s: float = 60.0, what: str = "") -> None:
        end_s = time.monotonic() + timeout_s
        while not done():
            assert time.monotonic() < end_s, f"waited {timeout_s} s for {what or done}"
            self.executor.spin_once(timeout_sec=0.05)

    def listen(self, kind: type, topic: str, qos: QoSProfile = DEEP) -> list[Any]:
        """A list that messages are appended to."""
        heard: list[Any] = []
        self._heard.append(topic)
        self.node.create_subscription(kind, topic, heard.append, qos)
        return heard

    def meet(self, node: str) -> None:
        """Wait until a node and this client know all of each other's topics.

        Discovery tells endpoints in the order in which they were made: who answers a service
        knows the readers and writers that were made before that service's client.
        """
        self.until(lambda: self.node.count_services(f"{node}/get_parameters"), what=node)
        for topic in self._heard:
            self.until(lambda topic=topic: self.node.count_publishers(topic), what=topic)
        self.call(GetParameters, f"{node}/get_parameters")

    def first(self, kind: type, topic: str, qos: QoSProfile = DEEP) -> Any:  # noqa: ANN401
        """The next message of a topic."""
        heard = self.listen(kind, topic, qos)
        self.until(lambda: heard, what=topic)
        return heard[0]

    def call(
        self, kind: type, service: str, request: object = None, timeout_s: float = 60.0
    ) -> Any:  # noqa: ANN401
        """Call a service and return its response."""
        client = self.node.create_client(kind, service)
        self.until(client.service_is_ready, timeout_s, service)
        future = client.call_async(request or kind.Request())
        self.until(future.done, timeout_s, f"answer of {service}")
        self.node.destroy_client(client)
        return future.result()

    def talk(
        self, kind: type, topic: str, qos: QoSProfile | int = 10, node: str = SIMULATOR
    ) -> Any:  # noqa: ANN401
        """A publisher that a node has found."""
        publisher = self.node.create_publisher(kind, topic, qos)
        self.until(lambda: publisher.get_subscription_count() > 0, what=f"a reader of {topic}")
        self.call(GetParameters, f"{node}/get_parameters")
        return publisher


@pytest.fixture
def client(domain: int) -> Iterator[Client]:
    made = Client(domain)
    yield made
    made.close()


@pytest.fixture(scope="module")
def module_client(domain: int) -> Iterator[Client]:
    """A client for fixtures of a module."""
    made = Client(domain)
    yield made
    made.close()


@pytest.fixture
def install(monkeypatch: pytest.MonkeyPatch) -> Callable[..., None]:
    """Puts a stand-in for a package of messages where it is imported from."""

    def put(package: str, **modules: dict[str, Any]) -> None:
        top = ModuleType(package)
        monkeypatch.setitem(sys.modules, package, top)
        for name, members in modules.items():
            module = ModuleType(f"{package}.{name}")
            for key, value in members.items():
                setattr(module, key, value)
            setattr(top, name, module)
            monkeypatch.setitem(sys.modules, f"{package}.{name}", module)

    return put

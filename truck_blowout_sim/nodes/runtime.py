"""Running a node: arguments, rclpy's life, signals, the exit status.

Exit status: 0 done (also when ended by SIGINT or SIGTERM), 2 bad usage or bad input (one line),
1 an internal failure.
"""

from __future__ import annotations

import argparse
import sys
import traceback
from collections.abc import Callable, Sequence
from typing import Any, NoReturn, Protocol

import rclpy
from rclpy._rclpy_pybind11 import RCLError
from rclpy.context import Context
from rclpy.executors import Executor, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.signals import SignalHandlerOptions

from truck_blowout_sim.errors import InputError, nearest
from truck_blowout_sim.nodes.parameters import Spec, declare
from truck_blowout_sim.nodes.signals import StopFlag

NAMESPACE = "truck"


class Program(Protocol):
    """What `run` drives."""

    def run(self, executor: Executor, stop: StopFlag) -> int:
        """Work until done or stopped; returns the exit status."""

    def close(self) -> None:
        """Finish bags and the like; rclpy still works."""


def run(
    name: str,
    specs: Sequence[Spec],
    make: Callable[[Node, dict[str, Any]], Program],
    *,
    about: str,
    stop: StopFlag,
    arguments: Sequence[str] | None = None,
    positional: str | None = None,
) -> int:
    """Run a node from its command line to its end.

    Args:
        name: name of node and program.
        specs: its parameters; each is also an option (`--real-time-factor 2`).
        make: builds the program from the node and the parameters' values.
        about: one paragraph for `--help`.
        stop: what ends the node.
        arguments: command line without the program's name; the process's own if None.
        positional: parameter that a bare argument sets.
    """
    words = list(sys.argv[1:] if arguments is None else arguments)
    try:
        stop.at_once = True
        theirs, ours = _sorted_words(words)
        options = _parse(name, specs, about, ours, positional)
        _init([name, *theirs])
        return _life(name, specs, make, options, stop)
    except InputError as error:
        print(f"{name}: {error}", file=sys.stderr)
        return 2
    except _usage_errors() as error:
        print(f"{name}: {_first_line(error)}", file=sys.stderr)
        return 2
    except Exception:  # the last door: printed in full, status 1
        if stop.interrupted:
            raise
        traceback.print_exc()
        return 1
    finally:
        stop.at_once = False
        if rclpy.ok():
            rclpy.shutdown()


def _init(words: list[str]) -> None:
    try:
        rclpy.init(args=words, signal_handler_options=SignalHandlerOptions.NO)
    except RCLError as error:
        # jazzy has no class of its own for words it cannot parse
        expected = "arguments of ROS 2 behind --ros-args"
        raise InputError(_first_line(error), expected=expected) from error


def _sorted_words(words: Sequence[str]) -> tuple[list[str], list[str]]:
    """ROS's words, from `--ros-args` to `--` or the end, and ours, in which `:=` may stand."""
    theirs: list[str] = []
    ours: list[str] = []
    inside = False
    for word in words:
        inside = inside or word == "--ros-args"
        (theirs if inside else ours).append(word)
        inside = inside and word != "--"
    return theirs, ours


def new_executor(context: Context | None = None) -> Executor:
    """The cheapest executor there is; it handles one event a `spin_once`."""
    try:
        from rclpy.experimental.events_executor import EventsExecutor
    except ImportError:
        return SingleThreadedExecutor(context=context)
    return EventsExecutor(context=context)


def _life(
    name: str,
    specs: Sequence[Spec],
    make: Callable[[Node, dict[str, Any]], Program],
    options: list[Parameter[Any]],
    stop: StopFlag,
) -> int:
    node = Node(name, namespace=NAMESPACE, parameter_overrides=options)
    executor = new_executor()
    program = None
    try:
        program = make(node, declare(node, specs))
        stop.at_once = False
        executor.add_node(node)
        return program.run(executor, stop)
    finally:
        stop.at_once = False
        if program is not None:
            program.close()
        executor.shutdown()
        node.destroy_node()


class OneLineParser(argparse.ArgumentParser):
    """A parser whose errors are one line, with the nearest option for a typo."""

    def error(self, message: str) -> NoReturn:
        """Refuse the command line.

        Raises:
            InputError: always.
        """
        expected = "options as --help shows them"
        wrong = next((w for w in message.split() if w.startswith("--")), "").split("=")[0]
        if wrong and message.startswith("unrecognized"):
            expected = nearest(wrong, self._option_string_actions, expected)
        raise InputError(message, expected=expected)


def _parse(
    name: str, specs: Sequence[Spec], about: str, words: Sequence[str], positional: str | None
) -> list[Parameter[Any]]:
    parser = OneLineParser(
        prog=name,
        description=about,
        epilog="Every option is a parameter, too: --ros-args -p name:=value, --params-file FILE.",
        argument_default=argparse.SUPPRESS,
    )
    for spec in specs:
        unit = f" [{spec.unit}]" if spec.unit else ""
        text = f"{spec.text.replace('`', '')}{unit} (default: {spec.default})".replace("%", "%%")
        if spec.name == positional:
            parser.add_argument(spec.name, nargs="?", help=text)
        elif isinstance(spec.default, bool):
            parser.add_argument(_flag(spec.name), dest=spec.name, help=text,
                                action=argparse.BooleanOptionalAction)  # fmt: skip
        elif isinstance(spec.default, list):
            parser.add_argument(_flag(spec.name), dest=spec.name, help=text, nargs="+")
        else:
            parser.add_argument(_flag(spec.name), dest=spec.name, help=text,
                                type=type(spec.default), metavar="VALUE")  # fmt: skip
    given = vars(parser.parse_args(list(words)))
    return [Parameter(key, value=value) for key, value in given.items()]


def _flag(name: str) -> str:
    return "--" + name.replace("_", "-")


def _usage_errors() -> tuple[type[Exception], ...]:
    from rclpy._rclpy_pybind11 import RCLInvalidROSArgsError, UnknownROSArgsError
    from rclpy.exceptions import InvalidParameterException, ParameterException

    return (
        RCLInvalidROSArgsError,
        UnknownROSArgsError,
        ParameterException,
        InvalidParameterException,
    )


def _first_line(error: Exception) -> str:
    return " ".join(str(error).split())

"""What a terminal user sees when a verb is asked for, fails, or is interrupted."""

from __future__ import annotations

import ast
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

import truck_blowout_sim.cli as cli
from truck_blowout_sim.cli import main as main_module
from truck_blowout_sim.cli import start
from truck_blowout_sim.cli.main import VERBS, main, ros2_verb, without_ros_arguments

ROOT = Path(__file__).resolve().parents[2]
# A verb whose module is left out of an installation is not listed.
PRESENT = [v for v, (m, _) in VERBS.items() if (ROOT / f"truck_blowout_sim/cli/{m}.py").is_file()]
AddVerb = Callable[[str], None]


@pytest.fixture
def add_verb(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> AddVerb:
    """Put one more verb, `try`, into the command line; its body is given as source."""

    def add(body: str) -> None:
        source = f"import typer\nfrom truck_blowout_sim.errors import InputError\n\n\n{body}\n"
        (tmp_path / "try_verb.py").write_text(source)

    monkeypatch.setattr(cli, "__path__", [*cli.__path__, str(tmp_path)])
    monkeypatch.setitem(VERBS, "try", ("try_verb", "Only here for the test."))
    monkeypatch.delitem(sys.modules, "truck_blowout_sim.cli.try_verb", raising=False)
    return add


def lines(text: str) -> list[str]:
    return [line for line in text.splitlines() if line.strip()]


def test_bad_input_is_one_line_and_status_2(
    add_verb: AddVerb, capsys: pytest.CaptureFixture[str]
) -> None:
    add_verb(
        "def command() -> None:\n"
        "    raise InputError('-3 Pa', file='log.csv', where='line 7', expected='a pressure')"
    )
    assert main(["try"]) == 2
    assert lines(capsys.readouterr().err) == [
        "truck-blowout: log.csv, line 7: -3 Pa; expected a pressure"
    ]


def test_ctrl_c_before_a_verb_has_begun_is_one_line_and_status_130(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def interrupted() -> int:
        raise KeyboardInterrupt

    monkeypatch.setattr(main_module, "main", interrupted)
    assert start.main() == 130
    assert lines(capsys.readouterr().err) == ["truck-blowout: interrupted"]


def test_internal_failure_is_one_line_with_its_place_and_status_1(
    add_verb: AddVerb, capsys: pytest.CaptureFixture[str]
) -> None:
    add_verb("def command() -> None:\n    1 / 0")
    assert main(["try"]) == 1
    (line,) = lines(capsys.readouterr().err)
    assert "internal failure: ZeroDivisionError" in line
    assert "try_verb.py:6" in line


@pytest.mark.parametrize("words", [["try", "--traceback"], ["--traceback", "try"]])
def test_traceback_is_shown_on_demand_wherever_the_option_stands(
    add_verb: AddVerb, capsys: pytest.CaptureFixture[str], words: list[str]
) -> None:
    add_verb("def command() -> None:\n    1 / 0")
    assert main(words) == 1
    shown = capsys.readouterr().err
    assert "Traceback (most recent call last)" in shown
    assert lines(shown)[-1].startswith("truck-blowout: internal failure")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["no_such_verb"], "no_such_verb"),
        (["--no-such-option"], "--no-such-option"),
        (["try"], "number"),
        (["try", "three"], "number"),
        (["try", "3", "--loud"], "--loud"),
    ],
)
def test_bad_usage_is_one_line_and_status_2(
    add_verb: AddVerb, capsys: pytest.CaptureFixture[str], words: list[str], said: str
) -> None:
    add_verb("def command(number: int) -> None:\n    pass")
    assert main(words) == 2
    (line,) = lines(capsys.readouterr().err)
    assert said in line.lower()
    assert "--help" in line


@pytest.mark.parametrize(
    ("raised", "status"),
    [
        ("FileNotFoundError(2, 'No such file or directory', 'a.csv')", 2),
        ("PermissionError(13, 'Permission denied', 'a.csv')", 2),
        ("OSError(28, 'No space left on device', 'a.csv')", 1),
    ],
)
def test_operating_system_errors_name_the_path(
    add_verb: AddVerb, capsys: pytest.CaptureFixture[str], raised: str, status: int
) -> None:
    add_verb(f"def command() -> None:\n    raise {raised}")
    assert main(["try"]) == status
    (line,) = lines(capsys.readouterr().err)
    assert "a.csv: " in line


def test_a_verb_may_return_its_own_status(add_verb: AddVerb) -> None:
    add_verb("def command() -> int:\n    return 5")
    assert main(["try"]) == 5


def test_success_is_status_0_and_silent_on_stderr(
    add_verb: AddVerb, capsys: pytest.CaptureFixture[str]
) -> None:
    add_verb("def command(word: str, times: int = 1) -> None:\n    print(word * times)")
    assert main(["try", "ha", "--times", "2"]) == 0
    captured = capsys.readouterr()
    assert (captured.out, captured.err) == ("haha\n", "")


def test_no_words_show_the_help_and_status_2(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([]) == 2
    assert "Usage" in capsys.readouterr().out


def test_help_lists_every_verb_and_imports_none() -> None:
    program = (
        "import atexit, runpy, sys\n"
        "def look():\n"
        "    from truck_blowout_sim.cli.main import VERBS\n"
        "    heavy = {'numba', 'numpy', 'scipy', 'matplotlib', 'rclpy', 'mcap'}\n"
        "    verbs = {f'truck_blowout_sim.cli.{module}' for module, _ in VERBS.values()}\n"
        "    print(*(heavy | verbs) & set(sys.modules), file=sys.stderr)\n"
        "atexit.register(look)\n"
        "sys.argv[1:] = ['--help']; runpy.run_module('truck_blowout_sim', run_name='__main__')\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr.strip()) == (0, ""), done.stderr
    assert len(PRESENT) >= 7
    for verb in PRESENT:
        assert f" {verb} " in done.stdout


@pytest.mark.parametrize("verb", sorted(PRESENT))
def test_every_verb_explains_itself(verb: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([verb, "--help"]) == 0
    assert f"truck-blowout {verb}" in capsys.readouterr().out


def run_slow_verb(tmp_path: Path, body: str) -> subprocess.Popen[str]:
    (tmp_path / "slow.py").write_text(f"import time\n\n\ndef command() -> None:\n{body}")
    program = (
        "import truck_blowout_sim.cli as cli; from truck_blowout_sim.cli import main as m\n"
        f"cli.__path__.append({str(tmp_path)!r}); m.VERBS['slow'] = ('slow', '')\n"
        "raise SystemExit(m.main(['slow']))"
    )
    pipe = subprocess.PIPE
    return subprocess.Popen(
        [sys.executable, "-c", program], cwd=ROOT, stdout=pipe, stderr=pipe, text=True
    )


def test_ctrl_c_ends_with_one_line_and_status_130(tmp_path: Path) -> None:
    process = run_slow_verb(tmp_path, "    print('ready', flush=True)\n    time.sleep(60)\n")
    assert process.stdout is not None
    assert process.stdout.readline() == "ready\n"
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=20)
    assert process.returncode == 130
    assert lines(errors) == ["truck-blowout: interrupted"]


def test_a_reader_that_leaves_early_is_no_failure(tmp_path: Path) -> None:
    process = run_slow_verb(
        tmp_path, "    for _ in range(100_000):\n        print('x' * 100, flush=True)\n"
    )
    assert process.stdout is not None
    process.stdout.readline()
    process.stdout.close()
    assert process.stderr is not None
    errors = process.stderr.read()
    assert (process.wait(timeout=20), errors) == (0, "")


def test_ros2_run_takes_the_verb_from_the_programs_name(
    add_verb: AddVerb, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    add_verb("def command(word: str) -> None:\n    print(word)")
    monkeypatch.setattr(sys, "argv", ["/ws/lib/truck_blowout_sim/try", "hello", "--ros-args", "-r"])
    assert ros2_verb() == 0
    assert capsys.readouterr().out == "hello\n"


@pytest.mark.parametrize(
    ("words", "kept"),
    [
        ([], []),
        (["a", "--ros-args", "-p", "x:=1"], ["a"]),
        (["a", "--ros-args", "-p", "x:=1", "--", "b"], ["a", "b"]),
        (["a", "--", "b"], ["a", "--", "b"]),
    ],
)
def test_ros_arguments_are_dropped(words: list[str], kept: list[str]) -> None:
    assert without_ros_arguments(words) == kept


def test_ros2_run_offers_the_same_verbs() -> None:
    tree = ast.parse((ROOT / "setup.py").read_text())
    (verbs,) = (
        ast.literal_eval(node.value)
        for node in tree.body
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "VERBS"
    )
    assert sorted(verbs) == sorted(main_module.VERBS)

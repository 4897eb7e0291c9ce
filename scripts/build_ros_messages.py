"""Build ROS 2 message packages into this virtual environment, without a ROS installation.

`python scripts/build_ros_messages.py FOLDER…`, each the folder of a package (with package.xml and
msg/, srv/ or action/), in the order in which they depend on each other. Needs rclpy's wheels, whose
generators write the code, and g++. Takes about a second per message.

For Autoware: https://github.com/autowarefoundation/autoware_msgs, folders autoware_control_msgs
and autoware_vehicle_msgs. test/nodes/test_real_messages.py runs with what is built.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

KINDS = ("msg", "srv", "action")
PREFIX = Path(sys.prefix)
LIBRARIES = PREFIX / "lib"
PACKAGES = Path(sysconfig.get_path("purelib"))
INDEX = PREFIX / "share" / "ament_index" / "resource_index"
SUPPORTS = ("rosidl_typesupport_fastrtps_c", "rosidl_typesupport_introspection_c",
            "rosidl_typesupport_c")  # fmt: skip
# generator: (module, class); called directly, as the wheels list each of them twice for the tool
GENERATORS = {
    "rosidl_generator_c": "GenerateC",
    "rosidl_typesupport_fastrtps_c": "GenerateFastRTPSCTypesupport",
    "rosidl_typesupport_introspection_c": "GenerateIntrospectionCTypesupport",
    "rosidl_typesupport_c": "GenerateCTypesupport",
    "rosidl_generator_py": "GeneratePython",
}


@dataclass(frozen=True)
class Package:
    """A package on its way.

    Attributes:
        name: of the package.
        source: its folder.
        work: where code is generated.
        depends: message packages that its fields come from.
    """

    name: str
    source: Path
    work: Path
    depends: tuple[str, ...]

    @property
    def interfaces(self) -> list[str]:
        """Definitions, relative to the package's folder."""
        found = [p for kind in KINDS for p in self.source.glob(f"{kind}/*.{kind}")]
        return sorted(str(path.relative_to(self.source)) for path in found)


def build(folder: Path) -> None:
    """Generate, compile and register one package."""
    with tempfile.TemporaryDirectory() as work:
        package = _package(folder, Path(work))
        _generate(package)
        _compile_libraries(package)
        _compile_python(package)
        _register(package)
    print(f"{package.name}: {len(package.interfaces)} definitions")


def _package(folder: Path, work: Path) -> Package:
    manifest = folder / "package.xml"
    name = re.search(r"<name>\s*(\w+)\s*</name>", manifest.read_text(encoding="utf-8"))
    if name is None:
        raise SystemExit(f"{manifest}: no name")
    own = Package(name[1], folder.resolve(), work, ())
    used = {"service_msgs", "action_msgs", "unique_identifier_msgs", "builtin_interfaces"}
    for path in own.interfaces:
        text = (folder / path).read_text(encoding="utf-8")
        used |= set(re.findall(r"^\s*(\w+)/\w+", text, re.MULTILINE)) - {own.name}
    missing = [one for one in used if not (INDEX / "rosidl_interfaces" / one).exists()]
    if missing:
        raise SystemExit(f"{own.name} needs {', '.join(missing)}: build it first")
    return Package(own.name, own.source, work, tuple(sorted(used)))


def _generate(package: Package) -> None:
    from rosidl_adapter.cli import TranslateActionToIDL, TranslateMsgToIDL, TranslateSrvToIDL
    from rosidl_generator_type_description.cli import HashTypeDescription

    share, definitions = [str(PREFIX / "share")], package.work / "idl"
    translators = {".msg": TranslateMsgToIDL, ".srv": TranslateSrvToIDL,
                   ".action": TranslateActionToIDL}  # fmt: skip
    for path in package.interfaces:
        made = translators[Path(path).suffix](Path(path).suffix)
        made.translate(package.name, [f"{package.source}:{path}"], share, definitions)
    files = [f"{definitions}:{Path(path).with_suffix('.idl')}" for path in package.interfaces]
    described = HashTypeDescription("type_description").generate_type_hashes(
        package.name, files, share, output_path=package.work / "hash")
    for module, cls in GENERATORS.items():
        generator: Any = getattr(import_module(f"{module}.cli"), cls)(module)
        target = package.work / module / package.name
        if module != "rosidl_generator_c":
            generator.generate(package.name, files, share, output_path=target)
            continue
        # by kind: the generator takes a message and a service of one name for the same
        for kind in KINDS:
            these, told = ([one for one in listed if f"{kind}/" in _last_two(one)]
                           for listed in (files, described))
            if these:
                generator.generate(package.name, these, share, output_path=target,
                                   type_description_files=told)


def _last_two(path: object) -> str:
    return "/".join(str(path).replace(":", "/").split("/")[-2:])


def _compile_libraries(package: Package) -> None:
    own = f"{package.name}__rosidl_generator_c"
    _library(own, package, package.work / "rosidl_generator_c", ["rosidl_runtime_c", "rcutils"],
             "__rosidl_generator_c")  # fmt: skip
    links = {
        "rosidl_typesupport_fastrtps_c": ["rosidl_typesupport_fastrtps_c", "fastcdr",
                                          "rosidl_typesupport_fastrtps_cpp"],
        "rosidl_typesupport_introspection_c": ["rosidl_typesupport_introspection_c"],
        "rosidl_typesupport_c": ["rosidl_typesupport_c"],
    }  # fmt: skip
    for support in SUPPORTS:
        _library(f"{package.name}__{support}", package, package.work / support,
                 [own, "rosidl_runtime_c", "rcutils", *links[support]], f"__{support}")  # fmt: skip


def _library(name: str, package: Package, sources: Path, links: Sequence[str], suffix: str) -> None:
    theirs = [f"{one}{suffix}" for one in package.depends]
    files = [str(p) for p in sources.rglob("*") if p.suffix in (".c", ".cpp")]
    _compile(LIBRARIES / f"lib{name}.so", files, package, [*links, *theirs])


def _compile_python(package: Package) -> None:
    made, target = package.work / "rosidl_generator_py" / package.name, PACKAGES / package.name
    (made / "__init__.py").touch()
    own = [f"{package.name}__rosidl_generator_c", f"{package.name}__rosidl_typesupport_c"]
    theirs = [f"{one}__rosidl_generator_py" for one in package.depends]
    converters = [str(path) for path in made.rglob("*_s.c")]
    shared = f"{package.name}__rosidl_generator_py"
    _compile(LIBRARIES / f"lib{shared}.so", converters, package, [*own, *theirs])
    for support in SUPPORTS:
        entry = made / f"_{package.name}_s.ep.{support}.c"
        links = [shared, *own, f"{package.name}__{support}", "rosidl_runtime_c", "rcutils"]
        _compile(made / f"{package.name}_s__{support}.so", [str(entry)], package, links)
    # last: nodes that find a package count on all of it
    shutil.rmtree(target, ignore_errors=True)
    shutil.copytree(made, target)


def _compile(output: Path, files: Sequence[str], package: Package, links: Sequence[str]) -> None:
    import numpy as np

    includes = [sysconfig.get_path("include"), np.get_include(), str(PREFIX / "include"),
                *(str(p) for p in (PREFIX / "include").iterdir() if p.is_dir()),
                *(str(package.work / module) for module in GENERATORS)]  # fmt: skip
    exports = [f"-DROSIDL_GENERATOR_C_BUILDING_DLL_{package.name}"]
    there = [link for link in links if (LIBRARIES / f"lib{link}.so").exists()]
    objects = []
    for k, file in enumerate(files):
        made = package.work / f"{output.stem}_{k}.o"
        # C and C++ by the file's ending
        standard = "-std=c++17" if file.endswith(".cpp") else "-std=c11"
        _run(["g++" if file.endswith(".cpp") else "gcc", standard, "-O1", "-fPIC", "-w", "-c", file,
              *exports, *(f"-I{path}" for path in includes), "-o", str(made)])  # fmt: skip
        objects.append(str(made))
    _run(["g++", "-shared", *objects, "-o", str(output), f"-L{LIBRARIES}",
          f"-Wl,-rpath,{LIBRARIES}", "-Wl,--no-as-needed",
          *(f"-l{link}" for link in there)])  # fmt: skip


def _run(command: Sequence[str]) -> None:
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(f"{' '.join(command[:1])} failed:\n{done.stderr[-4000:]}")


def _register(package: Package) -> None:
    """Make the package known to ament, to rclpy, and as a dependency of further packages."""
    share = PREFIX / "share" / package.name
    for path in package.interfaces:
        for found in (package.source / path, (package.work / "idl" / path).with_suffix(".idl"),
                      (package.work / "hash" / path).with_suffix(".json")):  # fmt: skip
            place = share / Path(path).parent
            place.mkdir(parents=True, exist_ok=True)
            shutil.copy(found, place)
    for module in GENERATORS:
        headers = package.work / module / package.name
        for header in headers.rglob("*.h"):
            place = PREFIX / "include" / package.name / header.relative_to(headers.parent)
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(header, place)
    shutil.copy(package.source / "package.xml", share)
    (INDEX / "packages" / package.name).touch()
    listed = "\n".join(package.interfaces)
    (INDEX / "rosidl_interfaces" / package.name).write_text(listed, encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        raise SystemExit(__doc__)
    os.environ.setdefault("AMENT_PREFIX_PATH", str(PREFIX))
    for argument in sys.argv[1:]:
        build(Path(argument))

"""The package as it is installed."""

from __future__ import annotations

import importlib.metadata
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import arcslip
from arcslip.command import PROGRAM

#: Libraries of the system that a manylinux wheel may need.
OF_SYSTEM = {"libc", "libm", "libstdc++", "libgcc_s", "libpthread", "libdl", "librt", "ld-linux-x86-64", "linux-vdso"}


def test_wheel_needs_only_what_it_carries(command: Path) -> None:
    package = Path(arcslip.__file__).parent
    assert not command.is_symlink()
    for file in [next(package.glob("_core*.so")), command]:
        text = subprocess.run(["ldd", file], capture_output=True, text=True, check=True).stdout
        for line in text.splitlines():
            name = re.split(r"[.]so|\s=>", Path(line.split()[0]).name)[0]
            path = Path(line.split(" => ")[1].split()[0]).resolve() if " => " in line else None
            assert name in OF_SYSTEM or (path and path.is_relative_to(package.parent)), line
        assert "libklu" in text and "libcholmod" in text and "libnlopt" in text and "openblas" in text
        assert "hdf5" not in text and "matio" not in text


def test_package_works_where_the_libraries_of_the_system_are_hidden(examples: Path) -> None:
    if subprocess.run(["unshare", "--mount", "true"], capture_output=True, check=False).returncode != 0:
        pytest.skip("needs a mount namespace, as root has one")
    carried = {path.name.split("-")[0] for path in Path(arcslip.__file__).parents[1].glob("arcslip.libs/*")}
    folders = [folder for folder in Path("/usr/lib").glob("*-linux-gnu") if folder.is_dir()]
    hidden = {path.resolve() for folder in folders for name in carried for path in folder.glob(f"**/{name}.so*")}
    hide = [f"mount --bind /dev/null {path}" for path in sorted(hidden)]
    code = f"import arcslip; print(arcslip.Scene({str(examples / 'blade/scene.json')!r}).run()[0].status)"
    script = "\n".join(["set -e", *hide, f'{sys.executable} -P -c "{code}"'])
    found = subprocess.run(["unshare", "--mount", "sh", "-c", script], capture_output=True, text=True, check=True)
    assert carried and found.stdout == "complete\n"


def test_command_is_installed_and_hands_on_its_exit_code(tmp_path: Path) -> None:
    script = Path(sys.executable).with_name("arcslip")
    version = subprocess.run([script, "--version"], capture_output=True, text=True, check=True).stdout
    assert arcslip.__version__ in version
    assert subprocess.run([script, "check", tmp_path / "none.json"], capture_output=True, check=False).returncode != 0


def test_wheel_is_for_glibc_2_34() -> None:
    wheel = importlib.metadata.distribution("arcslip").read_text("WHEEL") or ""
    assert re.search(r"^Tag: cp3\d+-(cp3\d+|abi3)-manylinux_2_34_x86_64$", wheel, re.MULTILINE), wheel
    assert max(versions("GLIBC"), key=numbers) <= "GLIBC_2.34" and max(versions("GLIBCXX"), key=numbers) <= "GLIBCXX_3.4.29"


def numbers(version: str) -> list[int]:
    return [int(each) for each in version.split("_")[1].split(".")]


def versions(of: str) -> set[str]:
    """The versions of symbols that the extension and the command need."""
    files = [*Path(arcslip.__file__).parent.glob("_core*.so"), PROGRAM]
    return {each.decode() for file in files for each in re.findall(rf"{of}_\d+(?:\.\d+)+".encode(), file.read_bytes())}


def test_wheel_carries_the_licences_of_its_libraries() -> None:
    config = arcslip.show_config("dicts")
    assert config is not None
    names = {each["name"] for each in config["libraries"]}
    assert {"Eigen", "NLopt", "SuiteSparse (CHOLMOD)", "CLI11", "nlohmann/json"} <= names
    texts = {name: Path(file).read_text(encoding="utf-8") for name, file in config["licences"].items()}
    expected = {"openblas", "suitesparse", "nlopt", "eigen3", "nlohmann-json3", "cli11", "sqlite3", "metis", "nanobind"}
    assert expected <= set(texts)
    assert "Lesser General Public License" in texts["suitesparse"] and "Mozilla Public License" in texts["eigen3"]
    carried = {path.name for path in Path(arcslip.__file__).parents[1].glob("arcslip.libs/*")}
    assert any("quadmath" in name for name in carried) <= any(name.startswith("gcc") for name in texts)


def test_config_is_shown(capsys: pytest.CaptureFixture[str]) -> None:
    assert arcslip.show_config() is None
    shown = capsys.readouterr().out
    assert f"version: {arcslip.__version__}" in shown and "  Eigen 3" in shown and "openblas" in shown
    with pytest.raises(ValueError, match="found mode='json'"):
        arcslip.show_config("json")  # type: ignore[call-overload]


def test_import_takes_numpy_alone() -> None:
    code = "import sys, arcslip; print(sorted({name.split('.')[0] for name in sys.modules}))"
    found = subprocess.run([sys.executable, "-P", "-c", code], capture_output=True, text=True, check=True).stdout
    assert "'numpy'" in found
    for name in ["scipy", "matplotlib", "pandas", "xarray", "tqdm", "sqlite3"]:
        assert f"'{name}'" not in found


def test_extras_are_those_of_the_metadata() -> None:
    about = importlib.metadata.metadata("arcslip")
    assert set(about.get_all("Provides-Extra") or []) == {"plot", "pandas", "ensemble", "mat", "all"}
    required = [line for line in about.get_all("Requires-Dist") or [] if "extra ==" not in line]
    assert len(required) == 1 and required[0].startswith("numpy")


def test_python_exits_without_leaks(examples: Path) -> None:
    scene = examples / "duffing/scene.json"
    code = f"import arcslip; s = arcslip.Scene({str(scene)!r}); r = s.run(); a = r[0].amplitude; del s, r, a"
    found = subprocess.run([sys.executable, "-P", "-W", "error", "-c", code], capture_output=True, text=True, check=True)
    assert "leak" not in found.stderr, found.stderr


@pytest.mark.skipif(os.name != "posix", reason="signals")
def test_signal_of_the_terminal_ends_a_computation(oscillator: dict[str, object]) -> None:
    code = (
        "import arcslip, os, signal, sys, threading, time\n"
        f"scene = arcslip.Scene({oscillator!r})\n"
        "threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()\n"
        "try:\n"
        "    scene.frf(for_each={'damper.normal_load': [float(i) for i in range(1, 20001)]})\n"
        "except KeyboardInterrupt as error:\n"
        "    print(len(error.results))\n"
    )
    found = subprocess.run([sys.executable, "-P", "-c", code], capture_output=True, text=True, timeout=30, check=True)
    assert int(found.stdout) > 0

"""Builds the wheel of Rehearse with CMake (PEP 517). It needs nothing but Python's own library.

A build folder that is there, build/release, is used where it has a module for this Python; else build/python is made.
"""

from __future__ import annotations

import base64
import hashlib
import io
import os
import re
import subprocess
import sys
import sysconfig
import tarfile
import zipfile
from pathlib import Path
from typing import Any, Optional

ROOT = Path(__file__).resolve().parents[2]


def build_wheel(wheel_directory: str, config_settings: Optional[dict[str, Any]] = None,
                metadata_directory: Optional[str] = None) -> str:
    build = _built()
    tag = f"cp{sys.version_info.major}{sys.version_info.minor}"
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    info = f"rehearse-{_version()}.dist-info"
    files = {f"rehearse/{path.name}": path.read_bytes() for path in sorted((build / "python/rehearse").iterdir())
             if path.is_file()}
    page = build / "share/rehearse/report.html"
    if page.exists():
        files["rehearse/share/report.html"] = page.read_bytes()
    files[f"{info}/METADATA"] = _metadata().encode()
    files[f"{info}/WHEEL"] = (f"Wheel-Version: 1.0\nGenerator: rehearse\nRoot-Is-Purelib: false\n"
                              f"Tag: {tag}-{tag}-{platform}\n").encode()
    files[f"{info}/entry_points.txt"] = b"[console_scripts]\nrehearse = rehearse.__main__:main\n"
    files[f"{info}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    record = f"{info}/RECORD"
    lines = [f"{name},sha256={_digest(data)},{len(data)}" for name, data in files.items()]
    files[record] = "\n".join([*lines, f"{record},,", ""]).encode()
    name = f"rehearse-{_version()}-{tag}-{tag}-{platform}.whl"
    with zipfile.ZipFile(Path(wheel_directory) / name, "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, data in files.items():
            wheel.writestr(path, data)
    return name


def build_sdist(sdist_directory: str, config_settings: Optional[dict[str, Any]] = None) -> str:
    name = f"rehearse-{_version()}"
    with tarfile.open(Path(sdist_directory) / f"{name}.tar.gz", "w:gz") as archive:
        for path in _sources():
            archive.add(ROOT / path, f"{name}/{path}")
        info = tarfile.TarInfo(f"{name}/PKG-INFO")
        info.size = len(_metadata().encode())
        archive.addfile(info, io.BytesIO(_metadata().encode()))
    return f"{name}.tar.gz"


def _sources() -> list[str]:
    """Files of the repository; where there is none, as in an unpacked archive, those that no build made."""
    if (ROOT / ".git").exists():
        return _run(["git", "ls-files"], cwd=ROOT).splitlines()
    left_out = {"PKG-INFO", "build", "runs", "__pycache__", "node_modules", ".cache"}
    paths = (path.relative_to(ROOT) for path in sorted(ROOT.rglob("*")) if path.is_file())
    return [str(path) for path in paths if not left_out.intersection(path.parts)]


def _built() -> Path:
    """The build folder, built."""
    module = f"python/rehearse/_core{sysconfig.get_config_var('EXT_SUFFIX')}"
    shared = ROOT / "build/release"
    if not (shared / module).exists():
        shared = ROOT / "build/python"
        configure(shared)
    subprocess.run(["cmake", "--build", shared, "--target", "rehearse_python_package"], check=True, env=_environment())
    if not (shared / module).exists():
        raise RuntimeError(f"{shared} has no module for {sys.executable}: remove that folder")
    subprocess.run(["cmake", "--build", shared, "--target", "page"], check=False, env=_environment())  # without npm: none
    return shared


def configure(build: Path, python: str = sys.executable) -> None:
    """Makes a build folder that has the module. Raises RuntimeError that says what is not installed."""
    said = _run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DREHEARSE_TESTS=OFF",
                 "-DREHEARSE_BENCHMARKS=OFF", f"-DPython_EXECUTABLE={python}"])
    missing = re.search("The Python module is not built: (.*)", said)
    if missing:
        raise RuntimeError(f"the module cannot be built for {python}: {missing[1]}")


def _run(command: list[Any], cwd: Optional[Path] = None) -> str:
    try:
        done = subprocess.run(command, cwd=cwd, env=_environment(), stdout=subprocess.PIPE, text=True)
    except FileNotFoundError:
        raise RuntimeError(f"{command[0]} is not installed: scripts/install-dependencies python") from None
    if done.returncode != 0:
        raise RuntimeError(f"{done.stdout}{command[0]} failed, see above")
    return done.stdout


def _environment() -> dict[str, str]:
    """Without pip's build isolation, which hides NumPy from the Python that CMake asks."""
    return {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "PYTHONNOUSERSITE")}


def _version() -> str:
    found = re.search(r"project\(rehearse VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())
    assert found, "CMakeLists.txt has no version"
    return found[1]


def _metadata() -> str:
    return (f"Metadata-Version: 2.1\nName: rehearse\nVersion: {_version()}\nRequires-Python: >=3.9\n"
            "Summary: Learn a robot's policy in a handful of trials\nRequires-Dist: numpy\n"
            "Provides-Extra: plots\nRequires-Dist: matplotlib; extra == 'plots'\n"
            "Description-Content-Type: text/markdown\n\n" + (ROOT / "README.md").read_text())


def _digest(data: bytes) -> str:
    return base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()

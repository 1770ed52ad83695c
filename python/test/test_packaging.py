"""The backend of `pip install .`, without compiling."""

import pathlib
import subprocess
import sys
import tarfile

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python/packaging"))
import backend  # noqa: E402

#: As pip's build isolation has it: nothing that is installed is seen.
HIDING = "import sys; sys.path = [path for path in sys.path if not path.endswith('-packages')]\n"


@pytest.fixture(scope="module")
def build(tmp_path_factory):
    return tmp_path_factory.mktemp("build")


def test_build_isolation_does_not_hide_numpy(build, tmp_path, monkeypatch):
    (tmp_path / "sitecustomize.py").write_text(HIDING)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    backend.configure(build)
    targets = subprocess.run(["cmake", "--build", build, "--target", "help"], capture_output=True, text=True, check=True)
    assert "\nrehearse_python_package:" in targets.stdout


def test_what_is_not_installed_is_named(build, tmp_path, monkeypatch):
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", tmp_path], check=True)
    with pytest.raises(RuntimeError, match="cannot be built for .*: it lacks NumPy of Python 3.9: scripts/install-dependencies python"):
        backend.configure(build, str(tmp_path / "bin/python"))
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(RuntimeError, match="cmake is not installed"):
        backend.configure(build)


@pytest.mark.parametrize("repository", [True, False])
def test_an_archive_has_the_sources(tmp_path, monkeypatch, repository):
    root = tmp_path / "root"
    for name in ("CMakeLists.txt", "python/packaging/backend.py", "README.md"):
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_bytes((ROOT / name).read_bytes())
    (root / "build").mkdir()
    (root / "build/made.o").write_text("")
    if repository:
        subprocess.run("git init -q && git add CMakeLists.txt python README.md", shell=True, cwd=root, check=True)
    monkeypatch.setattr(backend, "ROOT", root)
    with tarfile.open(tmp_path / backend.build_sdist(str(tmp_path))) as archive:
        names = {name.partition("/")[2] for name in archive.getnames()}
    assert names == {"CMakeLists.txt", "README.md", "PKG-INFO", "python/packaging/backend.py"}

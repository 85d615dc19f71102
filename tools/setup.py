"""Make .venv ready for the book and its tests. `make` runs this whenever the requirements have changed."""

import subprocess
import sys
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
VENV = ROOT / ".venv"
PYTHON = VENV / "bin" / "python"


def works() -> bool:
    """Tell whether .venv is whole: a set-up that was stopped half-way can leave a Python without pip."""
    try:
        return subprocess.run([PYTHON, "-m", "pip", "--version"], capture_output=True).returncode == 0
    except OSError:
        return False


def create() -> None:
    """Make a fresh .venv, or say what is missing."""
    print("Making .venv with Python {}.{}.{}".format(*sys.version_info[:3]), flush=True)
    try:
        venv.create(str(VENV), clear=True, with_pip=True)
    except (ImportError, subprocess.CalledProcessError):
        sys.exit("This Python cannot make virtual environments. On Debian or Ubuntu: sudo apt install python3-venv")


def install() -> None:
    """Install what requirements.txt names, the library itself in place."""
    print("Installing the packages of requirements.txt (the first time takes a few minutes)", flush=True)
    pip = [str(PYTHON), "-m", "pip", "install", "--disable-pip-version-check", "--quiet", "-r", "requirements.txt"]
    if subprocess.run(pip, cwd=ROOT).returncode:
        sys.exit("The packages could not be installed; the lines above say why. The same make command tries again.")


if __name__ == "__main__":
    if sys.version_info < (3, 11):  # noqa: UP036 - this is the one file that an old Python may be asked to run
        sys.exit("rlnav needs Python 3.11 or newer; this is {}.{}.".format(*sys.version_info[:2]))
    if not works():
        create()
    install()
    (VENV / "ready").touch()

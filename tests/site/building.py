"""Build a book the way `make book` does, but always from nothing."""

import fcntl
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def build(source: Path, out: Path, *options: str) -> Path:
    """Build the book in `source`, with every warning an error, and return the folder of what was built."""
    command = [Path(sys.executable).with_name("jupyter-book"), "build", source, "--path-output", out]
    run = subprocess.run([*command, "-W", "-n", "--keep-going", *options], capture_output=True, text=True)
    assert run.returncode == 0, f"the book does not build:\n{run.stdout[-2000:]}\n{run.stderr[-6000:]}"
    return out / "_build"


def once(stamp: Path, make: Callable[[], Path]) -> Path:
    """Return what `make` returns, called by the first process that comes with this stamp; the others wait for it."""
    with stamp.open("a+") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        file.seek(0)
        if made := file.read():
            return Path(made)
        folder = make()  # a failure writes nothing: who comes next sees it for himself
        file.write(str(folder))
        return folder


def pages(book: Path) -> list[Path]:
    """Return every page; the theme leaves a template of its own among the static files, which is none."""
    return [path for path in book.rglob("*.html") if "_static" not in path.parts]

"""Fetch the front-end files that the built book carries with it, so that a page never asks another site for anything.

Each package is one pinned archive of the npm registry, checked against the hash the registry publishes for it.
"""

import base64
import hashlib
import io
import os
import platform
import shutil
import sys
import tarfile
import urllib.request
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


@dataclass(frozen=True)
class Package:
    """One archive of the registry, and which of its files go where."""

    name: str
    version: str
    sha512: str
    folder: Path
    files: tuple[str, ...]  # paths inside the archive; a path that ends in / is a folder

    @property
    def url(self) -> str:
        """Where the archive lies."""
        registry = os.environ.get("npm_config_registry") or "https://registry.npmjs.org"  # noqa: SIM112 - npm's name
        return f"{registry.rstrip('/')}/{self.name}/-/{self.name.rpartition('/')[2]}-{self.version}.tgz"

    @property
    def stamp(self) -> Path:
        """The file that says which version is there; written last."""
        return self.folder / "VERSION"


# The minifier of the pages' own scripts, by system: one program, which needs nothing else.
ESBUILD = {
    ("Linux", "x86_64"): (
        "linux-x64",
        "4xTZr1FUmSoQW4XIWmit3tzQrUTZM+N3P0XV8xROKYF50XfI7xeO90+1bZvNwxIufQ9hDQVRJH5YhgPVF8A/HQ==",
    ),
    ("Linux", "aarch64"): (
        "linux-arm64",
        "pW4AC0P3it8c7do9MVM4p51FzHzdM/TZrerurgRcHJ2WTa1VQ1CIq18xncfpBJw4ojkiZZrKW2yIBWBP92j6Ug==",
    ),
    ("Darwin", "x86_64"): (
        "darwin-x64",
        "uq6suIWYP37qzGddBKPw5QEQPi6HiLGsO7UmkpfyaYNQ3D+rN6w6WfwH+nuqcGXWvawGwxOEroO4YGnFh95azw==",
    ),
    ("Darwin", "arm64"): (
        "darwin-arm64",
        "n4KqkOQrraxHJcgjM1RvwbigfQKIKJVpM7xp+KsxiyUSrRdIXnt73VhrPAx0fV44hgfmIVKjxMN9J1t5jySVkw==",
    ),
    ("Windows", "AMD64"): (
        "win32-x64",
        "5ebpxr3nWMzrL/rnUI755Jkuee0bHL/Gq0WTF9lvcpv73wAp5eu8MfBUgWK9bhWvZjj7yX8etf/8tI8Ney695g==",
    ),
}

PACKAGES = {
    # Mathematics in the pages: TeX in, HTML and its fonts out.
    "mathjax": Package(
        name="mathjax",
        version="3.2.2",
        sha512="Bt+SSVU8eBG27zChVewOicYs7Xsdt40qm4+UpHyX7k0/O9NliPc+x77k1/FEsPsjKPZGJvtRZM1vO+geW0OhGw==",
        folder=ROOT / "book/_static/vendor/mathjax",
        files=("LICENSE", "es5/tex-chtml.js", "es5/output/chtml/fonts/woff-v2/"),
    ),
    # Accessibility checks in the tests; no part of the book.
    "axe-core": Package(
        name="axe-core",
        version="4.14.1",
        sha512="FHfa+lmNjQZfJz1q8wKqIDwC6DExcHt/pkjNQb09a3NPjCKg2rhu5qb2S4r76ASyFNNtuFooJpZe37OgudVGtQ==",
        folder=ROOT / "tests/site/vendor/axe-core",
        files=("LICENSE", "axe.min.js"),
    ),
}
here = (platform.system(), platform.machine())
if here in ESBUILD:
    PACKAGES["esbuild"] = Package(
        name=f"@esbuild/{ESBUILD[here][0]}",
        version="0.28.2",
        sha512=ESBUILD[here][1],
        folder=ROOT / "tools/vendor/esbuild",
        files=("bin/esbuild", "esbuild.exe"),
    )


def fetch(package: Package) -> None:
    """Bring the package's files into its folder, unless this version is there already."""
    if package.stamp.exists() and package.stamp.read_text() == package.version:
        return
    print(f"Fetching {package.name} {package.version} from {package.url}", flush=True)
    archive = download(package.url)
    sha512 = base64.b64encode(hashlib.sha512(archive).digest()).decode()
    if sha512 != package.sha512:
        raise SystemExit(f"{package.url} is not the archive that was pinned: its sha512 is {sha512}. It was not used.")
    unpack(archive, package)
    package.stamp.write_text(package.version)


def download(url: str) -> bytes:
    """Return what lies at `url`, or stop with one clear line."""
    try:
        with urllib.request.urlopen(url, timeout=120) as answer:
            return answer.read()
    except OSError as error:
        raise SystemExit(
            f"{url} could not be read ({error}). It is needed once; npm_config_registry may name another registry."
        ) from None


def unpack(archive: bytes, package: Package) -> None:
    """Put the wanted files of the archive into the package's folder, and nothing else."""
    shutil.rmtree(package.folder, ignore_errors=True)
    folders = tuple(name for name in package.files if name.endswith("/"))
    with tarfile.open(fileobj=io.BytesIO(archive)) as members:
        for member in members:
            path = member.name.removeprefix("package/")
            if member.isfile() and (path in package.files or path.startswith(folders)):
                target = package.folder / path
                target.parent.mkdir(parents=True, exist_ok=True)
                content = members.extractfile(member)
                assert content is not None  # `isfile` has said so
                target.write_bytes(content.read())
                target.chmod(member.mode)


if __name__ == "__main__":
    for wanted in sys.argv[1:] or PACKAGES:
        if wanted == "esbuild" and wanted not in PACKAGES:
            print(f"There is no esbuild for {here}; the pages' own scripts stay as they are, a little larger.")
        else:
            fetch(PACKAGES[wanted])

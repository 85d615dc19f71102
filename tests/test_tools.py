"""The tools that set the workshop up: what they fetch is what was pinned, and when they cannot help they say why."""

import dataclasses
import io
import tarfile
from urllib.error import URLError

import pytest

import browser
import vendor


@pytest.fixture
def archive(monkeypatch):
    """A small archive in the place of the registry's, and how often it was asked for."""
    buffer = io.BytesIO()
    with tarfile.open(fileobj=buffer, mode="w:gz") as members:
        for name in ("package/LICENSE", "package/fonts/a.woff", "package/unwanted.js"):
            info = tarfile.TarInfo(name)
            info.size = 4
            members.addfile(info, io.BytesIO(b"text"))
    asked = []
    monkeypatch.setattr(vendor, "download", lambda url: asked.append(url) or buffer.getvalue())
    return buffer.getvalue(), asked


def package(folder, archive=b""):
    """A package whose hash is that of `archive`."""
    digest = vendor.base64.b64encode(vendor.hashlib.sha512(archive).digest()).decode()
    return vendor.Package("thing", "1.0", digest, folder / "thing", ("LICENSE", "fonts/"))


def test_the_wanted_files_are_unpacked_once(archive, tmp_path):
    content, asked = archive
    thing = package(tmp_path, content)
    vendor.fetch(thing)
    vendor.fetch(thing)
    files = {str(path.relative_to(thing.folder)) for path in thing.folder.rglob("*") if path.is_file()}
    assert files == {"LICENSE", "fonts/a.woff", "VERSION"}
    assert asked == ["https://registry.npmjs.org/thing/-/thing-1.0.tgz"]


def test_another_version_replaces_the_old_files(archive, tmp_path):
    content, asked = archive
    thing = package(tmp_path, content)
    vendor.fetch(thing)
    (thing.folder / "old.js").touch()
    vendor.fetch(dataclasses.replace(thing, version="2.0"))
    assert not (thing.folder / "old.js").exists()
    assert len(asked) == 2


def test_an_archive_with_another_hash_is_not_used(archive, tmp_path):
    thing = package(tmp_path, b"what was pinned")
    with pytest.raises(SystemExit, match="is not the archive that was pinned"):
        vendor.fetch(thing)
    assert not thing.folder.exists()


def test_the_registry_can_be_another_one(monkeypatch, tmp_path):
    monkeypatch.setenv("npm_config_registry", "https://npm.example.org/")
    assert package(tmp_path).url == "https://npm.example.org/thing/-/thing-1.0.tgz"


def test_without_a_network_there_is_one_clear_line(monkeypatch):
    def refuse(*args, **options):
        raise URLError("no route to host")

    monkeypatch.setattr(vendor.urllib.request, "urlopen", refuse)
    with pytest.raises(SystemExit, match=r"https://x could not be read .*no route to host"):
        vendor.download("https://x")


def test_the_browser_that_is_named_is_used(monkeypatch, tmp_path):
    chrome = tmp_path / "my chrome"
    chrome.touch(mode=0o755)
    monkeypatch.setenv("RLNAV_CHROMIUM", str(chrome))
    assert browser.find() == str(chrome)


def test_a_named_browser_that_cannot_be_run_is_an_error(monkeypatch, tmp_path):
    monkeypatch.setenv("RLNAV_CHROMIUM", str(tmp_path / "nothing"))
    with pytest.raises(SystemExit, match="RLNAV_CHROMIUM must be the path of a browser"):
        browser.find()


def test_a_browser_on_the_path_comes_before_playwrights_own(monkeypatch, tmp_path):
    monkeypatch.delenv("RLNAV_CHROMIUM", raising=False)
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr(browser, "playwrights_own", lambda: "own")
    assert browser.find() == "own"
    (tmp_path / "google-chrome").touch(mode=0o755)
    assert browser.find() == str(tmp_path / "google-chrome")


@pytest.fixture
def commands(monkeypatch):
    """The commands that would have been run; each succeeds."""
    run = []
    done = browser.subprocess.CompletedProcess([], 0)
    monkeypatch.setattr(browser.subprocess, "run", lambda command, **options: run.append(command) or done)
    return run


def test_where_system_packages_may_be_installed_the_browser_is_one_of_them(monkeypatch, commands):
    monkeypatch.setattr(browser.os, "geteuid", lambda: 0)
    monkeypatch.setattr(browser.shutil, "which", lambda name: f"/usr/bin/{name}")
    browser.bring()
    assert commands[0] == ["apt-get", "update"]
    assert commands[1][:3] == ["apt-get", "install", "-y"]
    assert "chromium" in commands[1]
    assert len(commands) == 2


def test_elsewhere_playwright_brings_its_own(monkeypatch, commands):
    monkeypatch.setattr(browser.os, "geteuid", lambda: 1000)
    browser.bring()
    assert [command[1:] for command in commands] == [["-m", "playwright", "install", "chromium"]]


def test_without_any_browser_the_tests_say_what_to_do(monkeypatch, commands):
    monkeypatch.setattr(browser, "find", lambda: None)
    with pytest.raises(SystemExit, match="sudo apt install chromium"):
        browser.main()
    assert commands, "nothing was tried"

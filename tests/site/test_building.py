"""The book is built once for all the workers of a run, and a build that failed is nobody's book."""

import time
from concurrent.futures import ThreadPoolExecutor

import pytest

from building import once


def test_who_comes_later_waits_for_what_is_being_made(tmp_path):
    made = []

    def make():
        time.sleep(0.1)  # long enough for the others to come
        made.append(tmp_path / f"book{len(made)}")
        return made[-1]

    with ThreadPoolExecutor(8) as workers:
        found = list(workers.map(lambda _: once(tmp_path / "stamp", make), range(8)))
    assert made == [tmp_path / "book0"]
    assert set(found) == {tmp_path / "book0"}


def test_a_failure_is_not_kept(tmp_path):
    def fail():
        raise AssertionError("the book does not build")

    for _ in range(2):
        with pytest.raises(AssertionError, match="does not build"):
            once(tmp_path / "stamp", fail)
    assert once(tmp_path / "stamp", lambda: tmp_path) == tmp_path

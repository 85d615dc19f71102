"""Every control of every chapter can be moved to its ends: nbval sees only what is stored, where they begin.

What an explorable does is tested in a browser; here, that it takes its own state back, as it comes from the browser.
"""

import json

import matplotlib.pyplot as plt
import pytest

import rlnav as rl
from canonical import read

from .test_chapters import chapters


@pytest.fixture
def shown(monkeypatch):
    """The Live controls that a chapter makes."""
    made = []

    class Noted(rl.widgets.Live):
        def __init__(self, *args, **settings):
            super().__init__(*args, **settings)
            made.append(self)

    monkeypatch.setattr(rl.widgets, "Live", Noted)
    return made


def ends(control):
    """The first and the last value that a control can take."""
    if hasattr(control, "options"):
        return control.options[0], control.options[-1]
    return (False, True) if isinstance(control.value, bool) else (control.min, control.max)


@pytest.fixture
def explorables(monkeypatch):
    """The explorables that a chapter makes."""
    made, prepare = [], rl.widgets.Explorable.__init__

    def noted(self, *args, **settings):
        prepare(self, *args, **settings)
        made.append(self)

    monkeypatch.setattr(rl.widgets.Explorable, "__init__", noted)
    return made


@chapters
def test_every_control_can_be_moved_to_its_ends_and_back(path, shown, explorables):
    names = {}
    with plt.rc_context():
        for cell in read(path).cells:
            if cell.cell_type == "code":
                exec(compile(cell.source, f"{path.name} {cell.id}", "exec"), names)
                plt.close("all")
        assert shown + explorables, "a chapter lets its readers move something"
        for live in shown:
            for control in live.controls.values():
                here = control.value
                for value in (*ends(control), here):
                    control.value = value  # what the function raises, this line raises
                    assert live.error is None
        for explorable in explorables:
            before = explorable.state
            explorable.set_state({"state": json.loads(json.dumps(before))})
            assert explorable.state == before

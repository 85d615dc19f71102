"""Every control of every chapter can be moved to its ends: nbval sees only what is stored, where they begin."""

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


@chapters
def test_every_control_can_be_moved_to_its_ends_and_back(path, shown):
    names = {}
    with plt.rc_context():
        for cell in read(path).cells:
            if cell.cell_type == "code":
                exec(compile(cell.source, f"{path.name} {cell.id}", "exec"), names)
                plt.close("all")
        assert shown, "a chapter lets its readers move something"
        for live in shown:
            for control in live.controls.values():
                here = control.value
                for value in (*ends(control), here):
                    control.value = value  # what the function raises, this line raises
                    assert live.error is None

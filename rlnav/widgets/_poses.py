"""Poses and headings as plain data in the state of an explorable, and checked."""

from __future__ import annotations

from typing import Any

from .._check import fail, items
from ..robot import HEADINGS, Pose
from . import _scenario


def listed(pose: Any) -> Any:
    """Return a pose as a state holds it; anything else stays what it is, to be refused where the state is checked."""
    return [pose.x, pose.y, pose.theta] if isinstance(pose, Pose) else pose


def pose_of(value: Any) -> Pose:
    """Return the pose that a state holds."""
    numbers = items("pose", value, "a pose [x, y, theta]")
    if len(numbers) != 3:
        fail("pose", "a pose [x, y, theta]", f"{len(numbers)} numbers")
    return Pose(*numbers)


def check_heading(heading: Any) -> None:
    """Refuse what is neither a heading nor None, which stands for all of them."""
    if heading is not None:
        _scenario.one_of("heading", str(heading), [str(theta) for theta in HEADINGS])

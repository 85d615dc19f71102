"""What readers operate: controls that drive Python, and explorables that run in the browser."""

try:
    import anywidget as _anywidget  # noqa: F401
    import ipywidgets as _ipywidgets  # noqa: F401
except ImportError as missing:
    raise ImportError("`rlnav.widgets` needs anywidget. Install it with: pip install 'rlnav[widgets]'") from missing

from ._backup_diagram import BackupDiagram
from ._explorable import Explorable
from ._live import Live
from ._loop_debugger import LoopDebugger
from ._merging_paths import MergingPaths
from ._one_update import OneUpdate
from ._simulator import Simulator
from ._step_sizes import StepSizes
from ._value_wave import ValueWave

__all__ = [
    "BackupDiagram",
    "Explorable",
    "Live",
    "LoopDebugger",
    "MergingPaths",
    "OneUpdate",
    "Simulator",
    "StepSizes",
    "ValueWave",
]

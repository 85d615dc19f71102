"""What readers operate: controls that drive Python, and explorables that run in the browser."""

try:
    import anywidget as _anywidget  # noqa: F401
    import ipywidgets as _ipywidgets  # noqa: F401
except ImportError as missing:
    raise ImportError("`rlnav.widgets` needs anywidget. Install it with: pip install 'rlnav[widgets]'") from missing

from ._backup_diagram import BackupDiagram
from ._explorable import Explorable
from ._feature_picker import FeaturePicker
from ._live import Live
from ._loop_debugger import LoopDebugger
from ._one_update import OneUpdate
from ._simulator import Simulator
from ._steering_fan import SteeringFan
from ._value_wave import ValueWave

__all__ = [
    "BackupDiagram",
    "Explorable",
    "FeaturePicker",
    "Live",
    "LoopDebugger",
    "OneUpdate",
    "Simulator",
    "SteeringFan",
    "ValueWave",
]

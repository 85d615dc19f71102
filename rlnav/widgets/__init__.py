"""What readers operate: controls that drive Python, and explorables that run in the browser."""

try:
    import anywidget as _anywidget  # noqa: F401
    import ipywidgets as _ipywidgets  # noqa: F401
except ImportError as missing:
    raise ImportError("`rlnav.widgets` needs anywidget. Install it with: pip install 'rlnav[widgets]'") from missing

from ._aliasing import Aliasing
from ._backup_diagram import BackupDiagram
from ._contraction import Contraction
from ._control_tour import ControlTour
from ._explorable import Explorable
from ._feature_picker import FeaturePicker
from ._live import Live
from ._loop_debugger import LoopDebugger
from ._merging_paths import MergingPaths
from ._mystery_robot import MysteryRobot
from ._one_update import OneUpdate
from ._paint_policy import PaintPolicy
from ._policy_iteration import PolicyIteration
from ._return_line import ReturnLine
from ._reward_mixer import RewardMixer
from ._simulator import Simulator
from ._steering_bandit import SteeringBandit
from ._steering_fan import SteeringFan
from ._step_sizes import StepSizes
from ._value_wave import ValueWave

__all__ = [
    "Aliasing",
    "BackupDiagram",
    "Contraction",
    "ControlTour",
    "Explorable",
    "FeaturePicker",
    "Live",
    "LoopDebugger",
    "MergingPaths",
    "MysteryRobot",
    "OneUpdate",
    "PaintPolicy",
    "PolicyIteration",
    "ReturnLine",
    "RewardMixer",
    "Simulator",
    "SteeringBandit",
    "SteeringFan",
    "StepSizes",
    "ValueWave",
]

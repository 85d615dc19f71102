"""Controls for notebooks: move one, and Python draws again."""

from ._live import Live
from ._simulator import Simulator

__all__ = ["Live", "Simulator"]

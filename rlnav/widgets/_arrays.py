"""Arrays on their way to the browser, as JSON; `rlnav/js/views/arrays.js` reads them."""

from __future__ import annotations

import base64
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

TYPES = ("uint8", "int32", "float32", "float64")


def pack(array: ArrayLike, dtype: str) -> dict[str, Any]:
    """Write an array as base64 of its little-endian bytes.

    What repeats along the first axes, as numbers that NumPy has broadcast, is written once: the reader repeats it.

    Examples
    --------
    >>> pack([[1, 2]] * 3, "uint8")
    {'dtype': 'uint8', 'shape': [3, 2], 'data': 'AQIBAgEC'}
    >>> pack(np.broadcast_to([1, 2], (3, 2)), "uint8")
    {'dtype': 'uint8', 'shape': [3, 2], 'data': 'AQI='}
    """
    x = np.asarray(array)
    shape = list(x.shape)
    while x.ndim and x.strides[0] == 0 and len(x):
        x = x[0]
    little = np.ascontiguousarray(x, np.dtype(dtype).newbyteorder("<"))
    return {"dtype": dtype, "shape": shape, "data": base64.b64encode(little.tobytes()).decode()}

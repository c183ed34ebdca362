"""Records as plain data, and as JSON: what does not exist is null."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from typing import Any


def plain_data(value: Any) -> Any:
    """Named tuples as mappings, sequences as lists, NaN as None, in any depth.

    >>> from vstatics.model.parts import Load
    >>> plain_data({"load": Load(2000.0), "steps": (1.5, math.nan)})
    {'load': {'speed': 2000.0, 'torque': None}, 'steps': [1.5, None]}
    """
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, tuple) and hasattr(value, "_asdict"):
        value = value._asdict()
    if isinstance(value, Mapping):
        return {key: plain_data(one) for key, one in value.items()}
    if isinstance(value, Sequence) and not isinstance(value, str):
        return [plain_data(one) for one in value]
    return value


def json_text(value: Any, indent: int = 1) -> str:
    """The same as JSON."""
    return json.dumps(plain_data(value), indent=indent, ensure_ascii=False, allow_nan=False) + "\n"

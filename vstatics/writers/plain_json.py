"""Records as plain data, and as JSON: what does not exist is null."""

from __future__ import annotations

import json
import math
import os
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


def with_file(document: dict[str, Any], file: str) -> dict[str, Any]:
    """A document that tells the file of its case, without folders.

    >>> with_file({"format": "f", "version": 1, "case": {}}, "cases/box.yaml")
    {'format': 'f', 'version': 1, 'file': 'box.yaml', 'case': {}}
    """
    front: dict[str, Any] = {key: document[key] for key in ("format", "version") if key in document}
    return {**front, "file": os.path.basename(file), **document}  # noqa: PTH119


def text(value: Any) -> str:
    """Plain data as JSON on many lines, without the end of the last."""
    return _lines(value)


def line(value: Any) -> str:
    """Plain data as JSON on one line, with its end."""
    return _line(value) + "\n"


_lines = json.JSONEncoder(ensure_ascii=False, allow_nan=False, indent=1).encode
_line = json.JSONEncoder(ensure_ascii=False, allow_nan=False).encode

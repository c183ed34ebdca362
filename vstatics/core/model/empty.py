"""Empty mapping, the default value of parts, states and parameters."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Never, NoReturn


class _Empty(dict[Any, Never]):
    """Mapping that stays empty. `types.MappingProxyType` can neither be pickled nor copied."""

    def _refuse(self, *_: Any, **__: Any) -> NoReturn:
        raise TypeError("this mapping cannot be changed")

    __setitem__ = setdefault = update = __ior__ = _refuse

    def __reduce__(self) -> str:
        return "EMPTY"


EMPTY: Mapping[Any, Never] = _Empty()
"""Empty mapping that cannot be changed."""

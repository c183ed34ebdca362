"""What a transmission consists of, before it is checked; what can be asked of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:  # who has none does without
    pass

"""A case and its results as one page of HTML, which needs nothing from elsewhere."""

from __future__ import annotations

from vstatics.report.gathering import Material, gather
from vstatics.report.page import page

__all__ = ["Material", "gather", "page"]

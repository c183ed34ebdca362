"""What axe-core has against a page in a window."""

from pathlib import Path
from typing import Any

import pytest


def serious_faults(window: Any) -> dict[str, list[str]]:
    """Rules of which a break is serious or critical, each with places where it is broken."""
    axe = pytest.importorskip("axe_core_python")
    rules = Path(axe.__file__).with_name("axe.min.js").read_text("utf-8")
    window.evaluate(rules)
    found = window.evaluate("axe.run({ resultTypes: ['violations'] })")["violations"]
    return {
        one["id"]: [node["html"][:200] for node in one["nodes"]][:3]
        for one in found
        if one["impact"] in ("serious", "critical")
    }

"""Commented cases to start from: the files of the folder `templates`."""

from __future__ import annotations

from importlib.resources import files

TEMPLATES = (
    "planetary",
    "double_planet",
    "stepped",
    "ravigneaux",
    "planet_group",
    "simpson",
    "lepelletier",
    "countershaft",
    "drive_axle",
    "power_split",
    "worm",
)
"""Their names, the simplest first."""


def template(name: str) -> str:
    """The text of a template.

    >>> template("ravigneaux").splitlines()[0]
    '# A Ravigneaux set: the small sun meshes with the short planets, these with the long planets,'
    """
    return (files("vstatics.cli") / "templates" / f"{name}.yaml").read_text(encoding="utf-8")

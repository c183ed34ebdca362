"""`vstatics new`: a commented case to start from: a template, or a case that is shipped."""

from __future__ import annotations

from importlib import resources

import click

from vstatics.cli.frame import files
from vstatics.cli.frame.values import value
from vstatics.errors import ReadError, nearest, of_file
from vstatics.examples import example_file, example_files
from vstatics.jobs.files import STDOUT
from vstatics.readers import format_of_name

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
    """The text of a template, or of an example of this name.

    >>> template("ravigneaux").splitlines()[0]
    '# A Ravigneaux set: the small sun meshes with the short planets, these with the long planets,'
    """
    if name not in TEMPLATES:
        return example_file(name).data().decode()
    return (resources.files("vstatics.cli") / "templates" / f"{name}.yaml").read_text(
        encoding="utf-8"
    )


def _known(name: str) -> str:
    """The name of a template or an example, or wrong use that tells the nearest."""
    known = [*TEMPLATES, *example_files()]
    if name not in known:
        names, hint = ", ".join(TEMPLATES), nearest(name, known)
        raise ValueError(
            f"{name!r} is no template; expected one of {names}, or the name of a shipped case{hint}"
        )
    return name


@click.command()
@click.argument("target", type=click.Path(), metavar="[FILE]", default=STDOUT)
@click.option(
    "-t",
    "--template",
    "name",
    metavar="NAME",
    default=TEMPLATES[0],
    show_default=True,
    callback=value(_known),
    help=f"One of {', '.join(TEMPLATES)}; or a shipped case by its name, as zf-8hp70.",
)
def new(target: str, name: str) -> None:
    """Write a commented case of typical elements to FILE, or to standard output.

    \b
    Examples:
      vstatics new gearbox.yaml --template ravigneaux
      vstatics new gearbox.yaml --template zf-8hp70
      vstatics run gearbox.yaml

    A file that is there already is left as it is, and the exit status is 1. A scenario,
    as scenarios/tarasik-box, speaks of its case by ../NAME.yaml, a folder above it, which a
    second command writes: vstatics new ../tarasik-box.yaml -t tarasik-box
    """
    kind = format_of_name(target)
    if kind not in (None, "yaml"):
        message = f"is the name of a {kind} by its suffix, but a template is YAML; expected .yaml"
        raise ReadError([of_file("E015", target, message)])
    files.refuse_existing(target)
    files.write_output(template(name), target)

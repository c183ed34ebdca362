"""`vstatics new`: a commented case to start with, from a template or a shipped case."""

from __future__ import annotations

import os
import shlex
from importlib import resources

import click

from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.options import command, completing
from vstatics.core.cli.shared.values import FILE, value
from vstatics.core.errors import ReadError, of_file
from vstatics.core.examples import example_file, example_files
from vstatics.core.jobs.files import STDOUT
from vstatics.core.readers import format_of, format_of_name
from vstatics.core.suggestions import nearest

TEMPLATES = (
    "planetary",
    "double_planet",
    "stepped",
    "ravigneaux",
    "planet_group",
    "simpson_train",
    "lepelletier",
    "countershaft",
    "drive_axle",
    "input_split",
    "worm",
)
"""Names of templates, simplest first. No shipped case has the name of a template."""


def template(name: str, suffix: str = ".yaml") -> str:
    """Return the text of a template or shipped case, with the suffix `.dat` as a deck if possible.

    >>> template("ravigneaux").splitlines()[0]
    '# A Ravigneaux set: the small sun meshes with the short planets, these with the long planets,'
    """
    if name not in TEMPLATES:
        file = example_file(name)
        other = os.path.splitext(file.path)[0] + suffix  # noqa: PTH122
        return file._replace(path=other if os.path.exists(other) else file.path).data().decode()  # noqa: PTH110
    return (resources.files("vstatics.core.cli") / "templates" / f"{name}.yaml").read_text(
        encoding="utf-8"
    )


def _known(name: str) -> str:
    """Return the exact name of a template or shipped case. An unknown name is an error.

    >>> _known("drive-axle"), _known("power_split")
    ('drive_axle', 'power-split')
    """
    known = [*TEMPLATES, *example_files()]
    alike = {spelling.replace("_", "-"): spelling for spelling in known}
    name = alike.get(name.replace("_", "-"), name)
    if name not in known:
        names, hint = ", ".join(TEMPLATES), nearest(name, known)
        raise ValueError(
            f"{name!r} is not a template; expected one of {names}, or the name of a "
            f"shipped case{hint}"
        )
    return name


@command
@click.argument("target", type=FILE, metavar="[FILE]", default=STDOUT)
@click.option(
    "-t",
    "--template",
    "name",
    metavar="NAME",
    default=TEMPLATES[0],
    show_default=True,
    callback=value(_known),
    shell_complete=completing(lambda: [*TEMPLATES, *example_files()]),
    help=f"Template to write: {', '.join(TEMPLATES)}; or the name of a shipped case, such as "
    "zf-8hp70.",
)
def new_command(target: str, name: str) -> None:
    """Write a commented case to FILE, or to standard output.

    A template is a small case that explains its keys in comments. A shipped case is a
    gearbox from the literature. The MZKT 7922 exists also as a deck of Visual-Statics. To
    list all names, press Tab after --template (needs completion, see `vstatics --help`).

    \b
    Examples:
      vstatics new --template ravigneaux
      vstatics new simpson.yaml --template simpson_train
      vstatics new zf.yaml --template zf-8hp70
      vstatics new mzkt.dat --template mzkt7922

    Missing folders of FILE are created. An existing file is not overwritten. The exit
    status is then 1.

    A scenario names its case, which must be written, too:

    \b
      vstatics new scenarios/upshift.yaml --template scenarios/8hp70-upshift
      vstatics new driveline-8hp70.yaml --template driveline-8hp70
      vstatics simulate scenarios/upshift.yaml
    """
    if target in {*TEMPLATES, *example_files()}:
        raise click.UsageError(f"{target} is a template, not a file: expected --template {target}")
    kind = format_of_name(target)
    text = template(name, os.path.splitext(target)[1])  # noqa: PTH122
    if kind not in (None, "yaml") and not (kind == "deck" and format_of("", text.encode()) == kind):
        yaml = f"{os.path.splitext(target)[0]}.yaml"  # noqa: PTH122
        message = (
            f"has the suffix of {kind}, but a template is YAML: create {yaml}, and convert it "
            f"with `{shlex.join(['vstatics', 'convert', yaml, target])}`"
        )
        raise ReadError([of_file("E015", target, message)])
    files.refuse_existing(target)
    if folder := os.path.dirname(target):  # noqa: PTH120
        os.makedirs(folder, exist_ok=True)  # noqa: PTH103
    files.write_output(text, target)

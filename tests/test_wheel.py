"""The wheel in a fresh environment: what works without extras, and what asks for one.

`make dist` gives the wheel that it has built; without it one is built here.
"""

import json
import os
import re
import shlex
import subprocess
import sys
import tomllib
import zipfile
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

import pytest

from tests.commands import ID, ROOT
from tests.installed import ANNEXES, needs
from vstatics.core.annexes import picture_kinds
from vstatics.core.cli.new import TEMPLATES
from vstatics.core.extras import BESIDES, EXTRAS, SLOWER_WITHOUT, __version__

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]

DUMPED = "{J1: 3, J2: .06, J3: .4, J4: .4, J5: 12, E: 71e-5, M_C0: 1020, M_phi: 1080, omega1: 135}"
"""A clutch."""


METHOD = " --method lhs"

WORKS = (
    "vstatics --version",
    "vstatics new case.yaml",
    "vstatics run case.yaml --pretty",
    "vstatics new box.yaml -t zf-8hp70 && vstatics run box.yaml",
    "@ vstatics.solve(vstatics.example('zf-8hp70')) and vstatics.example('scenarios/tarasik-box')",
    *(f"vstatics run case.yaml -f {form}" for form in ("listing", "csv", "jsonl")),
    "vstatics run case.yaml -f json -o result.json",
    "vstatics compare result.json result.json",
    "vstatics check case.yaml",
    "vstatics summary case.yaml -o out.csv && vstatics flow case.yaml -o out.md",
    "vstatics convert case.yaml case.json",
    "vstatics sweep case.yaml --vary P1.ratio=-3:-2 --sample 4 --method random",
    "vstatics sweep case.yaml --vary P1.ratio=-3:-2:3 -o out.npz",
    "python -m vstatics run result.json",
    f"echo '{DUMPED}' | vstatics torsion dump - --rate 50",
    "@ vstatics.solve(case)._repr_html_()",
    "@ vstatics.explain_gear(vstatics.solve(case), 'low')",
    "@ vstatics.write_report(vstatics.solve(case), 'report.html')",
    *(f"vstatics new --template {name} | vstatics run -" for name in TEMPLATES),
)
"""What everybody does, in a folder of its own and in this order."""

IN_TORSION = (
    *("modes case.yaml", "modes nowhere.yaml -f json -o out.json", "reduce case.yaml --to 1"),
    "simplify case.yaml --gear low --links 2 -o out.yaml",
    "response case.yaml --at 1 --orders 2 --speed 600:3000:9",
    "identify case.yaml --gear low --omega 20",
    "damping case.yaml --gear low --decrements shaft=.1",
)
BOXES = "vstatics synth box --sets 1 --shift-elements 2 --engaged 1 --ratios 3,1"
SWEEP = "vstatics sweep case.yaml --vary P1.ratio=-3,-2"
REFUSED = {
    "sample": (
        *(f"vstatics sweep case.yaml --vary P1.ratio=-3:-2 --sample 4{m}" for m in ("", METHOD)),
        "@ vstatics.sweep(case, {'P1.ratio': '-3:-2'}, sample=4)",
    ),
    "parquet": ("vstatics run case.yaml -o out.parquet", f"{SWEEP} -o out.parquet"),
    "dask": (f"{SWEEP} --scheduler tcp://127.0.0.1:9",),
    "pandas": (
        "@ vstatics.solve(case).to_dataframe()",
        "@ next(iter(vstatics.sweep(case, {'P1.ratio': [-3]}))).to_dataframe()",
        "@ vstatics.sweep(case, {'P1.ratio': [-3]}).to_dataframe()",
    ),
    "xarray": (
        "@ vstatics.solve(case).to_xarray()",
        "@ vstatics.sweep(case, {'P1.ratio': [-3]}).to_xarray()",
    ),
    "plot": (
        *(
            f"vstatics plot case.yaml --kind {kind} -o out.svg"
            for kind, own in picture_kinds().items()
            if not own.plots
        ),
        "@ vstatics.plot(vstatics.solve(case), 'stick')",
        "@ vstatics.solve(case).plot('lever')",
    ),
    "torsion": (
        f"{SWEEP} --out 'omega[1,low]'",
        "vstatics damage rayleigh --endurance 2 --deviation 1 --exponent 3 --cycles 1e6",
        *(f"vstatics torsion {command}" for command in IN_TORSION),
    ),
    "simulation": (
        "vstatics simulate case.yaml",
        "vstatics simulate nowhere.yaml -o out.csv",
    ),
    "boxes": (
        *(f"{BOXES}{more}" for more in ("", " --dry-run", " -o found/")),
        "@ from vstatics import synthesis as own; own.find_boxes(own.BoxSearch(1, 2, 1, (3.0, 1.0)))",
    ),
    "xlsx": (
        "vstatics convert case.yaml box.xlsx",
        *(
            f"vstatics {word} case.yaml -o out.xlsx"
            for word in ("run", "summary", "flow", "explain")
        ),
    ),
}
"""What an extra brings and nothing is left of without it; `@` starts a Python expression."""
LESS = {
    "formula": ("vstatics explain case.yaml --gear low", "vstatics explain case.yaml -f json"),
    "plot": ("vstatics report case.yaml -o report.html",),
}
"""What does the rest and says what it leaves out."""


IN_ONE_PROCESS = """\
import json, shlex, sys
from click.testing import CliRunner
from vstatics.core.cli import main
for command in sys.argv[1:]:
    done = CliRunner().invoke(main, shlex.split(command)[1:])
    print(json.dumps([done.exit_code, done.output]))
"""
"""Calls commands; to start a process for each takes longer."""


class Done(NamedTuple):
    """What a command did."""

    status: int
    printed: str
    """On both streams."""

    def __str__(self) -> str:
        return f"exit status {self.status}\n{self.printed}"


@pytest.fixture(scope="module")
def wheel(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    given = request.config.getoption("--wheel")
    if given:
        return Path(given).resolve()
    folder = tmp_path_factory.mktemp("dist")
    subprocess.run(
        [sys.executable, "-m", "build", "--wheel", "--outdir", folder, ROOT],
        check=True,
        capture_output=True,
    )
    [built] = folder.glob("*.whl")
    return built


class Fresh:
    """A virtual environment with the wheel and what it depends on, and a folder for files."""

    def __init__(self, folder: Path, wheel: Path) -> None:
        self.folder = folder
        self.programs = folder / "environment" / "bin"
        made = self.programs.parent
        subprocess.run([sys.executable, "-m", "venv", "--without-pip", made], check=True)
        pip = [sys.executable, "-m", "pip", "--python", str(made), "install", "--no-compile"]
        subprocess.run([*pip, "-q", "--disable-pip-version-check", wheel], check=True)

    def run(self, command: str) -> Done:
        """What a command of the shell does, or a Python expression behind `@`."""
        if command.startswith("@ "):
            (self.folder / "expression.py").write_text(
                "import vstatics\ncase = vstatics.load('case.yaml')\n"
                f"try:\n    {command[2:]}\n"
                "except vstatics.CaseError as error:\n    raise SystemExit(error)\n",
                "utf-8",
            )
            command = "python expression.py"
        environment = {name: text for name, text in os.environ.items() if "PYTHON" not in name}
        done = subprocess.run(
            ["sh", "-c", command],
            cwd=self.folder,
            env={**environment, "PATH": f"{self.programs}{os.pathsep}{os.environ['PATH']}"},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            check=False,
            timeout=60,
        )
        return Done(done.returncode, done.stdout.decode())

    def answers(self, commands: Sequence[str]) -> Iterator[tuple[str, Done]]:
        """The same for several: commands of vstatics alone share a process."""
        shared = [command for command in commands if command.startswith("vstatics ")]
        called = self.run(shlex.join(["python", "-c", IN_ONE_PROCESS, *shared]))
        for command, line in zip(shared, called.printed.splitlines(), strict=True):
            yield command, Done(*json.loads(line))
        for command in commands:
            if command not in shared:
                yield command, self.run(command)


@pytest.fixture(scope="module")
def fresh(tmp_path_factory: pytest.TempPathFactory, wheel: Path) -> Fresh:
    made = Fresh(tmp_path_factory.mktemp("fresh"), wheel)
    assert made.run("vstatics new case.yaml").status == 0
    return made


def asks_for(extra: str) -> str:
    """The words that name a missing package and how it is installed."""
    packages = EXTRAS[extra], *BESIDES.get(extra, ())
    needed = next(package for package in packages if package not in SLOWER_WITHOUT)
    in_source = f'pip install ".[{extra}]" in the source folder'
    return f"needs the package {needed}: {in_source}, or pip install {' '.join(packages)}"


def test_extras_are_those_of_the_project_and_are_tried() -> None:
    """Who adds an extra says in REFUSED or LESS what needs it, and in the docs what it brings."""
    extras = set(EXTRAS)
    given = PROJECT["optional-dependencies"]
    assert extras == given.keys() - {"all", "docs", "dev"}
    assert set(re.findall(r"\w+", given["all"][0])) == {"vstatics", *extras}
    assert extras == REFUSED.keys() | LESS.keys()
    text = (ROOT / "docs" / "commands.md").read_text("utf-8")
    section = text.partition("\n## Extras\n")[2].partition("\n## ")[0]
    assert extras == set(re.findall(r"^\| `(\w+)` \|", section, re.MULTILINE))


def has_every_file_of_the_package(wheel: Path) -> None:
    """The shipped cases are in the package there, for `vstatics.example`."""
    inside = [*(ROOT / "vstatics").rglob("*"), *(ROOT / "cases").rglob("*")]
    files = {str(path.relative_to(ROOT)) for path in inside if path.is_file()}
    files = {name.replace("cases/", "vstatics/cases/", name.startswith("cases/")) for name in files}
    with zipfile.ZipFile(wheel) as archive:
        packed = {name for name in archive.namelist() if name.startswith("vstatics/")}
    assert packed == {name for name in files if "__pycache__" not in name}


def does_the_daily_work_without_extras(fresh: Fresh) -> None:
    (fresh.folder / "case.yaml").unlink(missing_ok=True)
    for command in WORKS:
        done = fresh.run(command)
        assert done.status == 0, f"{command}: {done}"
        assert "Traceback" not in done.printed
    assert f"version {__version__}" in fresh.run("vstatics --version").printed


def refuses_in_one_line_what_an_extra_brings(fresh: Fresh) -> None:
    for extra, commands in REFUSED.items():
        for command, done in fresh.answers(commands):
            assert done.status == 1, f"{command}: {done}"
            [line] = done.printed.splitlines()
            assert ID.sub("", line).endswith(asks_for(extra)), f"{command}: {done}"


def says_what_is_left_out_without_an_extra(fresh: Fresh) -> None:
    for extra, commands in LESS.items():
        for command, done in fresh.answers(commands):
            assert done.status == 0, f"{command}: {done}"
            told = " ".join(done.printed.replace('\\"', '"').split())
            assert asks_for(extra) in told, f"{command}: {done}"
            assert "Traceback" not in done.printed


@pytest.mark.slow
@needs(*ANNEXES)
def test_the_wheel_in_a_fresh_environment(wheel: Path, fresh: Fresh) -> None:
    """One test, so that processes of pytest do not each make a wheel and an environment."""
    has_every_file_of_the_package(wheel)
    does_the_daily_work_without_extras(fresh)
    refuses_in_one_line_what_an_extra_brings(fresh)
    says_what_is_left_out_without_an_extra(fresh)

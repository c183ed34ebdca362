"""The jobs of docs/ci.md, run as printed but for the installation."""

import os
import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest
import yaml

from tests.commands import CASES, NEUTRAL, ROOT
from tests.test_readme import prepared

PAGE = (ROOT / "docs" / "ci.md").read_text("utf-8")
JOBS: dict[str, Any] = {
    block.partition("\n")[0].removeprefix("# "): yaml.safe_load(block)
    for block in re.findall(r"^```\n(# \.git.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
}


def github(job: dict[str, Any]) -> list[str]:
    """Return the shell scripts of the steps; the job fails if any fails."""
    return [step["run"] for step in job["jobs"]["check"]["steps"] if "run" in step]


def gitlab(job: dict[str, Any]) -> list[str]:
    """Return the lines of the job as one script."""
    lines = [line for line in job["gearboxes"]["script"] if not line.startswith("pip ")]
    return ["\n".join(lines)]


SCRIPTS = {
    "GitHub": [*github(JOBS[".github/workflows/gearboxes.yml"])],
    "GitLab": [*gitlab(JOBS[".gitlab-ci.yml"])],
}


def status(folder: Path, system: str) -> int:
    """Return the status of a job: the largest of its steps."""
    environment = {
        **os.environ,
        "PATH": f"{folder / '.bin'}{os.pathsep}{os.environ['PATH']}",
        "PYTHONPATH": str(ROOT),
        "GITHUB_STEP_SUMMARY": str(folder / "summary.md"),
    }
    return max(
        subprocess.run(
            ["bash", "-e", "-c", script], cwd=folder, env=environment, check=False
        ).returncode
        for script in SCRIPTS[system]
        if not script.startswith("pip ")
    )


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("bash") is None, reason="the jobs are for a shell")
@pytest.mark.parametrize("system", SCRIPTS)
def test_a_job_is_green_until_a_gear_cannot_drive_or_a_number_changes(
    system: str, tmp_path: Path
) -> None:
    folder = prepared(tmp_path)
    (folder / "boxes").mkdir()
    box = folder / "boxes" / "box.yaml"
    shutil.copy(CASES / "simpson.yaml", box)
    command = [
        str(folder / ".bin/vstatics"),
        "run",
        str(box),
        *["-q", "-o", "golden/", "-f", "json"],
    ]
    subprocess.run(command, cwd=folder, env={**os.environ, "PYTHONPATH": str(ROOT)}, check=True)
    assert status(folder, system) == 0
    other = folder / "boxes" / "other.yaml"
    other.write_text(NEUTRAL, "utf-8")
    assert status(folder, system) == 1
    other.unlink()
    box.write_text(box.read_text("utf-8").replace("ring: 73", "ring: 75"), "utf-8")
    assert status(folder, system) == 1

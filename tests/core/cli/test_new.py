"""`vstatics new`: templates of cases."""

import re
import shlex
from pathlib import Path

import pytest

from tests.commands import vstatics
from tests.installed import needs
from vstatics.core.cli.new import TEMPLATES, template
from vstatics.core.examples import example_files


@pytest.mark.parametrize("name", [*TEMPLATES])
def test_a_template_is_a_case_without_faults(name: str, tmp_path: Path) -> None:
    file = tmp_path / "new.yaml"
    assert vstatics("new", file, "--template", name) == (0, "", "")
    assert file.read_text("utf-8") == template(name)
    said = vstatics("run", file, "-f", "json")
    assert said.is_without_messages()
    document = said.json
    assert not any(ratio is None for ratio in document["ratio"])
    assert document["case"]["elements"]


def test_a_name_means_one_file() -> None:
    """A template does not hide a case of the gallery; the signs between words are one."""
    shipped = {name.replace("-", "_") for name in example_files()}
    assert shipped.isdisjoint(TEMPLATES)
    names = ("simpson", "power-split", "power_split", "zf-8hp70", "scenarios/tarasik-box")
    for name in (one for one in names if one.replace("_", "-") in example_files()):
        file = example_files()[name.replace("_", "-")]
        assert vstatics("new", "-t", name).out.encode() == file.data()
    for name, nearest in (("ravigneau", "ravigneaux"), ("zf-8hp7", "zf-8hp70")):
        said = vstatics("new", "--template", name)
        assert said.is_wrong_use(f"did you mean `{nearest}`?")


def test_new_does_not_overwrite(tmp_path: Path) -> None:
    file = tmp_path / "mine.yaml"
    file.write_text("mine", "utf-8")
    assert vstatics("new", file).fails("already exists")
    assert file.read_text("utf-8") == "mine"


def test_another_suffix_tells_how_such_a_file_is_made(tmp_path: Path) -> None:
    deck = tmp_path / "my box.dat"
    said = vstatics("new", deck, "-t", "simpson")
    assert said.status == 1
    (command,) = re.findall(r"`vstatics (convert [^`]*)`", said.err)
    assert vstatics("new", deck.with_suffix(".yaml"), "-t", "simpson").status == 0
    vstatics(*shlex.split(command))
    assert vstatics("run", deck, "-q").status == 0


@needs("simulation")
def test_a_scenario_that_lacks_its_case_tells_how_to_write_it(tmp_path: Path) -> None:
    folder = tmp_path / "runs"
    folder.mkdir()
    file = folder / "up.yaml"
    assert vstatics("new", file, "-t", "scenarios/tarasik-box").status == 0
    said = vstatics("check", file)
    assert said.status == 1
    (command,) = re.findall(r"`vstatics (new [^`]*)`", said.err)
    assert vstatics(*shlex.split(command)).status == 0
    said = vstatics("check", file)
    assert said.is_without_messages()
    assert " ".join(said.out.split()) == f"{file}: 6 s, 4 controls, 2 torques"

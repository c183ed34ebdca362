"""Pages of a picture in files beside one another: all or none, and never over files of others."""

import os
from pathlib import Path

import pytest

from vstatics.core.errors import ReadError
from vstatics.core.jobs import files
from vstatics.core.jobs.page_files import page_name, replace_pages, set_pages_aside


def page(number: int, text: str = "") -> bytes:
    """An SVG as pictures are written."""
    mark = f' data-page="{number}"' if number > 1 else ""
    return f'<?xml version="1.0"?>\n<svg width="9pt"{mark}>{text}</svg>'.encode()


def pages(count: int, text: str = "") -> list[bytes]:
    return [page(number, text) for number in range(1, count + 1)]


def held(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}


@pytest.mark.parametrize(("before", "now"), [(1, 3), (3, 3), (4, 2), (3, 1)])
def test_pages_of_an_earlier_picture_do_not_stay(tmp_path: Path, before: int, now: int) -> None:
    path = str(tmp_path / "box.svg")
    replace_pages(path, pages(before, "old"))
    replace_pages(path, pages(now, "new"))
    expected = ["box.svg", *(f"box-{number}.svg" for number in range(2, now + 1))]
    assert held(tmp_path) == dict(zip(expected, pages(now, "new"), strict=True))


def test_a_file_that_is_no_further_page_is_kept(tmp_path: Path) -> None:
    """Whether it is of somebody else, or the first page of a case that is named so."""
    path = str(tmp_path / "box.svg")
    for own in (page(1, 'data-page="2"'), b"mine", page(3)):
        (tmp_path / "box-2.svg").write_bytes(own)
        with pytest.raises(ReadError, match=r"exists already and would be page 2 of .*box\.svg"):
            replace_pages(path, pages(2))
        replace_pages(path, pages(1))
        assert held(tmp_path) == {"box.svg": page(1), "box-2.svg": own}
        (tmp_path / "box.svg").unlink()
    (tmp_path / "box-2.svg").unlink()
    os.mkfifo(tmp_path / "box-2.svg")  # which nobody waits for
    with pytest.raises(ReadError, match="exists already and would be page 2"):
        replace_pages(path, pages(2))
    assert (tmp_path / "box-2.svg").is_fifo()


def test_a_picture_does_not_take_the_place_of_a_page_of_another(tmp_path: Path) -> None:
    replace_pages(str(tmp_path / "box.svg"), pages(2))
    with pytest.raises(ReadError, match=r"is page 2 of .*box\.svg"):
        replace_pages(str(tmp_path / "box-2.svg"), pages(1))
    (tmp_path / "box.svg").unlink()
    replace_pages(str(tmp_path / "box-2.svg"), pages(1))
    assert held(tmp_path) == {"box-2.svg": page(1)}


def test_where_a_page_cannot_be_written_all_are_as_they_were(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = str(tmp_path / "box.svg")
    replace_pages(path, pages(3, "old"))
    before, write = held(tmp_path), files.write_all

    def full(handle: int, data: bytes | memoryview) -> None:
        write(handle, data[:5])
        if b'data-page="3"' in bytes(data):
            raise OSError(28, "no space left")

    monkeypatch.setattr(files, "write_all", full)
    with pytest.raises(OSError, match="no space"):
        replace_pages(path, pages(4, "new"))
    assert held(tmp_path) == before


def test_a_picture_is_set_aside_with_its_pages(tmp_path: Path) -> None:
    path = str(tmp_path / "box.svg")
    replace_pages(path, pages(3))
    assert set_pages_aside(path) == f"{path}.old"
    assert sorted(held(tmp_path)) == ["box-2.svg.old", "box-3.svg.old", "box.svg.old"]
    assert page_name("a.b/box", 2) == "a.b/box-2"

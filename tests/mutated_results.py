"""Damaged results for the commands that read them; `tests/core/cli/test_mutated_results.py`.

Trees, cells, arrays and bytes of each format are changed at random. A command ends in an answer or
in a message that names the file, without a warning of Python or NumPy.
"""

import contextlib
import copy
import io
import json
import tempfile
import traceback
import warnings
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path
from random import Random
from typing import Any, NamedTuple

import numpy as np
import pyarrow as pa  # type: ignore[import-untyped]
import pyarrow.parquet as pq  # type: ignore[import-untyped]

from tests.commands import CASES, vstatics
from tests.fuzz import mutated as with_other_numbers_or_words
from tests.fuzzed_commands import check_answer
from tests.installed import HERE, missing

VALUES: tuple[Any, ...] = (
    *(0, -1, 1, 2.5, 1e300, -1e300, 5e-324, 1e-9, 10**400, float("nan"), float("inf")),
    *("", "x", "1e999", "-", "*", "ratio", "\u2028", "0", True, None, [], {}, [[]], [1, 2]),
    {"a": 1},
)
OUTPUTS = ("compare", "reversed", "map", "curves", "histogram", "variants")


class GoodFile(NamedTuple):
    """A result as a command has written it, and what reads it."""

    name: str
    data: bytes
    commands: Sequence[str]


@cache
def folder() -> Path:
    """A folder of this process, with the case and its sweep."""
    made = Path(tempfile.mkdtemp(prefix="vstatics-mutated-"))
    (made / "case.yaml").write_bytes((CASES / "simpson.yaml").read_bytes())
    (made / "other.yaml").write_bytes((CASES / "wheel-hub.yaml").read_bytes())
    return made


@cache
def good() -> list[GoodFile]:
    """Results and sweeps in all formats."""
    here, files = folder(), []
    for suffix in ("json", "csv", "jsonl", "parquet", "lst"):
        cases = [here / "case.yaml", *[here / "other.yaml"] * (suffix in ("jsonl", "parquet"))]
        form = {"lst": "listing"}.get(suffix, suffix)
        said = vstatics("run", *cases, "-o", here / f"run.{suffix}", "-f", form, "-q")
        assert said.status == 0, said
        written = (here / f"run.{suffix}").read_bytes()
        files.append(GoodFile(f"run.{suffix}", written, ("compare", "reversed")))
    if "sweep" in HERE:
        files += _sweeps(here)
    if not missing(["synthesis", "pictures"]):
        from tests.synthesis.boxes.listed_boxes import simpson

        files.append(GoodFile("boxes.json", json.dumps(simpson()).encode(), ("summary", "boxes")))
    return files


def _sweeps(here: Path) -> list[GoodFile]:
    files = []
    varied = ["--vary", "P1.ratio=-3:-2:4", "--vary", "P2.ratio=-3:-2:3", "--out", "ratio,ETA"]
    written = {f"sweep.{suffix}": () for suffix in ("csv", "jsonl", "npz", "parquet", "xlsx")}
    for name, more in {**written, "gears.npz": ("--by", "gear")}.items():
        said = vstatics("sweep", here / "case.yaml", *varied, *more, "-q", "-o", here / name)
        assert said.status == 0, said
        files.append(GoodFile(name, (here / name).read_bytes(), OUTPUTS))
    return files


def command(file: GoodFile, name: str, mutated: Path) -> list[object]:
    """The words of a command on a mutated file."""
    here = folder()
    first = here / file.name
    return {
        "compare": ["compare", mutated, first, "-f", "json"],
        "reversed": ["compare", first, mutated],
        "map": ["plot", "-k", "map", mutated, "-o", here / "out.svg"],
        "curves": ["plot", "-k", "curves", mutated, "-o", here / "out.svg"],
        "histogram": ["plot", "-k", "histogram", mutated, "-o", here / "out.svg"],
        "variants": ["sweep", here / "case.yaml", "--variants", mutated, "--out", "ratio", "-q"],
        "summary": ["summary", mutated, "-f", "json"],
        "boxes": ["plot", "-k", "boxes", mutated, "-o", here / "out.svg"],
    }[name]


def mutated(rng: Random, file: GoodFile) -> bytes:
    """A good file with some changes: of its structure, or of its bytes."""
    suffix = file.name.rpartition(".")[2]
    structural: dict[str, Callable[[Random, bytes], bytes]] = {
        "json": _json,
        "jsonl": _lines,
        "csv": lambda rng, data: with_other_numbers_or_words(rng, (data.decode(),)),
        "npz": _arrays,
        "parquet": _table,
    }
    data = file.data
    if suffix in structural and rng.random() < 0.75:
        return structural[suffix](rng, data)
    for _ in range(rng.choice((1, 1, 2, 8))):
        place, size = rng.randrange(len(data)), rng.choice((1, 1, 2, 40))
        before, at, after = data[:place], data[place : place + size], data[place + size :]
        match rng.randrange(4):
            case 0:
                data = before + bytes([at[0] ^ (1 << rng.randrange(8))]) + data[place + 1 :]
            case 1:
                data = before + after
            case 2:
                data = before + at * 2 + after
            case _:
                data = before if rng.random() < 0.3 else before + rng.randbytes(size)
        data = data or b"\n"
    return data


def _tree(rng: Random, tree: Any) -> Any:
    """A tree with values, keys or items changed somewhere."""
    tree = copy.deepcopy(tree)
    for _ in range(rng.choice((1, 1, 2, 3))):
        places: list[tuple[Any, Any]] = []
        _places(tree, places)
        if not places:
            break
        inner, key = rng.choice(places)
        match rng.randrange(5):
            case 0 | 1:
                inner[key] = copy.deepcopy(rng.choice(VALUES))
            case 2:
                del inner[key]
            case 3:
                if isinstance(inner, list):
                    inner.insert(key, copy.deepcopy(inner[key]))
                else:
                    inner[rng.choice(("x", "ratio", "status", "1", ""))] = inner.pop(key)
            case _:
                other, place = rng.choice(places)
                if place in other if isinstance(other, dict) else place < len(other):
                    inner[key] = copy.deepcopy(other[place])
    return tree


def _places(tree: Any, places: list[tuple[Any, Any]]) -> None:
    for key, value in tree.items() if isinstance(tree, dict) else enumerate(tree):
        places.append((tree, key))
        if isinstance(value, dict | list):
            _places(value, places)


def _json(rng: Random, data: bytes) -> bytes:
    return json.dumps(_tree(rng, json.loads(data))).encode()


def _lines(rng: Random, data: bytes) -> bytes:
    lines = data.splitlines()
    place = rng.randrange(len(lines))
    lines[place] = _json(rng, lines[place])
    return b"\n".join(lines)


def _column(rng: Random, array: Any) -> Any:
    """An array with other numbers, another length, shape or type."""
    made = np.array(array)
    match rng.randrange(7):
        case 0 if made.ndim:
            made = made[: rng.randrange(len(made) + 1)]
        case 1 if made.ndim:
            made = np.append(made, made[:1])
        case 2 if made.dtype.kind in "fiu":
            with np.errstate(all="ignore"):
                made = made.astype(
                    rng.choice(("f4", "f2", "i8", "u1", "U5", "S3", "?", "c16", "g"))
                )
        case 3:
            made = made.reshape(rng.choice(((-1, 1), (1, -1))))
        case 4:
            made = np.array(rng.choice((0, 1.5, "x", np.nan)))
        case _ if made.size and made.dtype.kind in "fiu":
            made = made.astype(float)
            made.flat[rng.randrange(made.size)] = rng.choice((0, -1, np.nan, np.inf, 1e300, 99))
    return made


def _columns(rng: Random, columns: dict[str, Any]) -> dict[str, Any]:
    for _ in range(rng.choice((1, 1, 2))):
        name = rng.choice([*columns])
        match rng.randrange(6):
            case 0 if len(columns) > 1:
                del columns[name]
            case 1:
                others = "x", "status", "gear", "statuses", "ratio[1]", "table", "case"
                columns[rng.choice(others)] = columns[name]
            case _:
                columns[name] = _column(rng, columns[name])
    return columns


def _arrays(rng: Random, data: bytes) -> bytes:
    with np.load(io.BytesIO(data)) as archive:
        arrays = {name: archive[name] for name in archive.files}
    made = io.BytesIO()
    np.savez(made, **_columns(rng, arrays))
    return made.getvalue()


def _table(rng: Random, data: bytes) -> bytes:
    table = pq.read_table(pa.BufferReader(data)).to_pydict()
    columns = _columns(rng, {name: np.array(values) for name, values in table.items()})
    least = min(column.size for column in columns.values())
    lists = {name: column.ravel()[:least].tolist() for name, column in columns.items()}
    for values in lists.values():
        if values and rng.random() < 0.2:
            values[rng.randrange(least)] = None
    made = io.BytesIO()
    with contextlib.suppress(pa.ArrowException):  # it has no complex numbers
        pq.write_table(pa.table(lists), made)
    return made.getvalue()


def tried(number: int) -> tuple[str, str]:
    """The command of a number and its fault; that is empty if all is well."""
    rng = Random(number)  # noqa: S311
    file = rng.choice(good())
    name = rng.choice(file.commands)
    path = folder() / f"mutated.{file.name.rpartition('.')[2]}"
    with warnings.catch_warnings(action="ignore"):
        path.write_bytes(mutated(rng, file))
    words = command(file, name, path)
    about = f"{number}: {' '.join(map(str, words))}"
    try:
        with warnings.catch_warnings(), np.errstate(all="warn", under="ignore"):
            warnings.simplefilter("error")
            said = vstatics(*words)
        check_answer(said, words)
        assert "Warning" not in said.err, said.err
    except Exception:  # noqa: BLE001 - that is what is looked for
        return name, f"{about}\n{traceback.format_exc()}"
    return f"{name} {said.status}", ""

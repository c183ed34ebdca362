"""What JSON documents of all commands have in common, and its schema."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from vstatics.errors import Problem
from vstatics.writers.record_schema import TEXT, Schema, list_of, record


def failure(case: str, problems: Iterable[Problem]) -> dict[str, Any]:
    """The document of a case in error, without its file."""
    return {"case": case, "errors": list(map(str, problems))}


def documents(name: str, title: str, one: Schema, definitions: Schema | None = None) -> Schema:
    """The schema of a file: a document, or several as an array; any may be a case in error.

    Parameters
    ----------
    name : str
        Of the format: that of the file is made of it.
    one : dict
        The schema of a document, without its `file`.
    definitions : dict, optional
        What it refers to by ``#/$defs/...``.
    """
    file = {"type": "string", "description": "The file of the case, without folders."}
    properties = {**one["properties"], "file": file}
    failure = {
        "title": "case in error",
        **record({"file": file, "case": TEXT, "errors": list_of(TEXT)}, optional=["file"]),
    }
    entry = {
        "if": {"type": "object", "required": ["errors"]},
        "then": {"$ref": "#/$defs/failure"},
        "else": {"$ref": "#/$defs/document"},
    }
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": f"{name}.schema.json",
        "title": title,
        "if": {"type": "array"},
        "then": {"items": {"$ref": "#/$defs/entry"}},
        "else": {"$ref": "#/$defs/entry"},
        "$defs": {
            "entry": entry,
            "document": {**one, "properties": properties},
            "failure": failure,
            **(definitions or {}),
        },
    }


def head(form: str, version: int) -> Schema:
    """Of the keys with which every document begins."""
    return {"format": {"const": form}, "version": {"const": version}}

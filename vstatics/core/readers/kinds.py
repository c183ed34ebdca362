"""Recognition of the kind of a document by its keys: case, scenario or sweep file."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from vstatics.core.annexes import DOCUMENTS, document_kind, module, not_installed
from vstatics.core.errors import ReadError, of_file

if TYPE_CHECKING:  # the modules that read YAML cost start-up time
    from vstatics.core.readers.named.nodes import Node

KEYS: Mapping[str, str] = {
    "scenario": "duration start shifts controls",
    "sweep file": "vary variants",
    "case": "links mechanisms elements springs inertias masses gears shift_elements dump",
}
"""Keys that identify a kind of document, separated by blanks. The first match counts."""


def kind_of(root: Node) -> str | None:
    """Return the kind of a document in YAML or JSON; None if it has no known key."""
    from vstatics.core.readers.named import nodes

    keys = {key.text for key, _ in root.entries} if isinstance(root, nodes.Mapping) else set()
    return next((kind for kind, words in KEYS.items() if not keys.isdisjoint(words.split())), None)


def is_foreign(data: bytes, file: str) -> bool:
    """Return whether a file has no keys of a case, and so must not be quoted in messages.

    >>> is_foreign(b"root:x:0:0::/root:/bin/sh", "/etc/passwd"), is_foreign(b"{links: 2}", "a.yaml")
    (True, False)
    """
    from vstatics.core.readers import format_of

    keys = rb"(?:^|[\s{,\"'])(?:%s)[\"']?\s*:" % KEYS["case"].replace(" ", "|").encode()
    if b"\0" in data or re.search(keys, data):  # zero bytes occur in UTF-16 and UTF-32
        return False
    return format_of(file, data) not in ("deck", "xlsx")


def is_of_kind(kind: str, data: bytes, file: str) -> bool:
    """Return whether a file in YAML or JSON is a document of a kind in `KEYS`.

    >>> is_of_kind("scenario", b"{case: box.yaml, duration: 6}", "up.yaml")
    True
    >>> is_of_kind("scenario", b"{case: box.yaml, duraton: 6, start: {}}", "up.yaml")
    True
    """
    from vstatics.core.readers import format_of

    has_key = any(key.encode() in data for key in KEYS[kind].split())
    if not has_key or format_of(file, data) in ("deck", "xlsx"):
        return False
    from vstatics.core.readers.named.nodes import decode
    from vstatics.core.readers.named.yaml_nodes import yaml_tree

    try:
        return kind_of(yaml_tree(decode(data, file))) == kind
    except ReadError:
        return False


def document_function(name: str, data: bytes, file: str) -> Any:
    """Return the function `name` of the annex that handles the document; None for a case.

    Raises
    ------
    ReadError
        If the annex of the document is not installed.
    """
    for kind, (annex, marks) in DOCUMENTS.items():
        if kind in KEYS and any(mark in data for mark in marks) and is_of_kind(kind, data, file):
            known = document_kind(kind)
            if known is None:
                raise ReadError([of_file("E004", file, not_installed(kind, annex))])
            if name in known.functions:
                return getattr(module(known.functions[name]), name)
    return None

"""Detection of changed files by metadata and contents."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Sequence
from contextlib import suppress

from vstatics.page.serve.document_fields import Texts


def digest_of(texts: Texts) -> str:
    """Return a hash of the names and contents of documents."""
    digest = hashlib.sha256()
    for file, data in texts.items():
        for part in (os.fsencode(file), data):
            digest.update(len(part).to_bytes(8, "big") + part)
    return digest.hexdigest()


def signature_of(files: Sequence[str]) -> dict[str, tuple[int, ...]]:
    """Return the metadata of each file that change when it is written; empty if it is missing."""
    signature: dict[str, tuple[int, ...]] = {}
    for file in files:
        signature[file] = ()
        with suppress(OSError, ValueError):
            status = os.stat(file)  # noqa: PTH116
            signature[file] = (
                status.st_mtime_ns,
                status.st_ctime_ns,
                status.st_size,
                status.st_ino,
            )
    return signature

"""Whether files have changed: looked at without reading, and by what they hold."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Sequence
from contextlib import suppress

from vstatics.page.serve.document_fields import Texts


def digest_of(texts: Texts) -> str:
    """What tells documents from others."""
    made = hashlib.sha256()
    for file, data in texts.items():
        for part in (os.fsencode(file), data):
            made.update(len(part).to_bytes(8, "big") + part)
    return made.hexdigest()


def signature_of(files: Sequence[str]) -> dict[str, tuple[int, ...]]:
    """What tells, without reading, that a file has changed; nothing of one that is not there."""
    found: dict[str, tuple[int, ...]] = {}
    for file in files:
        found[file] = ()
        with suppress(OSError, ValueError):
            about = os.stat(file)  # noqa: PTH116
            found[file] = (about.st_mtime_ns, about.st_ctime_ns, about.st_size, about.st_ino)
    return found

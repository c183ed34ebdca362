"""One process at a time has a directory."""

import errno
import fcntl
import os
from pathlib import Path

import pytest

from tests.processes import names
from vstatics.core.errors import ReadError
from vstatics.core.jobs import lock as lock_module
from vstatics.core.jobs.lock import lock, unlock
from vstatics.core.jobs.state_files import StateFolder


def test_a_lock_names_its_process_until_it_is_let_go(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(lock_module, "LOCK_TENTHS", 2)
    folder = StateFolder(str(tmp_path))
    held = lock(folder, "mine", "run")
    with pytest.raises(ReadError, match=rf"another run \(process {os.getpid()}\) is writing"):
        lock(folder, "mine", "run")
    unlock(lock(folder, "other", "run"))
    unlock(held)
    unlock(lock(folder, "mine", "run"))


@pytest.mark.parametrize("code", [errno.ENOLCK, errno.EOPNOTSUPP, errno.EIO])
def test_a_file_system_without_locks_is_used_without_them(
    code: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As some that are mounted from afar; any other fault of locking is told."""

    def flock(*_: int) -> None:
        raise OSError(code, os.strerror(code))

    monkeypatch.setattr(fcntl, "flock", flock)
    if code == errno.EIO:
        with pytest.raises(OSError, match=os.strerror(code)):
            lock(StateFolder(str(tmp_path)), "mine", "run")
        return
    assert lock(StateFolder(str(tmp_path)), "mine", "run") is None
    assert names(tmp_path) == []

"""Finished pieces of long work such as a sweep, which a resumed run reuses.

While a sweep into `out.csv` runs, the directory `out.csv.parts` contains a file for each finished
piece, a description of the sweep, and a lock file. Other kinds of work use the same format. The
output can also be a directory.
"""

from __future__ import annotations

import errno
import json
import os
from typing import Self

from vstatics.core.errors import ReadError, of_file
from vstatics.core.jobs.files import is_temporary
from vstatics.core.jobs.finished_cases import OTHER_BUILD, Description, differing
from vstatics.core.jobs.lock import lock, unlock
from vstatics.core.jobs.piece_file import ASSEMBLED, Account, read_account
from vstatics.core.jobs.state_files import StateFolder

SUFFIX = ".parts"
PLAN = "plan.json"
LOCK = "lock"
CASE = "the case, a file that it names, or an option"
"""Words in a message for changes of the work that cannot be named."""
OF_BUILDS = ("build", "fingerprint", "pieces")
"""Keys of a description whose values depend on the build of the package."""


class FinishedPieces:
    """Directory with the finished pieces of a sweep or other work, used by a single process.

    Parameters
    ----------
    output : str
        Final file or directory.
    what : str
        Name of the work in messages.
    into_folder : bool
        True if the output is a directory that the caller fills.
    """

    def __init__(self, output: str, what: str = "sweep", *, into_folder: bool = False) -> None:
        self.output = os.path.realpath(output)
        self.what, self.into_folder = what, into_folder
        self.directory = self.output + SUFFIX
        self.folder = StateFolder(self.directory)
        self.accounts: dict[int, Account] = {}
        self.work = ""
        """Hash of the definition of the work, which each piece contains."""
        self._lock: int | None = None
        self.is_open = False

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        """Unlock the directory without removing finished pieces."""
        if self.is_open and not self.finished():
            self._remove()
        self.unlock()

    def path(self, name: str) -> str:
        """Return the path of a file in the directory."""
        return self.folder.file(name)

    def exists(self) -> bool:
        """Return whether the directory of pieces, or a file with this name, exists."""
        return self.folder.exists()

    def open(self, description: Description, pieces: int, *, resume: bool) -> str:
        """Create the directory or load its pieces; return "", or why pieces cannot be used.

        Parameters
        ----------
        description : dict
            Definition of the work. Its `fingerprint` must equal the fingerprint of existing pieces.
            Pieces of another `build` of this package are removed.
        pieces : int
            Number of pieces of the whole work.
        resume : bool
            True to reuse existing pieces.

        Raises
        ------
        ReadError
            If another process holds the lock, or existing pieces belong to other work.
        OSError
        """
        if os.path.isdir(self.output) and not self.into_folder:  # noqa: PTH112
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
        if self.into_folder:  # the parents of results directories are also created
            os.makedirs(os.path.dirname(self.output), exist_ok=True)  # noqa: PTH103, PTH120
        self.work = description["fingerprint"]
        self.lock()
        known = self._known()
        finished = [piece for piece in self.finished() if piece < pieces]
        why_not = ""
        if finished and known is not None:
            why_not = self._check(known, description, len(finished), resume=resume)
            trusted = [] if why_not else finished
            accounts = (read_account(self.directory, piece, self.work) for piece in trusted)
            self.accounts = {account.piece: account for account in accounts if account}
        self.is_open = True
        for name in self.folder.names():  # remove unfinished files of a killed process
            if name not in (PLAN, LOCK) and not (name.isdigit() and int(name) in self.accounts):
                self.folder.remove(name)
        self.folder.replace(PLAN, json.dumps(description, indent=2, ensure_ascii=False).encode())
        return why_not

    def _known(self) -> Description | None:
        try:
            with self.folder.reading(PLAN) as file:
                known = json.load(file)
        except (OSError, ValueError):
            known = None
        if isinstance(known, dict) and "fingerprint" in known:
            return known
        if all(name == LOCK or is_temporary(name) for name in self.folder.names()):
            return None
        message = f"contains no {self.what} that can be resumed; move it away"
        raise ReadError([of_file("E032", self.directory, message)])

    def finished(self) -> list[int]:
        """Return the numbers of the pieces that exist."""
        return sorted(int(name) for name in self.folder.names() if name.isdigit())

    def _check(
        self, known: Description, wanted: Description, finished: int, *, resume: bool
    ) -> str:
        """Raise an error for pieces of other work, or for existing pieces without --resume.

        Otherwise return "", or a message if the pieces are from another build of the package.
        """
        changed = differing(known, wanted)
        said = [key for key in changed if key not in OF_BUILDS]
        other_build = known.get("build") != wanted["build"]
        if said or ("fingerprint" in changed and not other_build):
            what = f": {', '.join(said) or CASE} changed"
            whose = f"of another {self.what}{what}; repeat that run with --resume"
        elif not resume:
            whose = f"of this {self.what}, which was stopped; continue with --resume"
        else:
            return OTHER_BUILD if other_build else ""
        held = f"holds {finished} of {known.get('pieces')} finished pieces"
        message = f"{held} {whose}, or remove the directory to begin anew"
        raise ReadError([of_file("E033", self.directory, message)])

    def lock(self) -> None:
        """Lock the directory against other processes; see `vstatics.core.jobs.lock.lock`."""
        self.folder.make()
        self.folder.check()
        self._lock = lock(self.folder, LOCK, self.what)

    def unlock(self) -> None:
        """Release the lock of the directory."""
        unlock(self._lock)
        self._lock = None

    def finish(self) -> None:
        """Move the assembled output into place, and then remove the pieces.

        Raises
        ------
        OSError
        """
        self.folder.put_for_good(ASSEMBLED, self.output)
        self.drop()

    def drop(self) -> None:
        """Remove the pieces after the output has been written."""
        self._remove()
        self.unlock()

    def _remove(self) -> None:
        """Remove the directory.

        The description is removed last, so that the work can be resumed.
        """
        for name in sorted(self.folder.names(), key=(PLAN, LOCK).__contains__):
            self.folder.remove(name)
        self.folder.drop()

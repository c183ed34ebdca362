"""Finished pieces of work that takes long, a sweep say, which a resumed one trusts.

While a sweep into `out.csv` runs there is a directory `out.csv.parts`. It holds a file for
each finished piece, a description of the sweep, and a lock. What other work is called, and
whether its output is a directory too, it says itself.
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
"""What is changed where nothing else is told of."""
OF_BUILDS = ("build", "fingerprint", "pieces")
"""What another build may have otherwise for the same work."""


class FinishedPieces:
    """The directory of finished pieces of one sweep, say, held by one process.

    Parameters
    ----------
    output : str
        The file, or directory, that will be there in the end.
    what : str
        What the work is called.
    into_folder : bool
        Whether the output is a directory, which others fill.
    """

    def __init__(self, output: str, what: str = "sweep", *, into_folder: bool = False) -> None:
        """Name the directory; `open` makes it."""
        self.output = os.path.realpath(output)
        self.what, self.into_folder = what, into_folder
        self.directory = self.output + SUFFIX
        self.folder = StateFolder(self.directory)
        self.accounts: dict[int, Account] = {}
        self.work = ""
        """Hash of the definition of the work, which each of its pieces carries."""
        self._lock: int | None = None
        self.is_open = False

    def __enter__(self) -> Self:
        """Nothing is touched yet."""
        return self

    def __exit__(self, *_: object) -> None:
        """Let go of the directory; what is finished stays."""
        if self.is_open and not self.finished():
            self._remove()
        self.unlock()

    def path(self, name: str) -> str:
        """Return the path of a file in the directory."""
        return self.folder.file(name)

    def exists(self) -> bool:
        """Return whether anything has the name of the directory of pieces."""
        return self.folder.exists()

    def size(self) -> int:
        """Return the size of all files in bytes."""
        return self.folder.size()

    def open(self, description: Description, pieces: int, *, resume: bool) -> str:
        """Make the directory, or take up the pieces that it holds; why not, if so.

        Parameters
        ----------
        description : dict
            What the work is; its `fingerprint` must be that of the pieces that are there.
            Those of another `build` of this package are removed.
        pieces : int
            How many there will be.
        resume : bool
            Whether pieces may be there.

        Raises
        ------
        ReadError
            If another process is at it, or pieces are there that are not to be taken up.
        OSError
        """
        if os.path.isdir(self.output) and not self.into_folder:  # noqa: PTH112
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
        if self.into_folder:  # it is made with its parents, as every directory of results
            os.makedirs(os.path.dirname(self.output), exist_ok=True)  # noqa: PTH103, PTH120
        self.work = description["fingerprint"]
        self.lock()
        known = self._known()
        finished = [piece for piece in self.finished() if piece < pieces]
        without = ""
        if finished and known is not None:
            without = self._check(known, description, len(finished), resume=resume)
            trusted = [] if without else finished
            accounts = (read_account(self.directory, piece, self.work) for piece in trusted)
            self.accounts = {account.piece: account for account in accounts if account}
        self.is_open = True
        for name in self.folder.names():  # what a killed process left unfinished
            if name not in (PLAN, LOCK) and not (name.isdigit() and int(name) in self.accounts):
                self.folder.remove(name)
        self.folder.replace(PLAN, json.dumps(description, indent=2, ensure_ascii=False).encode())
        return without

    def _known(self) -> Description | None:
        """The description of the work whose pieces are there."""
        try:
            with self.folder.reading(PLAN) as file:
                known = json.load(file)
        except (OSError, ValueError):
            known = None
        if isinstance(known, dict) and "fingerprint" in known:
            return known
        if all(name == LOCK or is_temporary(name) for name in self.folder.names()):
            return None
        message = f"holds no {self.what} that can be taken up; move it away"
        raise ReadError([of_file("E032", self.directory, message)])

    def finished(self) -> list[int]:
        """The numbers of the pieces that are there, whoever finished them."""
        return sorted(int(name) for name in self.folder.names() if name.isdigit())

    def _check(
        self, known: Description, wanted: Description, finished: int, *, resume: bool
    ) -> str:
        """Refuse pieces of other work, and pieces that nobody asked to take up.

        The result tells why pieces of this work are not taken up: two builds have other
        fingerprints for the same.
        """
        changed = differing(known, wanted)
        said = [key for key in changed if key not in OF_BUILDS]
        other_build = known.get("build") != wanted["build"]
        if said or ("fingerprint" in changed and not other_build):
            what = f": {', '.join(said) or CASE} changed"
            whose = f"of another {self.what}{what}; repeat that one with --resume"
        elif not resume:
            whose = f"of this {self.what}, which was stopped; go on with --resume"
        else:
            return OTHER_BUILD if other_build else ""
        held = f"holds {finished} of {known.get('pieces')} finished pieces"
        message = f"{held} {whose}, or remove the directory to begin anew"
        raise ReadError([of_file("E033", self.directory, message)])

    def lock(self) -> None:
        """Take the directory for this process; see `vstatics.core.jobs.lock.lock`."""
        self.folder.make()
        self.folder.check()
        self._lock = lock(self.folder, LOCK, self.what)

    def unlock(self) -> None:
        """Let go of the directory."""
        unlock(self._lock)
        self._lock = None

    def discard(self, name: str) -> None:
        """Remove a file from the directory, if it is there."""
        self.folder.remove(name)

    def finish(self) -> None:
        """Move the assembled output into place and, when it is on the disk, remove the pieces.

        Raises
        ------
        OSError
        """
        self.folder.put_for_good(ASSEMBLED, self.output)
        self.drop()

    def drop(self) -> None:
        """Remove the pieces: what was made of them is there."""
        self._remove()
        self.unlock()

    def _remove(self) -> None:
        """Remove the directory, last what tells of which work it is: so any rest can go on."""
        for name in sorted(self.folder.names(), key=(PLAN, LOCK).__contains__):
            self.folder.remove(name)
        self.folder.drop()

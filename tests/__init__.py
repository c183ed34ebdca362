"""Tests stand where the code stands, so that they are found by its name.

The tests of ``vstatics/ROOM/MODULE.py`` are ``tests/ROOM/test_MODULE.py``; those of
``vstatics/ROOM/FOLDER/MODULE.py`` are ``tests/ROOM/test_FOLDER_MODULE.py``, and those of the
folder as a whole ``test_FOLDER.py``. A room as a whole has ``test_ROOM.py``. What several
modules need stands beside them without ``test_`` in its name, and fixtures in ``conftest.py``.

Tests of more than one room are called by their topic: whole commands (``cli``), random trains
(``statics/test_invariants.py``, ``test_against_oracle.py``), broken input
(``readers/test_robustness.py``). ``published`` has numbers printed elsewhere, ``oracle`` exact
arithmetic, ``golden`` what this program wrote, ``bad`` a fault a file.
"""

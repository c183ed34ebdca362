"""Run all benchmarks, or those that are named: ``python benchmarks [--quick] [NAME...]``.

Prints their tables in Markdown; each benchmark is a process of its own. With ``--into
FILE`` the tables also take their places in a document, between the lines
``<!-- bench: NAME -->`` and ``<!-- end of bench -->``; the machine is NAME ``machine``.
"""

import argparse
import re
import subprocess
import sys
from pathlib import Path

from common import compiled, machine

NAMES = (
    *("variants", "spread", "sizes", "decks", "long_sweeps", "torsion"),
    *("points", "simulation", "controlled", "startup", "drawing"),
)
LONG = ("boxes",)
"""Those that are run only where they are named."""
WITHOUT_PEER = (
    "long_sweeps",
    "torsion",
    "points",
    "simulation",
    "controlled",
    "startup",
    "drawing",
    "boxes",
)
PLACE = "<!-- bench: {} -->\n"
END = "<!-- end of bench -->"


def placed(document: str, name: str, text: str) -> str:
    """The document with a text in its place."""
    start = re.escape(PLACE.format(name))
    found = re.compile(f"({start}).*?(?={END})", re.DOTALL)
    return found.sub(lambda match: f"{match[1]}\n{text.strip()}\n\n", document)


def main() -> None:
    """Run them one after another."""
    known = (*NAMES, *LONG)
    parser = argparse.ArgumentParser(prog="benchmarks", description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="less work: do they run at all?")
    parser.add_argument("--peer", type=Path, metavar="PROGRAM", help="another peer, same usage")
    parser.add_argument("--into", type=Path, metavar="FILE", help="a document with their places")
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(known))
    given = parser.parse_args()
    if unknown := set(given.names) - set(known):
        parser.error(f"no benchmark {', '.join(sorted(unknown))}: choose of {', '.join(known)}")
    names = given.names or NAMES
    peer = None
    if not set(names) <= set(WITHOUT_PEER):
        peer = given.peer.resolve() if given.peer else compiled()
    texts = {"machine": f"{machine()}. Times are medians of alternating runs.\n"}
    print(texts["machine"], end="", flush=True)
    failed = []
    for name in names:
        command = [sys.executable, str(Path(__file__).with_name(f"{name}.py"))]
        command += ["--quick"] * given.quick
        if name not in WITHOUT_PEER:
            command += ["--peer", str(peer)]
        run = subprocess.run(command, check=False, stdout=subprocess.PIPE, text=True)
        print(run.stdout, end="", flush=True)
        if run.returncode:
            failed.append(name)
        else:
            texts[name] = run.stdout
    if given.into:
        document = given.into.read_text(encoding="utf-8")
        for name, text in texts.items():
            document = placed(document, name, text)
        given.into.write_text(document, encoding="utf-8")
    if failed:
        sys.exit(f"failed: {', '.join(failed)}")


if __name__ == "__main__":
    main()

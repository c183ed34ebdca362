"""Results of a check or comparison as the XML of JUnit, which CI shows test by test."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from vstatics.core.errors import printable


class CaseOutcome(NamedTuple):
    """What became of a case; it failed where there is a type."""

    name: str
    type: str = ""
    message: str = ""
    text: str = ""
    """What is told of it, also where it did not fail."""


def junit(suite: str, outcomes: Sequence[CaseOutcome]) -> str:
    """The outcomes as one suite, a `testcase` each.

    Examples
    --------
    >>> print(junit("vstatics check", [CaseOutcome("a.yaml", "E107", "read 0", "a.yaml: read 0")]))
    <?xml version="1.0" encoding="UTF-8"?>
    <testsuites tests="1" failures="1">
      <testsuite name="vstatics check" tests="1" failures="1">
        <testcase name="a.yaml" classname="vstatics check">
          <failure type="E107" message="read 0">a.yaml: read 0</failure>
        </testcase>
      </testsuite>
    </testsuites>
    <BLANKLINE>
    """
    from xml.sax.saxutils import escape, quoteattr  # costs start-up time

    def value(text: str) -> str:
        return quoteattr(printable(text))

    counts = f'tests="{len(outcomes)}" failures="{sum(bool(one.type) for one in outcomes)}"'
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        f"<testsuites {counts}>",
        f"  <testsuite name={value(suite)} {counts}>",
    ]
    for one in outcomes:
        begin = f"    <testcase name={value(one.name)} classname={value(suite)}"
        told = escape(printable(one.text, lines=True))
        if one.type:
            inner = f"<failure type={value(one.type)} message={value(one.message)}>{told}</failure>"
        elif one.text:
            inner = f"<system-out>{told}</system-out>"
        else:
            lines.append(f"{begin}/>")
            continue
        lines += [f"{begin}>", f"      {inner}", "    </testcase>"]
    return "\n".join([*lines, "  </testsuite>", "</testsuites>"]) + "\n"

"""Outcomes of a check or comparison as JUnit XML, which CI systems display as tests."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from vstatics.core.errors import printable


class CaseOutcome(NamedTuple):
    """Outcome of a check or comparison for a case, which is a failure unless `type` is empty."""

    name: str
    type: str = ""
    message: str = ""
    text: str = ""
    """Output about the case, for failures and successes."""


def junit(suite: str, outcomes: Sequence[CaseOutcome]) -> str:
    """Return the outcomes as a test suite, with a `testcase` for each outcome.

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

    counts = f'tests="{len(outcomes)}" failures="{sum(bool(outcome.type) for outcome in outcomes)}"'
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        f"<testsuites {counts}>",
        f"  <testsuite name={value(suite)} {counts}>",
    ]
    for outcome in outcomes:
        begin = f"    <testcase name={value(outcome.name)} classname={value(suite)}"
        output = escape(printable(outcome.text, lines=True))
        if outcome.type:
            inner = (
                f"<failure type={value(outcome.type)} message={value(outcome.message)}>"
                f"{output}</failure>"
            )
        elif outcome.text:
            inner = f"<system-out>{output}</system-out>"
        else:
            lines.append(f"{begin}/>")
            continue
        lines += [f"{begin}>", f"      {inner}", "    </testcase>"]
    return "\n".join([*lines, "  </testsuite>", "</testsuites>"]) + "\n"

"""What the page is called: by its case, and by the scenario that runs it."""

from __future__ import annotations

from typing import NamedTuple


class Naming(NamedTuple):
    """What a case does not say of itself."""

    name: str = ""
    """Of the scenario that runs it; else of its file, for a case without a name."""
    description: str = ""
    """Of the scenario."""

    def title(self, case: str, *, runs: bool) -> str:
        """The title of the page.

        Parameters
        ----------
        case : str
            The name that the case has, if any.
        runs : bool
            Whether the page has a run.

        Examples
        --------
        >>> Naming("box").title("", runs=False), Naming("box").title("8HP70", runs=False)
        ('box', '8HP70')
        >>> Naming("upshift").title("8HP70", runs=True), Naming().title("8HP70", runs=True)
        ('upshift, 8HP70', 'Run, 8HP70')
        """
        if runs:
            return f"{self.name or 'Run'}, {case}" if case else self.name or "Run"
        return case or self.name or "Transmission"


UNNAMED = Naming()

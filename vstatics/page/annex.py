"""Declaration of the annex of HTML pages: its commands, public names and methods."""

from vstatics.core.annexes import Annex, Command

ANNEX = Annex(
    name="page",
    needs=("pictures", "sweep", "simulation"),
    commands={
        "serve": Command(
            "vstatics.page.cli.serve",
            "Serve the page of a case, which follows and changes it.",
            130,
        ),
        "report": Command(
            "vstatics.page.cli.report", "Write a case and its results as one page of HTML.", 140
        ),
    },
    names={
        "write_report": "vstatics.page.report.saving",
    },
    methods={"stamped_page": "vstatics.page.report.html_page"},
)

"""Declaration of the annex of HTML pages: commands, public names and methods."""

from vstatics.core.annexes import Annex, Command

ANNEX = Annex(
    name="page",
    needs=("pictures", "sweep", "simulation"),
    commands={
        "serve": Command(
            "vstatics.page.cli.serve",
            "Serve a page that shows and changes a case.",
            130,
        ),
        "report": Command(
            "vstatics.page.cli.report", "Write a case and its results as an HTML page.", 140
        ),
    },
    names={
        "write_report": "vstatics.page.report.saving",
    },
    methods={"stamped_page": "vstatics.page.report.html_page"},
)

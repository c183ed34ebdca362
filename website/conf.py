"""What Sphinx is told of the site; nothing in it comes from a network, nor is read from one."""

from typing import Any

from sphinx.application import Sphinx

from vstatics import __version__

project = "vstatics"
release = __version__
author = "the authors of vstatics"
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
myst_enable_extensions = ["deflist", "dollarmath"]
myst_heading_anchors = 4
autodoc_default_options = {"members": True, "undoc-members": True}
autodoc_typehints = "description"
napoleon_google_docstring = False
napoleon_use_ivar = True
html_theme = "furo"
html_title = "vstatics"
html_static_path = ["static"]
html_css_files = ["site.css"]
html_show_sourcelink = False
html_copy_source = False
html_show_search_summary = False  # it would be fetched, which a browser refuses on a disk
suppress_warnings = [
    "misc.highlighting_failure",
    "ref.python",
]  # a shell within a shell; a word as a name


def setup(app: Sphinx) -> None:
    """What else is done with docstrings."""
    app.connect("autodoc-process-docstring", _no_type_before_colon, priority=400)


def _no_type_before_colon(_: Sphinx, what: str, *named: Any) -> None:
    """Napoleon takes what stands before a colon in the first line of an attribute for its type.

    Here it is never that, as types are annotated: an empty comment is the first line.
    """
    *_others, lines = named
    if what in {"attribute", "data", "property"}:
        lines[:0] = ["..", ""]

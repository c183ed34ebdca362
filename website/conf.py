"""Configuration of Sphinx. The site loads nothing from a network."""

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
html_show_copyright = False
html_copy_source = False
html_show_search_summary = False  # fetches pages, which browsers refuse for files on a disk
suppress_warnings = [
    "misc.highlighting_failure",
    "ref.python",
]  # console examples with nested shells; words that look like names


def setup(app: Sphinx) -> None:
    """Register the preprocessing of docstrings."""
    app.connect("autodoc-process-docstring", _no_type_before_colon, priority=400)


def _no_type_before_colon(_: Sphinx, what: str, *named: Any) -> None:
    """Insert an empty comment before the docstrings of attributes.

    Napoleon would otherwise read the text before a colon in the first line as the type.
    """
    *_others, lines = named
    if what in {"attribute", "data", "property"}:
        lines[:0] = ["..", ""]

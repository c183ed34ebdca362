"""Website with the documents of the project, references of commands and keys, and a gallery.

`make site` runs ``python -m website FOLDER``. `documents` assigns a page to each document of
``docs/``. `commands`, `keys`, `public` and `gallery` write pages from the declarations of the
program and from the shipped cases. Sphinx (`conf.py`) converts all pages, in Markdown or
reStructuredText, to HTML.
"""

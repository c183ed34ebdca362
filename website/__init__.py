"""The site: `python -m website FOLDER` (`make site`) builds it from docs/ and from declarations.

`documents` says which document becomes which page; `commands`, `keys`, `public`, `gallery` make
pages of what the program declares. All are written as Markdown or reStructuredText to a folder
of their own, which Sphinx makes pages of (`conf.py`).
"""

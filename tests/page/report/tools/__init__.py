"""Tests of what a reader does with a page: units, rows of a link, files."""

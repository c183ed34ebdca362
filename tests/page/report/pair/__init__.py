"""Tests of the page of two cases."""

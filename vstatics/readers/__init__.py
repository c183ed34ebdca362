"""Readers of cases: one module per format, text -> Transmission."""

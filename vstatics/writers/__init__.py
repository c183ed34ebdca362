"""Writers of results and cases: one module per format."""

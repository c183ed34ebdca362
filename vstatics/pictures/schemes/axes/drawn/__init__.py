"""Several axes on paper: `sheet` has links and ports, `marks` and `wheels` what stands there."""

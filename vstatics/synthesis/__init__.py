"""The gearbox to be found: which schemes there are, which gears they give, with which ratios.

A number of planetary sets goes in, or a case; schemes come out, combinations of shift
elements, internal ratios. Each of them is a case again.
"""

from __future__ import annotations

from vstatics.synthesis.combinations import combinations

__all__ = ["combinations"]

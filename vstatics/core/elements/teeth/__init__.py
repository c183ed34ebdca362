"""Doubts about teeth: wheels that cannot be made or put together, or would wear soon.

A case with such teeth stays calculable: ratios and torques ask for numbers only. So these
are warnings and notes. They hold for the usual profile of 20 degrees with tips one module
high. The first about an element tells what nearby teeth would do.

`doubtful_teeth` asks all questions: `assembly` and `spacing` those about planets, `meshing` those
about any wheels that mesh. `subjects` and `layout` know an element's teeth, `nearby` others.
"""

from vstatics.core.elements.teeth.doubtful_teeth import doubts

__all__ = ["doubts"]

"""Doubts about teeth: gears that cannot be made or assembled, or that would wear early.

A case with such teeth can still be calculated, as ratios and torques depend on numbers only. So the
doubts are warnings and notes. They apply to the usual profile of 20 degrees with an addendum of one
module. The first doubt about a gear set suggests teeth nearby.

`doubtful_teeth` collects all doubts: `assembly` and `spacing` about planets, `meshing` about any
gears in mesh. `subjects` and `layout` describe the teeth of a gear set, `nearby` finds others;
`conditions` contains the formulas.
"""

from vstatics.core.elements.teeth.doubtful_teeth import doubts

__all__ = ["doubts"]

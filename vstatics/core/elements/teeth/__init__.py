"""Warnings and notes about gears that cannot be cut or assembled, or that would wear early.

A case with such teeth can still be calculated, because ratios and torques depend only on the
numbers of teeth. None of these messages is therefore an error. The checks assume the usual profile
with a pressure angle of 20 degrees and an addendum of one module. The first warning or note that
other teeth can remove suggests nearby numbers of teeth.

`doubtful_teeth` collects all of them: `assembly` and `spacing` concern planets, `meshing` any gears
in mesh. `subjects` and `layout` represent the teeth of a gear set, `nearby` searches for better
teeth, and `conditions` contains the formulas.
"""

from vstatics.core.elements.teeth.doubtful_teeth import doubts

__all__ = ["doubts"]

"""A gear explained: its matrix, its equations with their solution, the formula of its ratio."""

from vstatics.explain.explanation import Explanation, explain

__all__ = ["Explanation", "explain"]

"""YAML file of a spectrum: `white`, or `variance` and `correlation`, or `points`."""

from __future__ import annotations

from typing import Any

from vstatics.core.errors import ReadError
from vstatics.core.model.shape import NUMBER, ByKey, KeyShape, Leaf, ListOf, RowOf
from vstatics.core.readers.named.reader import read_document
from vstatics.torsion.random.spectra import Correlation, Spectrum, SpectrumPoints, White

KEYS = ("white", "correlation", "points")
EXPECTED = "a spectrum: a mapping with `white`, `variance` and `correlation`, or `points`"


def _spectrum(**values: Any) -> Spectrum:
    if values.get("white") is not None:
        return White(values["white"])
    if values.get("points") is not None:
        return SpectrumPoints(tuple((float(w), value) for w, value in values["points"]))
    parts = tuple(values.get("correlation") or ())
    return Correlation(values.get("variance") or 0.0, parts, values.get("speed"))


def _fault(**values: Any) -> str:
    """Return the reason why keys do not describe a single spectrum, or an empty text."""
    given = [key for key in KEYS if values.get(key) is not None]
    if len(given) != 1:
        read = " and ".join(f"`{key}`" for key in given) or "none of them"
        return f"read {read}, expected one of `white`, `correlation` and `points`"
    extra = [key for key in ("variance", "speed") if values.get(key) is not None]
    if given != ["correlation"] and extra:
        return f"read `{extra[0]}` with `{given[0]}`, expected it with `correlation` only"
    if given == ["correlation"] and values.get("variance") is None:
        return "`variance` is missing, but `correlation` needs it"
    return ""


SPECTRUM = ByKey(
    "Spectrum",
    "Spectrum of a random excitation, two-sided over omega: its variance is 2 int_0^inf S d omega.",
    (
        KeyShape("white", NUMBER, "The spectrum at all frequencies, in unit^2*s/rad."),
        KeyShape("variance", NUMBER, "Variance of the excitation, in (N*m)^2 or rad^2."),
        KeyShape(
            "correlation",
            ListOf(RowOf((NUMBER, NUMBER, NUMBER), "share, alpha, beta"), "parts", unique=False),
            "Parts share*exp(-alpha*|t|)*cos(beta*t), in 1/s, or in 1/m with a `speed`.",
        ),
        KeyShape("speed", Leaf("velocity"), "Speed at which a road is driven over, in m/s."),
        KeyShape(
            "points",
            ListOf(RowOf((Leaf("si_speed"), NUMBER), "omega, spectrum"), "points", unique=False),
            "Omega in rad/s, which rises, and the spectrum there; 0 outside.",
        ),
    ),
    _spectrum,
    _fault,
)


def read_spectrum(data: bytes, file: str) -> Spectrum:
    """Read a spectrum.

    Raises
    ------
    ReadError
        If the file is not valid, with all problems and their positions.

    Examples
    --------
    >>> read_spectrum(b"white: 2.5", "input.yaml")
    White(white=2.5)
    """
    spectrum, spots = read_document(data, file, SPECTRUM, EXPECTED)
    if problems := list(spectrum.problems()):
        raise ReadError(map(spots.locate, problems))
    return spectrum  # type: ignore[no-any-return]

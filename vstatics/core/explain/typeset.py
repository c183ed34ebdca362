"""Equations, symbols and formulas in the math mode of LaTeX, without the dollar signs.

Names in subscripts are upright. Names with special characters are set in text mode.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Iterable, Mapping, Sequence

from vstatics.core.explain.formula import RatioFormula
from vstatics.core.explain.sums import Equation
from vstatics.core.tables.latex import escaped

_LETTER = re.compile(r"(eta|u|k|v|w|M|T)(?:_(?P<word>\w+)|\[(?P<name>.*)\]|(?P<number>\d+|x))")
_RATIO = re.compile(r"\b(?:eta|u|k)(?:_\w+|\d+)")
_PLAIN = re.compile(r"[A-Za-z0-9 .]+")
LONGEST_WITH_BARS = 60
"""Number of characters above which a formula has no fraction bars, so that lines can break."""


def symbol(name: str) -> str:
    r"""Return a symbol of the equations in LaTeX.

    >>> print(*map(symbol, ("w_sun", "w[ring 1]", "u1", "Mx", "eta_P_1", "0")))
    w_{\mathrm{sun}} w_{\mathrm{ring\ 1}} u_{1} M_{x} \eta_{\mathrm{P\_1}} 0
    """
    match = _LETTER.fullmatch(name)
    if match is None:
        return name
    letter = r"\eta" if match[1] == "eta" else match[1]
    below = match["number"] or _upright(match["word"] or match["name"] or "")
    return f"{letter}_{{{below}}}"


def _upright(name: str) -> str:
    if _PLAIN.fullmatch(name.replace("_", "")):
        spaced = name.replace("_", r"\_").replace(" ", r"\ ")
        return rf"\mathrm{{{spaced}}}"
    return rf"\mbox{{\scriptsize {escaped(name)}}}"


def in_ratios(text: str) -> str:
    r"""Return a text with LaTeX for the symbols of ratios and efficiencies.

    >>> in_ratios("u_P1 eta_P1 - 1")
    'u_{\\mathrm{P1}} \\eta_{\\mathrm{P1}} - 1'
    """
    return _RATIO.sub(lambda match: symbol(match[0]), text)


_IN_PROSE = re.compile(
    r"(u eta\^x|x = [+-]1|M \(w_\w+ - w_\w+\) [<>] 0|u/b|\(u \+ 1\)/2|\bMx\b"
    r"|i = w_\w+/w_\w+|i = 0|u = 1/i|-K M|M w_\w+ \(1 - K i\)|\(i, K\)"
    r"|(?<![\w.])[uMKib](?![\w.]))"
)
"""Pattern of formulas in sentences of an exercise, which are equal in all languages."""


def prose(sentence: str) -> str:
    r"""Return a sentence for LaTeX, with formulas in math mode.

    >>> print(prose("5 % of u eta^x, x = +1 where M (w_first - w_third) > 0"))
    5 \% of $u\,\eta^{x}$, $x = +1$ where $M\,(w_{\mathrm{first}} - w_{\mathrm{third}}) > 0$
    """
    parts = _IN_PROSE.split(sentence)
    parts[::2] = map(escaped, parts[::2])
    parts[1::2] = (f"${_in_math(part)}$" for part in parts[1::2])
    return "".join(parts)


def _in_math(formula: str) -> str:
    spaced = formula.replace(" eta^x", r"\,\eta^{x}").replace("M (", r"M\,(")
    return re.sub(r"w_\w+|Mx", lambda match: symbol(match[0]), spaced)


def equation(row: Equation, parts: Callable[[Equation], list[str]]) -> str:
    r"""Return an equation in LaTeX, in symbols or in numbers.

    Parameters
    ----------
    parts : callable
        Function `in_symbols` or `in_numbers`.

    Examples
    --------
    >>> from vstatics.core.explain.sums import Term, in_numbers, in_symbols
    >>> row = Equation("P", [Term("w_1", "1", 1.0), Term("w[a b]", "u_P - 1", -3.5)], 0.0)
    >>> print(equation(row, in_symbols))
    w_{\mathrm{1}} + (u_{\mathrm{P}} - 1) w_{\mathrm{a\ b}} = 0
    >>> print(equation(row, in_numbers))
    w_{\mathrm{1}} - 3.5 w_{\mathrm{a\ b}} = 0
    """
    unknowns = [f"\0{number}\0" for number in range(len(row.terms))]
    terms = [term._replace(unknown=new) for term, new in zip(row.terms, unknowns, strict=True)]
    text = _powers(in_ratios(" ".join(parts(row._replace(terms=terms)))))
    for term, new in zip(row.terms, unknowns, strict=True):
        text = text.replace(new, symbol(term.unknown))
    return text


def _powers(text: str) -> str:
    return re.sub(r"(\d)e([+-]\d+)", lambda e: rf"{e[1]} \cdot 10^{{{int(e[2])}}}", text)


def formula(ratio_formula: RatioFormula) -> str:
    """Return the right-hand side of a formula in LaTeX, with fraction bars if short."""
    names = [*(each.name for each in ratio_formula.symbols), *ratio_formula.speeds]
    if len(ratio_formula.text) > LONGEST_WITH_BARS:
        return _named(ratio_formula.text, names)
    letters = [f"u{n}" for n, _ in enumerate(ratio_formula.symbols, 1)]
    letters += [f"w{n}" for n, _ in enumerate(ratio_formula.speeds, 1)]
    known = {letter: symbol(name) for letter, name in zip(letters, names, strict=True)}
    return _with_bars(ast.parse(ratio_formula.expression, mode="eval").body, known)


def _with_bars(part: ast.expr, names: Mapping[str, str]) -> str:
    r"""Return an expression with fraction bars; the order of terms does not change.

    >>> tree = ast.parse("1 - (u1 - 1)*u2**2/-u1", mode="eval").body
    >>> print(_with_bars(tree, {"u1": "a", "u2": "b"}))
    1 - \frac{\left(a - 1\right) b^{2}}{-a}
    """

    def factor(operand_part: ast.expr) -> str:
        is_sum = isinstance(operand_part, ast.BinOp) and isinstance(
            operand_part.op, ast.Add | ast.Sub
        )
        text = _with_bars(operand_part, names)
        return rf"\left({text}\right)" if is_sum or isinstance(operand_part, ast.UnaryOp) else text

    match part:
        case ast.Name(id=name):
            return names[name]
        case ast.UnaryOp(operand=operand):
            return f"-{factor(operand)}"
        case ast.BinOp(left=left, op=op, right=right):
            whole = _with_bars(left, names), _with_bars(right, names)
            return {
                ast.Add: f"{whole[0]} + {whole[1]}",
                ast.Sub: f"{whole[0]} - {factor(right)}",
                ast.Mult: f"{factor(left)} {factor(right)}",
                ast.Div: rf"\frac{{{whole[0]}}}{{{whole[1]}}}",
                ast.Pow: f"{factor(left)}^{{{whole[1]}}}",
            }[type(op)]
    return ast.unparse(part)


def _named(text: str, names: Iterable[str]) -> str:
    """Return a text in which symbols replace names, longest names first."""
    longest_first: Sequence[str] = sorted(names, key=len, reverse=True)
    anyone = "|".join(rf"(?<!\w){re.escape(name)}(?!\w)" for name in longest_first)
    return re.sub(anyone, lambda name: symbol(name[0]), text) if longest_first else text

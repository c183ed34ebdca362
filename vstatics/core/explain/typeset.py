r"""Equations, symbols and formulas as LaTeX has them in math mode, without its dollars.

Names stand upright in indices; what is more than plain letters is set as text there.
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
LONGEST = 60
"""A formula of more signs has no fraction bars, so that it can be broken."""


def symbol(name: str) -> str:
    r"""A symbol of the equations.

    >>> print(*map(symbol, ("w_sun", "w[ring 1]", "u1", "Mx", "eta_P_1", "0")))
    w_{\mathrm{sun}} w_{\mathrm{ring\ 1}} u_{1} M_{x} \eta_{\mathrm{P\_1}} 0
    """
    found = _LETTER.fullmatch(name)
    if found is None:
        return name
    letter = r"\eta" if found[1] == "eta" else found[1]
    below = found["number"] or _upright(found["word"] or found["name"] or "")
    return f"{letter}_{{{below}}}"


def _upright(name: str) -> str:
    if _PLAIN.fullmatch(name.replace("_", "")):
        spaced = name.replace("_", r"\_").replace(" ", r"\ ")
        return rf"\mathrm{{{spaced}}}"
    return rf"\mbox{{\scriptsize {escaped(name)}}}"


def in_ratios(text: str) -> str:
    r"""A text with symbols of ratios and efficiencies.

    >>> in_ratios("u_P1 eta_P1 - 1")
    'u_{\\mathrm{P1}} \\eta_{\\mathrm{P1}} - 1'
    """
    return _RATIO.sub(lambda found: symbol(found[0]), text)


_IN_PROSE = re.compile(
    r"(u eta\^x|x = [+-]1|M \(w_\w+ - w_\w+\) [<>] 0|u/b|\(u \+ 1\)/2|\bMx\b"
    r"|i = w_\w+/w_\w+|i = 0|u = 1/i|-K M|M w_\w+ \(1 - K i\)|\(i, K\)"
    r"|(?<![\w.])[uMKib](?![\w.]))"
)
"""Formulas of sentences about an exercise, the same in each language."""


def prose(sentence: str) -> str:
    r"""A sentence for LaTeX, with its formulas in math mode.

    >>> print(prose("5 % of u eta^x, x = +1 where M (w_first - w_third) > 0"))
    5 \% of $u\,\eta^{x}$, $x = +1$ where $M\,(w_{\mathrm{first}} - w_{\mathrm{third}}) > 0$
    """
    parts = _IN_PROSE.split(sentence)
    parts[::2] = map(escaped, parts[::2])
    parts[1::2] = (f"${_in_math(one)}$" for one in parts[1::2])
    return "".join(parts)


def _in_math(formula: str) -> str:
    spaced = formula.replace(" eta^x", r"\,\eta^{x}").replace("M (", r"M\,(")
    return re.sub(r"w_\w+|Mx", lambda found: symbol(found[0]), spaced)


def equation(one: Equation, parts: Callable[[Equation], list[str]]) -> str:
    r"""An equation, in symbols or in numbers.

    Parameters
    ----------
    parts : callable
        `in_symbols` or `in_numbers`.

    Examples
    --------
    >>> from vstatics.core.explain.sums import Term, in_numbers, in_symbols
    >>> row = Equation("P", [Term("w_1", "1", 1.0), Term("w[a b]", "u_P - 1", -3.5)], 0.0)
    >>> print(equation(row, in_symbols))
    w_{\mathrm{1}} + (u_{\mathrm{P}} - 1) w_{\mathrm{a\ b}} = 0
    >>> print(equation(row, in_numbers))
    w_{\mathrm{1}} - 3.5 w_{\mathrm{a\ b}} = 0
    """
    unknowns = [f"\0{number}\0" for number in range(len(one.terms))]
    terms = [term._replace(unknown=new) for term, new in zip(one.terms, unknowns, strict=True)]
    made = _powers(in_ratios(" ".join(parts(one._replace(terms=terms)))))
    for term, new in zip(one.terms, unknowns, strict=True):
        made = made.replace(new, symbol(term.unknown))
    return made


def _powers(text: str) -> str:
    """Numbers with powers of ten."""
    return re.sub(r"(\d)e([+-]\d+)", lambda e: rf"{e[1]} \cdot 10^{{{int(e[2])}}}", text)


def formula(one: RatioFormula) -> str:
    """The right side of a formula, with fraction bars if it is not long."""
    names = [*(each.name for each in one.symbols), *one.speeds]
    if len(one.text) > LONGEST:
        return _named(one.text, names)
    letters = [f"u{n}" for n, _ in enumerate(one.symbols, 1)]
    letters += [f"w{n}" for n, _ in enumerate(one.speeds, 1)]
    known = {letter: symbol(name) for letter, name in zip(letters, names, strict=True)}
    return _with_bars(ast.parse(one.expression, mode="eval").body, known)


def _with_bars(part: ast.expr, names: Mapping[str, str]) -> str:
    r"""An expression in the order in which it is written.

    >>> tree = ast.parse("1 - (u1 - 1)*u2**2/-u1", mode="eval").body
    >>> print(_with_bars(tree, {"u1": "a", "u2": "b"}))
    1 - \frac{\left(a - 1\right) b^{2}}{-a}
    """

    def factor(one: ast.expr) -> str:
        is_sum = isinstance(one, ast.BinOp) and isinstance(one.op, ast.Add | ast.Sub)
        text = _with_bars(one, names)
        return rf"\left({text}\right)" if is_sum or isinstance(one, ast.UnaryOp) else text

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
    """A text with these names; the longest are found first."""
    found: Sequence[str] = sorted(names, key=len, reverse=True)
    anyone = "|".join(rf"(?<!\w){re.escape(name)}(?!\w)" for name in found)
    return re.sub(anyone, lambda name: symbol(name[0]), text) if found else text

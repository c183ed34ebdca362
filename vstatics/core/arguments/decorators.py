"""Decorators of public functions: checks of argument types, and names of arguments in problems."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Mapping, Sequence
from functools import wraps
from typing import Any, ParamSpec, TypeVar

from vstatics.core.arguments.types import fits, hints
from vstatics.core.arguments.words import expected, is_no_choice, type_and_value
from vstatics.core.errors import CaseError, listed
from vstatics.core.extras import needed
from vstatics.core.suggestions import nearest

Asked = ParamSpec("Asked")
Given = TypeVar("Given")


def refusing(**classes: str) -> Callable[[Callable[Asked, Given]], Callable[Asked, Given]]:
    """Return a decorator that raises an error for arguments of the wrong type.

    Parameters
    ----------
    **classes : str
        Modules of types that the module of the function does not import, by name of the type.

    Examples
    --------
    >>> @refusing()
    ... def twice(number: float, times: int = 1) -> float:
    ...     return 2 * number * times
    >>> twice(3)
    6
    >>> twice("3")
    Traceback (most recent call last):
    TypeError: twice of str '3': expected a number
    >>> twice(3, times=0.5)
    Traceback (most recent call last):
    TypeError: twice: `times` is float 0.5, expected a whole number

    A text that is not an allowed choice raises ValueError.
    """

    def decorated(function: Callable[Asked, Given]) -> Callable[Asked, Given]:
        names, takes_any = _arguments(function)
        known: dict[str, Any] = {}

        @wraps(function)
        def refused(*args: Asked.args, **kwargs: Asked.kwargs) -> Given:
            if not known:
                known.update(hints(function, classes))
            for name, given in (*zip(names, args, strict=False), *kwargs.items()):
                if name not in names and not takes_any:
                    hint = nearest(name, names) or f"; there are {listed(names, len(names))}"
                    raise TypeError(f"{function.__name__}: there is no argument `{name}`{hint}")
                if name in known and not fits(given, known[name]):
                    what = type_and_value(given)
                    read = f" of {what}:" if name == names[0] else f": `{name}` is {what},"
                    wrong = ValueError if is_no_choice(given, known[name]) else TypeError
                    raise wrong(f"{function.__name__}{read} {expected(given, known[name])}")
            try:
                return function(*args, **kwargs)
            except ImportError as error:
                raise needed(error, function.__name__, function.__module__) from None

        return refused

    return decorated


def refuse_fields(what: str, fields: object, types: Mapping[str, object], **classes: str) -> None:
    """Raise an error if the values of a dataclass are not of the declared types.

    Parameters
    ----------
    types : mapping
        Types of fields that replace the declared types.

    Raises
    ------
    TypeError
    """
    for name, hint in {**hints(type(fields), classes), **types}.items():
        given = getattr(fields, name)
        if not fits(given, hint):
            raise TypeError(f"{what}: `{name}` is {type_and_value(given)}, {expected(given, hint)}")


def naming(function: Callable[Asked, Given]) -> Callable[Asked, Given]:
    """Decorate a function so that problems name Python arguments instead of options.

    Examples
    --------
    >>> @naming
    ... def cut(shifts: str, by: str) -> None:
    ...     raise CaseError("E426", "--shift: expected text, and --by; or --all")
    >>> cut("", "")
    Traceback (most recent call last):
    vstatics.core.errors.CaseError: `shifts`: expected text, and `by`; or --all [E426]
    """
    names, _ = _arguments(function)

    def named(option: re.Match[str]) -> str:
        name = option[1].replace("-", "_")
        matches = [argument for argument in names if argument in {name, f"{name}s"}]
        return f"`{matches[0]}`" if matches else option[0]

    @wraps(function)
    def checked(*args: Asked.args, **kwargs: Asked.kwargs) -> Given:
        try:
            return function(*args, **kwargs)
        except CaseError as error:
            raise type(error)(
                problem._replace(
                    message=re.sub(_OPTION, named, problem.message),
                    place=problem.place
                    and problem.place._replace(
                        file=re.sub(_OPTION, named, problem.place.file).strip("`")
                    ),
                )
                for problem in error.problems
            ) from None

    return checked


_OPTION = r"(?<!\S)--([a-z][a-z-]*[a-z]|[a-z])\b"


def _arguments(function: Callable[..., Any]) -> tuple[Sequence[str], bool]:
    """Return the names of the arguments, and whether further arguments are accepted."""
    code = inspect.unwrap(function).__code__
    names = code.co_varnames[: code.co_argcount + code.co_kwonlyargcount]
    return names, bool(code.co_flags & inspect.CO_VARKEYWORDS)

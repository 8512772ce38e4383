"""Refuses unknown keywords as the program refuses unknown options."""
from __future__ import annotations

import difflib
import functools
import inspect
import re
from typing import Any, Callable

from touchdown._touchdown import InputError


def _names_of(function: Callable) -> list[str]:
    try:
        return [name for name in inspect.signature(function).parameters if name != "self"]
    except ValueError:  # a function of the compiled module has its signature in its documentation
        signature = (function.__doc__ or "").splitlines()[0]
        return [name for name in re.findall(r"(\w+): ", signature) if name != "self"]


def checked(function: Callable, title: str = "") -> Callable:
    """The function, which raises `InputError` with the nearest name for a keyword that it does not have."""
    title = title or function.__name__
    known = _names_of(function)

    @functools.wraps(function)
    def call(*arguments: Any, **keywords: Any) -> Any:
        for name in keywords:
            if name not in known:
                near = difflib.get_close_matches(name, known, 1)
                raise InputError(f"{title}: unknown keyword '{name}': expected one of {', '.join(known)}"
                                 + (f" (did you mean '{near[0]}'?)" if near else ""))
        return function(*arguments, **keywords)
    return call

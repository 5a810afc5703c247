# SPDX-License-Identifier: BSD-3-Clause
"""Functions of the user as callbacks: each gets the arguments that its parameters name."""
from __future__ import annotations

import inspect
from typing import Any, Callable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from .errors import ArgumentError

Array = NDArray[np.float64]


class Scalar:
    """A function of single places: see scalar()."""

    def __init__(self, function: Callable[..., Any]) -> None:
        self.function = function
        self.__doc__ = getattr(function, "__doc__", None)
        self.__name__ = getattr(function, "__name__", type(function).__name__)

    def __call__(self, *arguments: Any) -> Any:
        return self.function(*arguments)


def scalar(function: Callable[..., Any]) -> Scalar:
    """Marks a callback that takes one place at a time: its arguments are floats, its result is one row. Callbacks that
    are not marked take many places at once: arrays of n numbers, (n, 2) for uv and (n, 3) for xyz. May be used as a
    decorator."""
    return Scalar(function)


class Named:
    """A function and the offered values that it takes.

    function   of the user, scalar or not
    offer      names of values, in the order in which a function without names gets the first `usual` of them
    whole      the value for a function of one parameter with any other name: "uv", "xyz" or "t"
    """

    def __init__(self, function: Callable[..., Any], offer: Sequence[str], usual: int, whole: str) -> None:
        self.scalar = isinstance(function, Scalar)
        self.function = function.function if isinstance(function, Scalar) else function
        if not callable(self.function):
            raise ArgumentError(f"{function!r} is not a function")
        self.names = _names(self.function, list(offer), list(offer[:usual]), whole)

    def __call__(self, values: Mapping[str, Any]) -> Any:
        return self.function(*[values[name] for name in self.names])


def _names(function: Callable[..., Any], offer: list[str], usual: list[str], whole: str) -> list[str]:
    try:
        parameters = list(inspect.signature(function).parameters.values())
    except (TypeError, ValueError):  # of C
        return usual
    if any(p.kind is inspect.Parameter.VAR_POSITIONAL for p in parameters):
        return usual
    needed = [p.name for p in parameters if p.kind in (p.POSITIONAL_ONLY, p.POSITIONAL_OR_KEYWORD) and
              (p.name in offer or p.default is p.empty)]
    unknown = [name for name in needed if name not in offer]
    if len(needed) == 1 and unknown:
        return [whole]
    if unknown:
        name = getattr(function, "__name__", "the callback")
        raise ArgumentError(f"{name} has the parameter {unknown[0]}: there are {', '.join(offer)}")
    return needed


def rows_of(result: Any, out: Array, what: str) -> None:
    """Puts the result of a function of many places into n rows: an array of n rows, or a column (or a constant) for each
    of the components, in a tuple."""
    if isinstance(result, (tuple, list)) and len(result) == out.shape[1]:
        for k, column in enumerate(result):
            out[:, k] = column
        return
    array = np.asarray(result, dtype=np.float64)
    if array.shape != out.shape:
        raise ValueError(f"{what} has returned the shape {array.shape}; it must be {out.shape}, or a tuple of {out.shape[1]} columns")
    out[...] = array


def each_place(function: Named, values: Mapping[str, Any], count: int, uv: Any = None) -> list[Any]:
    """The results of a scalar function at each place; an exception names the place."""
    columns = [values[name] for name in function.names]
    columns = [each.tolist() if isinstance(each, np.ndarray) else [each] * count for each in columns]
    results: list[Any] = []
    try:
        for arguments in zip(*columns):
            results.append(function.function(*arguments))
    except Exception as error:
        if uv is not None:
            error._carreau_place = {"uv": tuple(uv[len(results)].tolist())}  # type: ignore[attr-defined]
        raise
    return results

# Generated from the message definitions by `make docs`.
"""Bases of the stubs: fields that hold numbers, and services."""

from array import array
from collections.abc import Sequence
from typing import Any, Generic, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

Number = TypeVar("Number", int, float)
Request = TypeVar("Request")
Response = TypeVar("Response")

Numbers: TypeAlias = Sequence[Number] | array[Number] | NDArray[np.number[Any]]

class NumbersField(Generic[Number]):
    def __get__(self, message: object, owner: object = ...) -> array[Number]: ...
    def __set__(self, message: object, values: Numbers[Number]) -> None: ...

class Service(Generic[Request, Response]):
    Request: type[Request]
    Response: type[Response]

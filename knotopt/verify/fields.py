"""A certificate's fields, read with their types."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from knotopt.errors import CertificateError


def field(content: Mapping[str, Any], key: str, kind: type) -> Any:
    """The value of a key.

    Raises
    ------
    CertificateError
        It is missing, or of another type.
    """
    if key not in content:
        raise CertificateError(f"key {key!r} is missing")
    value = content[key]
    if not isinstance(value, kind) or (kind is int and isinstance(value, bool)):
        raise CertificateError(f"{key}: {value!r} is not of type {kind.__name__}")
    return value


def integer(value: Any, key: str) -> int:
    """The value, if it is an integer.

    Raises
    ------
    CertificateError
    """
    if not isinstance(value, int) or isinstance(value, bool):
        raise CertificateError(f"{key}: {value!r} is no integer")
    return value


def integers(values: Any, key: str = "clauses") -> tuple[int, ...]:
    """The values, if they are a list of integers.

    Raises
    ------
    CertificateError
    """
    if not isinstance(values, list):
        raise CertificateError(f"{values!r} is no list of integers")
    return tuple(integer(value, key) for value in values)

"""Converts Python values to the `KEY=VALUE` of the program's option --set."""
from __future__ import annotations

import json
from typing import Any, Iterable, Mapping


def estimator_name(estimator: type) -> str:
    """The name of a class in an experiment: `python:module.Class`."""
    return f"python:{estimator.__module__}.{estimator.__qualname__}"


def _plain(value: Any) -> Any:
    if isinstance(value, type):
        return estimator_name(value)
    if hasattr(value, "tolist"):  # an array or number of NumPy
        return value.tolist()
    return str(value)


def as_text(value: Any, indent: int | None = None) -> str:
    """The value as JSON, which is valid YAML."""
    return json.dumps(value, default=_plain, ensure_ascii=False, indent=indent)


def assignments(overrides: Mapping[str, Any] | Iterable[str] | None) -> list[str]:
    """{"noise.torque": [0, 1]} or ["noise.torque=[0,1]"] → ["noise.torque=[0, 1]"]."""
    if overrides is None:
        return []
    if not isinstance(overrides, Mapping):
        return [str(one) for one in overrides]
    return [f"{key}={value if isinstance(value, str) else as_text(value)}"
            for key, value in overrides.items()]

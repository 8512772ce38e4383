"""Experiments, which may include estimators written in Python."""
from __future__ import annotations

import csv
import difflib
import importlib
import inspect
import os
import pathlib
import shlex
import sys
import types
import uuid
from collections.abc import Iterator, Mapping
from typing import Any, Iterable

import numpy as np

from touchdown import _touchdown
from touchdown._touchdown import InputError
from touchdown.overrides import as_text, assignments, estimator_name

PREFIX = "python:"
SENSORS = ("hip_torque", "knee_torque", "wheel_torque", "acceleration", "joint_position", "joint_velocity")


class Tables(Mapping):
    """The tables of a run directory by name, each a dict of columns: arrays of numbers, or of texts."""

    def __init__(self, folder: pathlib.Path):
        self._folder = folder

    def __getitem__(self, name: str) -> dict[str, np.ndarray]:
        path = self._folder / f"{name}.csv"
        if not path.is_file():
            raise KeyError(f"{name}: expected one of {', '.join(self)}")
        with path.open(newline="", encoding="utf-8") as file:
            header, *rows = csv.reader(file)
        return {name: _column([row[i] for row in rows]) for i, name in enumerate(header)}

    def __iter__(self) -> Iterator[str]:
        return iter(sorted(path.stem for path in self._folder.glob("*.csv")))

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def __repr__(self) -> str:
        return f"<Tables: {', '.join(self)}>"


def _column(cells: list[str]) -> np.ndarray:
    try:
        return np.array([float(cell) for cell in cells])
    except ValueError:
        return np.array(cells)


class Result:
    """The result of an experiment.

    path: its run directory
    id: the digest of everything that determines its numbers
    tables: its tables by name ("success", "classification", "latency", …), each a dict of columns
    text: the tables that the program prints
    studies: text summaries of its studies
    failed_demands: estimators that fail a verdict the experiment demands
    """

    def __init__(self, path: pathlib.Path, id: str, text: str, studies: list[str], failed_demands: list[str]):
        self.path = path
        self.id = id
        self.text = text
        self.studies = studies
        self.failed_demands = failed_demands
        self.tables = Tables(path / "tables")

    def __repr__(self) -> str:
        return f"<Result: {self.path}>"


class _Signals(dict):
    """The signals that an estimator gets. An unknown name raises an error that lists the known ones."""

    def __missing__(self, name: str) -> Any:
        near = difflib.get_close_matches(str(name), self, 1)
        raise KeyError(f"'{name}' is no signal: expected one of {', '.join(self)}" + (f" (did you mean '{near[0]}'?)" if near else ""))


class _OneRunEstimator:
    """An instance of a user's estimator, for one run of the robot."""

    def __init__(self, estimator: Any):
        self._estimator = estimator

    def run(self, signals: dict[str, Any]) -> Any:
        return self._estimator.run(_Signals(signals))


def _found(name: str, place: str) -> type:
    """The class that an experiment calls `python:module.Class`, at this place of its file."""
    complaint = f"{place}: estimators: '{name}'"
    module_name, _, class_name = name.removeprefix(PREFIX).rpartition(".")
    if not module_name or not class_name:
        raise InputError(f"{complaint}: expected python:module.Class")
    try:
        found: Any = importlib.import_module(module_name)
    except ModuleNotFoundError as error:
        if error.name is None or not module_name.startswith(error.name):
            raise  # the module exists and imports a missing one
        raise InputError(f"{complaint}: there is no module '{module_name}' in {os.getcwd()} "
                         "or where Python looks for modules") from error
    if not hasattr(found, class_name):
        near = difflib.get_close_matches(class_name, dir(found), 1)
        raise InputError(f"{complaint}: module '{module_name}' has no '{class_name}'" +
                         (f" (did you mean '{near[0]}'?)" if near else ""))
    found = getattr(found, class_name)
    if not callable(getattr(found, "run", None)):
        raise InputError(f"{complaint}: expected a class with a method run(self, signals)")
    return found


def _codes(code: types.CodeType) -> Iterator[types.CodeType]:
    """A code object and all code objects in it."""
    yield code
    for constant in code.co_consts:
        if isinstance(constant, types.CodeType):
            yield from _codes(constant)


def _is_loaded(estimator: type, source: str) -> bool:
    """Whether the loaded code equals its file, which may have been edited since the import."""
    written = {(code.co_name, code.co_firstlineno): code
               for code in _codes(compile(source, "source", "exec", dont_inherit=True))}
    file = inspect.getsourcefile(estimator)
    loaded = [method.__code__ for method in vars(estimator).values()
              if inspect.isfunction(method) and method.__code__.co_filename == file]
    return all(written.get((code.co_name, code.co_firstlineno)) == code for code in loaded)


def _revision(estimator: type) -> str:
    """The source of an estimator. Saved results count only for an unchanged source."""
    try:
        source = inspect.getsource(inspect.getmodule(estimator))
    except (OSError, TypeError):
        pass
    else:
        if _is_loaded(estimator, source):
            return source
        raise InputError(f"estimators: '{estimator_name(estimator)}': {inspect.getsourcefile(estimator)} was changed "
                         "since it was imported: import it anew (importlib.reload), or start Python again")
    try:
        return inspect.getsource(estimator)
    except (OSError, TypeError):
        return uuid.uuid4().hex  # unknown: no saved result counts


def _described(name: str, place: str) -> dict[str, Any]:
    estimator = _found(name, place)
    lines = (inspect.getdoc(estimator) or "").splitlines()
    return {"name": name, "title": getattr(estimator, "title", estimator.__name__),
            "summary": lines[0] if lines else "written in Python",
            "sensors": list(getattr(estimator, "sensors", SENSORS)), "revision": _revision(estimator),
            "make": lambda: _OneRunEstimator(estimator())}


def run(experiment: str | os.PathLike | Mapping[str, Any], *, overrides: Mapping[str, Any] | Iterable[str] | None = None,
        out: str | os.PathLike | None = None, overwrite: bool = False, pictures: bool = False, video: bool = True) -> Result:
    """Run an experiment, as `touchdown run` does: simulate, fit, estimate, score, tables, figures, films, report.

    experiment: a path, one of the shipped ones ("experiments/stairs.yaml"), or a dict with the content of such a file
    overrides: values to change, by dotted key: {"test.runs": 2, "estimators": ["robust", Mine]}
    out: run directory; without it runs/<experiment>/<id>
    overwrite: replace another experiment in that directory
    pictures: draw figures, films and report.html; without it, tables only
    video: False leaves out the films

    Results that an earlier call saved there are reused. Estimators may include your own:
    "python:module.Class", or the class itself in `overrides` or a dict. Such a class is instantiated
    without arguments for every run of the robot, and needs one method:

        class Falls:
            '''One line about it, for tables.'''
            title = "Falls"               # optional
            sensors = ("acceleration",)   # optional: the sensors it sees, others are NaN; without it, all
            def run(self, signals):
                '''signals: the arrays that Estimator.run takes, of steps with a record, and `sample_rate` (Hz).
                Returns P(contact), as an array or as the dict that Estimator.run returns.'''
                return signals["vertical_acceleration"] > -4.9

    The method is called once per run and noise level, with all steps, from threads that hold Python's lock.
    """
    changes = assignments(overrides)
    text = as_text(experiment, indent=1) if isinstance(experiment, Mapping) else None
    file = "experiment" if isinstance(experiment, Mapping) else os.fspath(experiment)
    external_estimators = [_described(name, place) for name, place in _touchdown.python_estimators(file, text, changes)]
    command = " ".join(["touchdown.run" if text else "python3 -m touchdown run", shlex.quote(file)] +
                       [f"--set {shlex.quote(change)}" for change in changes])
    return Result(**_touchdown.run(file, text, changes, out or "", overwrite, pictures, video,
                                   command, external_estimators))


def main(arguments: list[str] | None = None) -> int:
    """`python3 -m touchdown run`: the program's verb, for experiments with estimators in Python."""
    import argparse

    parser = argparse.ArgumentParser(prog="python3 -m touchdown", description=main.__doc__)
    verb = parser.add_subparsers(required=True, metavar="run").add_parser("run", help="run an experiment")
    verb.add_argument("experiment")
    verb.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="change a value of the experiment")
    verb.add_argument("--out", help="run directory (default: runs/<experiment>/<id>)")
    verb.add_argument("--overwrite", action="store_true", help="replace another experiment in that directory")
    verb.add_argument("--no-pictures", action="store_true", help="write tables only, without figures and videos")
    verb.add_argument("--no-video", action="store_true", help="write tables, figures and the report, but no videos")
    given = parser.parse_args(arguments)
    try:
        result = run(given.experiment, overrides=given.set, out=given.out, overwrite=given.overwrite,
                     pictures=not given.no_pictures, video=not given.no_video)
    except _touchdown.Error as error:
        print(f"touchdown: {error}", file=sys.stderr)
        return 2 if isinstance(error, InputError) else 1
    except KeyboardInterrupt as interrupt:
        print("touchdown:", *getattr(interrupt, "__notes__", ["stopped"]), file=sys.stderr)
        return 1
    print(result.text, f"results   {result.path}", f"tables    {result.path / 'tables'}", sep="\n")
    if not given.no_pictures:
        print(f"report    {result.path / 'report.html'}", f"figures   {result.path / 'figures'}", sep="\n")
    return 1 if result.failed_demands else 0

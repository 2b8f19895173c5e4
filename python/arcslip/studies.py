"""The studies of a scene as methods, made from the keys of each kind of study."""

from __future__ import annotations

import inspect
import json
import keyword
import math
import textwrap
import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from . import _core
from .errors import ArcslipWarning
from .files.arrays import as_json
from .from_core import from_core, warn
from .names import nearest
from .progress import Progress, reporting
from .results import Results
from .threads import checked

if TYPE_CHECKING:
    from .scene import Scene

TYPES = {
    "number": "float",
    "whole": "int",
    "text": "str",
    "word": "str",
    "frequency": "float",
    "window": "Sequence[float]",
    "parameter": "str",
    "value": "float",
    "parameters": "Sequence[str]",
    "followed": "str",
}

PROGRESS = (
    "True for a bar, of tqdm where it is installed; or a callable, called with the progress, a dict, some ten times a second,"
    " which ends the computation by returning False."
)
COMMON = {
    "study": ("str", "The study of the scene that gives the keys that are left out; by default the first of the kind."),
    "for_each": ("Mapping[str, Sequence[float] | NDArray[Any]]", "Values of parameters, for whose combinations the study is repeated."),
    "threads": ("int", "Threads to use; by default as many as there are processors."),
    "progress": ("bool | Callable[[dict[str, Any]], object]", PROGRESS),
}
#: Of studies of branches.
OF_BRANCHES = {
    "coefficients": ("bool", "Whether results have the Fourier coefficients of the response. Default: False."),
    "columns": (
        "Iterable[str]",
        'The columns of points and events that are computed, with or without "elements": "amplitude", "damper.energy"; events'
        " also have their `kind`. By default all.",
    ),
}


def run(
    core: _core.Scene,
    which: Sequence[int],
    coefficients: bool,
    columns: Iterable[str] | None,
    threads: int | None,
    progress: Progress | None,
) -> Results:
    """Run studies of a scene. What ends them early is raised with the results so far as its attribute `results`."""
    count, names = checked(threads), None if columns is None else _names(columns)
    studies = core.studies()
    with reporting(progress, ", ".join(dict.fromkeys(studies[i][0] for i in which))) as report:
        found, begun, error = _core.run(core, list(which), coefficients, names, count, report)
        results = from_core(found, core.labels)
        if error is not None:
            error.results = results  # type: ignore[attr-defined]
            raise error
    warn(found, 3)
    _warn_of_combinations(core, which[:begun], results)
    if begun < len(which):
        warnings.warn(f"stopped: {len(which) - begun} of {len(which)} studies were not started", ArcslipWarning, 3)
    return results


def _names(columns: Any) -> list[str]:
    names = list(columns) if isinstance(columns, Iterable) and not isinstance(columns, str) else []
    if not names or not all(isinstance(name, str) for name in names):
        raise TypeError(f"found {columns!r} for 'columns', must be a list of names")
    return names


def _combinations(for_each: Any) -> int:
    """Return the number of combinations; 0 where a file has them."""
    if isinstance(for_each, list):
        return len(for_each)
    if not isinstance(for_each, dict):
        return 0
    return for_each["count"] if "distributions" in for_each else math.prod(len(values) for values in for_each.values())


def _warn_of_combinations(core: _core.Scene, which: Sequence[int], results: Results) -> None:
    """Warn of combinations that were not begun, where a computation was stopped."""
    if all(result.status != "stopped" for result in results):
        return
    studies = json.loads(core.write())["studies"]
    for name, for_each in ((studies[i]["name"], studies[i].get("for_each", {})) for i in which):
        count, begun = _combinations(for_each), len({tuple(result.set.items()) for result in results.of(name)})
        if begun < count:
            warnings.warn(f"stopped: {count - begun} of {count} combinations of {name!r} were not started", ArcslipWarning, 4)


def argument(key: str) -> str:
    """Return the name of the argument for a key: "from_" for "from"."""
    return key + "_" if keyword.iskeyword(key) else key


def _arguments(kind: Mapping[str, Any]) -> dict[str, Mapping[str, Any]]:
    return {argument(key["name"]): key for key in kind["keys"]}


def _default(key: Mapping[str, Any]) -> Any:
    return json.loads(key["default"]) if key["default"] else None


def _unit(key: Mapping[str, Any]) -> str:
    of = {"": "", "frequency": "in the unit of the scene's frequencies", "parameter": "in the unit of the parameter"}
    return of.get(key["unit"], f"in {key['unit']}") if key["unit"] != "-" else ""


def _described(name: str, type_: str, text: str) -> str:
    return f"{name} : {type_}, optional\n" + textwrap.indent(textwrap.fill(text, 100), "    ")


def _sentence(text: str) -> str:
    return text[:1].upper() + text[1:] + "."


def _docstring(kind: Mapping[str, Any]) -> str:
    entries = []
    for name, key in _arguments(kind).items():
        parts = [key["help"], key["allowed"], _unit(key)]
        text = _sentence("; ".join(part for part in parts if part))
        if key["default"]:
            text += f" Default: {_default(key)!r}."
        entries.append(_described(name, TYPES.get(key["type"], "object"), text))
    common = COMMON | (OF_BRANCHES if kind["takes_coefficients"] else {})
    entries += [_described(name, type_, text) for name, (type_, text) in common.items()]
    required = [argument(key["name"]) for key in kind["keys"] if key["required"]]
    needed = f" A scene without one needs {', '.join(required)}." if required else ""
    return (
        f"{_sentence(kind['help'])}\n\nWhat is not given is taken from the first study of the kind {kind['name']!r} that"
        f" the scene has, else it is the default.{needed}\n\nParameters\n----------\n"
        + "\n".join(entries)
        + "\n\nReturns\n-------\nResults\n"
    )


def _signature(kind: Mapping[str, Any]) -> inspect.Signature:
    def only(name: str, default: Any, annotation: str) -> inspect.Parameter:
        return inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=annotation)

    own = [
        only(name, _default(key), TYPES.get(key["type"], "Any") + ("" if key["default"] else " | None"))
        for name, key in _arguments(kind).items()
    ]
    common = [only(name, None, f"{type_} | None") for name, (type_, _) in COMMON.items()]
    if kind["takes_coefficients"]:
        common += [only("coefficients", False, "bool"), only("columns", None, f"{OF_BRANCHES['columns'][0]} | None")]
    itself = inspect.Parameter("self", inspect.Parameter.POSITIONAL_ONLY)
    return inspect.Signature([itself, *own, *common], return_annotation="Results")


def _template(core: _core.Scene, kind: str, study: str | None, over: object) -> int | None:
    """Return the index of the study whose keys a call changes: that of a name, one over the same parameter, or the first."""
    own = [i for i, (_, of) in enumerate(core.studies()) if of == kind]
    if study is not None:
        for i in own:
            if core.studies()[i][0] == study:
                return i
        raise ValueError(f"found study={study!r}, must be one of {[core.studies()[i][0] for i in own]}")
    if over is not None and own:
        studies = json.loads(core.write())["studies"]
        return next((i for i in own if studies[i].get("over") == over), own[0])
    return own[0] if own else None


def method(kind: Mapping[str, Any]) -> Callable[..., Results]:
    """Return the method of scenes for a kind of study."""
    arguments = _arguments(kind)

    def study_of_kind(
        self: Scene,
        /,
        *,
        study: str | None = None,
        for_each: Any = None,
        threads: int | None = None,
        progress: Progress | None = None,
        coefficients: bool = False,
        columns: Iterable[str] | None = None,
        **options: Any,
    ) -> Results:
        for name in options:
            if name not in arguments:
                raise TypeError(f"{kind['verb']}() has no argument {name!r}{nearest(name, arguments)}")
        for name, value in (("coefficients", coefficients or None), ("columns", columns)):
            if value is not None and not kind["takes_coefficients"]:
                raise TypeError(f"{kind['verb']}() has no argument {name!r}")
        keys = {arguments[name]["name"]: value for name, value in options.items()}
        if for_each is not None:
            keys["for_each"] = for_each
        core = self._data
        index = _template(core, kind["name"], study, keys.get("over"))
        text, _ = as_json(keys)
        core, index = core.with_study(kind["name"], index, text)
        return run(core, [index], coefficients, columns, threads, progress)

    study_of_kind.__name__ = kind["verb"]
    study_of_kind.__qualname__ = f"Scene.{kind['verb']}"
    study_of_kind.__doc__ = _docstring(kind)
    study_of_kind.__signature__ = _signature(kind)  # type: ignore[attr-defined]
    return study_of_kind


def add_methods(cls: type) -> None:
    """Add a method for each kind of study."""
    for kind in _core.kinds():
        setattr(cls, kind["verb"], method(kind))


def stubs(cls: type) -> str:
    """Return the text of a stub of a class with these methods."""
    lines = [
        "# Made from the keys of studies: python -P python/stubs > python/arcslip/methods.pyi",
        "from collections.abc import Callable, Iterable, Mapping, Sequence",
        "from typing import Any",
        "",
        "from numpy.typing import NDArray",
        "",
        "from .results import Results",
        "",
        f"class {cls.__name__}:",
        "    __slots__ = ()",
    ]
    for kind in _core.kinds():
        lines.append(f"    def {kind['verb']}(")
        lines.append("        self,")
        lines.append("        /,")
        lines.append("        *,")
        for each in list(_signature(kind).parameters.values())[1:]:
            lines.append(f"        {each.name}: {each.annotation} = {each.default!r},")
        lines.append("    ) -> Results: ...")
    return "\n".join(lines) + "\n"

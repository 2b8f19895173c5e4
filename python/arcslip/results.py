"""Results of studies."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, overload

from . import _core
from .files.json_text import as_document
from .motions import Motion, motion_of
from .names import Named, nearest
from .tables import Row, Table
from .views.frames import chosen, data_frame, data_set, joined_frame
from .views.markup import of_result, of_results
from .views.plotting import draw

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.axes import Axes


class Result(Named):
    """A branch, a motion, an optimum or another result.

    Columns of its main table, its tables and its further facts are items and attributes: ``branch["amplitude"]``,
    ``branch.amplitude``, ``branch.events``, ``optimum.design``.

    Attributes
    ----------
    noun : str
        What it is: "branch", "motion".
    study, kind : str
        Name and kind of its study.
    set : dict
        The values of parameters for which it was computed, of a study with several.
    set_units : dict
        Their units.
    status : str
        "complete"; "stopped": a correct part of it; "failed": no result.
    stop : dict
        Why it ended: `reason`, `value`, `limit`, `message`.
    doubt : str
        Why a complete result is less accurate than it seems; "" if there is no doubt.
    parent : Result or None
        The result that it continues, or that it leaves.
    facts : dict
        What it has besides.
    """

    def __init__(
        self,
        about: Mapping[str, Any],
        tables: dict[str, Table],
        labels: Mapping[str, str],
    ) -> None:
        self.noun: str = about["noun"]
        self.study: str = about["study"]
        self.kind: str = about["kind"]
        self.set: dict[str, float] = about["set"]
        self.status: str = about["status"]
        self.stop: dict[str, Any] = about["stop"]
        self.doubt: str = about["doubt"]
        self.parent: Result | None = None
        self._tables = tables
        self.facts: dict[str, Any] = about["facts"]
        self.set_units: dict[str, str] = about["set_units"]
        self._labels = labels
        self._list: str = about["list"]  # of the results of a file, in which it is
        #: The history at a row of a table, (table, row, steps); None where it was not kept.
        self._history: Callable[[int, int, int], Table | None] | None = None

    def __getstate__(self) -> dict[str, Any]:
        return self.__dict__ | {"_history": None}

    @property
    def tables(self) -> dict[str, Table]:
        """Its tables by name. The first is the main one."""
        return self._tables

    @property
    def units(self) -> dict[str, str]:
        """The units of columns of the main table, and of the parameters of `set`."""
        return {**self.set_units, **self.main.units}

    @property
    def labels(self) -> dict[str, str]:
        """The label of an axis for each column of the main table: "amplitude (m)", or as the scene has it."""
        return {name: _label(*self._words(name)) for name in self.main.columns}

    def _words(self, name: str) -> tuple[str, str]:
        """Return the words for a column of the main table, as the scene has them, and its unit."""
        return self._labels.get(name, name), self.units.get(name, "")

    @property
    def main(self) -> Table:
        """The main table: points, instants of a history, or designs."""
        return next(iter(self._tables.values()))

    def __getitem__(self, name: str) -> Any:
        if name in self._tables:
            return self._tables[name]
        if name in self.main.columns or name not in self.facts:
            return self.main[name]
        return self.facts[name]

    def _names(self) -> list[str]:
        return [*self._tables, *self.facts, *self.main.heads()]

    def __len__(self) -> int:
        """Return the number of rows of the main table."""
        return len(self.main)

    def motion(self, of: int | Row = 0, /, *, steps: int | None = None) -> Motion:
        """Return the motion over a period, with the forces and loops of the elements.

        Parameters
        ----------
        of : int or Row
            Of a branch or a mode a point, by its index, or an event, a row of `events`. Of a result of the kinds "point" and
            "time" the period, of several that were recorded. -1 is the last one.
        steps : int, optional
            Of a branch the number of instants, besides those at which contacts begin to slip or to stick; by default 1000.
            The study of other results has it.

        Returns
        -------
        Motion
            A table of instants, whose columns are arrays of shape ``(instants,)``: `time` in s, `displacement` in m and
            `velocity` in m/s of the response, and ``elements.damper.force`` in N and so on of elements. Its `loops` are the
            hysteresis loops.

        Raises
        ------
        ValueError
            If the result has no motions: of branches by shooting, of sweeps and optima, at an amplitude without bounds, and
            of results that were loaded or unpickled.
        IndexError
            If there is no such point, or no such period.

        Examples
        --------
        >>> branch, = arcslip.Scene("examples/duffing_jenkins/scene.json").frf(for_each={})
        >>> motion = branch.motion(branch.events["peak"][0])
        >>> displacement, force = motion.loops["damper"]
        >>> displacement.shape == force.shape == motion.time.shape
        True
        """
        return motion_of(self, of, steps)

    def to_dataframe(self, table: str | None = None) -> pandas.DataFrame:
        """Return a table as a data frame of pandas, as `Table.to_dataframe` does.

        Parameters
        ----------
        table : str, optional
            Its name, such as "events"; by default the main one.

        Raises
        ------
        ValueError
            If there is no such table.
        ImportError
            If pandas is not installed: the extra ``arcslip[pandas]`` has it.
        """
        return data_frame(chosen([self], table)[0])

    def to_xarray(self, table: str | None = None) -> xarray.Dataset:
        """Return a table as a data set of xarray over the dimension `point`, as `Results.to_xarray` does for several."""
        return data_set([self], table).isel(combination=0)

    def plot(self, ax: Axes | None = None, *, x: str | None = None, y: str | None = None) -> Axes:
        """Draw the result with matplotlib.

        A branch is drawn over its frequency or parameter, dashed where it is unstable, with its events marked; a motion over
        time; a search over the parameter that it varied.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; by default in a new figure.
        x, y : str, optional
            Columns of the main table for the axes: ``y="elements.damper.stick_percent"``.

        Returns
        -------
        matplotlib.axes.Axes

        Raises
        ------
        ValueError
            If the result has no rows, or if a column is not one of numbers.
        KeyError
            If there is no such column.
        ImportError
            If matplotlib is not installed: the extra ``arcslip[plot]`` has it.
        """
        return draw([self], ax, x, y)

    def __bool__(self) -> bool:
        return True

    def __repr__(self) -> str:
        tables = ", ".join(f"{len(table)} {name}" for name, table in self.tables.items())
        settings = ", ".join(f"{name} = {value:.6g}" for name, value in self.set.items())
        words = [f"{self.noun} of {self.study!r}" if self.study else self.noun, settings, tables, self.status]
        return f"<{', '.join(word for word in words if word)}>"

    def _repr_html_(self) -> str:
        return of_result(self)


class Results(Sequence[Result]):
    """The results of one study or of several, in order.

    Attributes
    ----------
    program : str
        The program and its version.
    scene_hash : str
        Of the scene and of all that it names.
    title, frequency_unit : str
        Of the scene.
    notes : list of str
        What the scene left open, such as a window that was proposed.
    reduction : dict
        How the matrices of the structure were reduced; empty where they were not.
    """

    def __init__(self, header: Mapping[str, Any], results: Sequence[Result], core: _core.Results | None = None) -> None:
        self.program: str = header["program"]
        self.scene_hash: str = header["scene_hash"]
        self.title: str = header["title"]
        self.frequency_unit: str = header["frequency_unit"]
        self.notes: list[str] = list(header.get("notes") or [])
        self.reduction: dict[str, Any] = header["reduction"]
        self._format: str = header["format"]
        self._all = tuple(results)
        self._core = core

    @overload
    def __getitem__(self, index: int) -> Result: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[Result, ...]: ...
    def __getitem__(self, index: int | slice) -> Result | tuple[Result, ...]:
        return self._all[index]

    def __len__(self) -> int:
        return len(self._all)

    def of(self, study: str) -> tuple[Result, ...]:
        """Return the results of the study with this name."""
        return tuple(result for result in self._all if result.study == study)

    def _of(self, study: str | None) -> tuple[Result, ...]:
        """Return the results of a study, or all of them."""
        studies = list(dict.fromkeys(result.study for result in self._all))
        if study is not None and study not in studies:
            raise ValueError(f"found study={study!r}, must be one of {studies}{nearest(study, studies)}")
        return self._all if study is None else self.of(study)

    def to_dataframe(self, table: str | None = None, *, study: str | None = None) -> pandas.DataFrame:
        """Return the rows of all results as one data frame of pandas.

        Parameters
        ----------
        table : str, optional
            The table of each result, such as "events"; by default the main one.
        study : str, optional
            The study whose results are taken; by default all, which must then be of one kind.

        Returns
        -------
        pandas.DataFrame
            Its index has the levels `combination`, the number of the result from 0, and `point`, the row of its table. The
            first columns are the parameters that `for_each` sets. Columns that a result does not have are missing there.
            ``attrs["units"]`` has the units.

        Raises
        ------
        ValueError
            If there is no such study or table, or if the results have different tables.
        ImportError
            If pandas is not installed: the extra ``arcslip[pandas]`` has it.

        Examples
        --------
        >>> scene = arcslip.Scene("examples/duffing_jenkins/scene.json")
        >>> responses = scene.frf(for_each={"damper.normal_load": [0.8, 1.0]})
        >>> events = responses.to_dataframe("events")
        >>> events[events.kind == "peak"].groupby("damper.normal_load").amplitude.max().index.tolist()
        [0.8, 1.0]
        """
        return joined_frame(self._of(study), table)

    def to_xarray(self, table: str | None = None, *, study: str | None = None) -> xarray.Dataset:
        """Return the tables of all results as a data set of xarray.

        Parameters
        ----------
        table : str, optional
            The table of each result, such as "events"; by default the main one.
        study : str, optional
            The study whose results are taken; by default all, which must then be of one kind.

        Returns
        -------
        xarray.Dataset
            Each column is a variable over the dimensions `combination`, the results in order, of which a combination may have
            several, and `point`, the rows of their tables, of which shorter ones are filled up with NaN, texts with "". Lists
            of numbers have further dimensions.
            The parameters that `for_each` sets are coordinates of `combination`. Units are in the ``attrs`` of each.

        Raises
        ------
        ValueError
            If there is no such study or table, or if the results have different tables.
        ImportError
            If xarray is not installed: the extra ``arcslip[ensemble]`` has it.

        Examples
        --------
        >>> scene = arcslip.Scene("examples/duffing_jenkins/scene.json")
        >>> data = scene.frf(for_each={"damper.normal_load": [0.8, 1.0]}).to_xarray()
        >>> data.amplitude.max("point").swap_dims(combination="damper.normal_load").dims
        ('damper.normal_load',)
        >>> data.amplitude.attrs["units"]
        'm'
        """
        return data_set(self._of(study), table)

    def plot(
        self, ax: Axes | None = None, *, x: str | None = None, y: str | None = None, study: str | None = None
    ) -> Axes:
        """Draw all results with matplotlib in one figure, as `Result.plot` does for one.

        Results with the same values of `for_each` have the same colour.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; by default in a new figure.
        x, y : str, optional
            Columns of the main tables for the axes.
        study : str, optional
            The study whose results are drawn; by default all, which must then be of one kind.

        Returns
        -------
        matplotlib.axes.Axes

        Raises
        ------
        ValueError
            If no result has rows, if the results are of several kinds, or if a column is not one of numbers.
        KeyError
            If there is no such column.
        ImportError
            If matplotlib is not installed: the extra ``arcslip[plot]`` has it.
        """
        return draw(self._of(study), ax, x, y)

    def to_json(self) -> str:
        """Return the text of the JSON file that the command writes.

        Of results that were loaded or unpickled, missing values are null, and what their file did not tell is left out.
        """
        return as_document(self) if self._core is None else self._core.json()

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write `to_json` to a file, which `load` reads."""
        text = self.to_json()
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)

    def __reduce__(self) -> Any:
        header = {key: getattr(self, key) for key in HEADER} | {"format": self._format}
        return Results, (header, self._all)

    def __repr__(self) -> str:
        lines = [repr(result) for result in self._all[:20]]
        if len(self._all) > 20:
            lines.append(f"... {len(self._all) - 20} more")
        return "\n".join([f"<results of {self.title!r}: {len(self._all)}>", *lines])

    def _repr_html_(self) -> str:
        return of_results(self)


HEADER = ("program", "scene_hash", "title", "frequency_unit", "notes", "reduction")


def _label(words: str, unit: str) -> str:
    return f"{words} ({unit})" if unit not in ("", "-") else words


def link(results: Sequence[Result], lists: Sequence[str], parents: Sequence[int]) -> None:
    """Set the parents of results, which are counted backwards in their list."""
    seen: dict[str, list[Result]] = {}
    for result, list_, parent in zip(results, lists, parents, strict=True):
        own = seen.setdefault(list_, [])
        if parent > 0:
            result.parent = own[-parent]
        own.append(result)

"""Scenes."""

from __future__ import annotations

import json
import operator
import os
from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from pathlib import Path
from typing import Any, NamedTuple

from . import _core
from .ensembles.ensemble import Ensemble, ensemble
from .files.arrays import as_json, with_contents
from .files.mat_program import provide
from .methods import StudyMethods
from .parameters import Parameters
from .progress import Progress
from .results import Results
from .studies import run
from .views.markup import of_scene


class Study(NamedTuple):
    """A study of a scene: its name and its kind."""

    name: str
    kind: str


class Scene(StudyMethods):
    """A structure with its elements, forces and studies. Scenes are values: they do not change, and are equal by content.

    Each kind of study is a method: `frf`, `trace`, `peaks` and so on.

    Parameters
    ----------
    source : path, str or dict
        The path of a scene file; its text, which begins with "{"; or what it holds as a dict. In a dict, NumPy arrays and
        sparse matrices of SciPy stand in place of the files of `matrices` and of the `shape` of a force, a dict from name
        to row, counted from 0, in place of the file of `names`, pairs of such rows, shape (pairs, 2), of that of `faces`, and
        columns, as a dict, a data frame or a structured array, of the `file` of a patch. Other arrays are lists. MATLAB files
        are read by SciPy and h5py: the extra ``arcslip[mat]`` has them.
    folder : path, optional
        What paths in a text or a dict are relative to; by default the current directory.

    Raises
    ------
    SceneError
        With all faults of the scene.
    OSError
        If the file cannot be read.
    """

    __slots__ = ("_data", "_hash", "_parameters")

    _data: _core.Scene
    _hash: str | None
    _parameters: Parameters | None

    def __init__(
        self, source: str | os.PathLike[str] | Mapping[str, Any], *, folder: str | os.PathLike[str] = ""
    ) -> None:
        if isinstance(source, Mapping):
            text, files = as_json(source)
            self._set(_read(text, folder, files))
        elif isinstance(source, str) and source.lstrip().startswith("{"):
            self._set(_read(source, folder, {}))
        elif isinstance(source, (str, os.PathLike)):
            if b".mat" in Path(source).read_bytes():
                provide()
            self._set(_core.Scene.read_file(str(Path(source))))
        else:
            raise TypeError(f"found a scene of type {type(source).__name__}, must be a path, a text or a dict")

    def _set(self, core: _core.Scene) -> None:
        object.__setattr__(self, "_data", core)
        object.__setattr__(self, "_hash", None)
        object.__setattr__(self, "_parameters", None)

    @classmethod
    def _of(cls, core: _core.Scene) -> Scene:
        scene = cls.__new__(cls)
        scene._set(core)
        return scene

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"a scene does not change: {name!r} cannot be set; use replace()")

    def __delattr__(self, name: str) -> None:
        raise AttributeError(f"a scene does not change: {name!r} cannot be deleted")

    @property
    def title(self) -> str:
        """Its title."""
        return self._data.title

    @property
    def frequency_unit(self) -> str:
        """The unit of all its frequencies, "Hz" or "rad/s"."""
        return self._data.frequency_unit

    @property
    def dofs(self) -> tuple[str, ...]:
        """The names of its degrees of freedom."""
        return tuple(self._data.dofs)

    @property
    def studies(self) -> tuple[Study, ...]:
        """Its studies."""
        return tuple(Study(*study) for study in self._data.studies())

    @property
    def parameters(self) -> Parameters:
        """Its parameters, a mapping from name to value, which has a unit, bounds and a help."""
        found = self._parameters or Parameters(self._data)
        object.__setattr__(self, "_parameters", found)
        return found

    def replace(
        self,
        values: Mapping[str, float | str] | None = None,
        /,
        *,
        harmonics: int | None = None,
        accuracy: float | None = None,
    ) -> Scene:
        """Return the scene with other values of parameters, or other harmonics.

        Parameters
        ----------
        values : mapping, optional
            Values by the names of parameters: a number, a text with a unit, "0.2 mm", or a
            formula of other parameters, "0.12*k".
        harmonics : int, optional
            The highest harmonic; with an accuracy the highest that may be chosen.
        accuracy : float, optional
            Of amplitudes, relative to the largest one, by which the harmonics are chosen.

        Raises
        ------
        ParameterError
            For an unknown parameter, one that is given by a formula and a number for it, a value
            outside its bounds, or a formula that is wrong.
        """
        pairs = [(name, value if isinstance(value, str) else _number(name, value)) for name, value in (values or {}).items()]
        order = None if harmonics is None else operator.index(harmonics)
        return Scene._of(self._data.replace(pairs, order, accuracy))

    def run(
        self,
        *names: str,
        coefficients: bool = False,
        threads: int | None = None,
        progress: Progress | None = None,
    ) -> Results:
        """Run the studies of the scene with these names, by default all.

        Parameters
        ----------
        *names : str
        coefficients : bool
            Whether results have the Fourier coefficients of the response.
        threads : int, optional
            Threads to use; by default as many as there are processors.
        progress : bool or callable, optional
            True for a bar, of tqdm where it is installed; or a callable, called with the progress, a dict, some ten times a
            second, which ends the computation by returning False.

        Returns
        -------
        Results
        """
        own = [study.name for study in self.studies]
        for name in names:
            if name not in own:
                raise ValueError(f"found the study {name!r}, must be one of {own}")
        which = [own.index(name) for name in names] if names else range(len(own))
        return run(self._data, which, coefficients, None, threads, progress)

    def ensemble(
        self,
        samples: Any = None,
        *,
        study: str | None = None,
        keep: Sequence[str] = (),
        executor: Executor | None = None,
        threads: int | None = None,
        path: str | os.PathLike[str] | None = None,
        progress: Progress | None = None,
    ) -> Ensemble:
        """Compute a study for many samples of parameters, each a row of a table.

        Rows go to a file as they are computed, so that memory does not grow with their number. With a `path` the same call
        continues an ensemble that was stopped, as the command ``arcslip ensemble`` does, whose file is the same.

        Parameters
        ----------
        samples : mapping, data frame, structured array or path, optional
            Values of parameters by name, one for each sample, also of a file, Parquet or CSV; or distributions, as `for_each`
            of a scene has them: ``{"distributions": {"damper.normal_load": {"normal": [30, 3]}}, "count": 2000}``. By default
            those of the study.
        study : str, optional
            The study; by default the first one, or without `samples` the first one that has some.
        keep : sequence of str, optional
            What is kept of each sample: quantities, such as "peak.amplitude" or "damper.stick_percent", and tables, "events"
            and "points". By default the numbers that the command shows.
        executor : concurrent.futures.Executor, optional
            What computes chunks of samples: processes, `dask.distributed` (`client.get_executor()`), MPI
            (`mpi4py.futures.MPIPoolExecutor`). By default threads of this process.
        threads : int, optional
            Threads to use without an executor; by default as many as there are processors.
        path : path, optional
            The file; by default a temporary one, which goes away with the result.
        progress : bool or callable, optional
            True for a bar; or a callable, which ends the computation by returning False: then the rows so far are returned.

        Returns
        -------
        Ensemble

        Raises
        ------
        ValueError
            For a quantity that there is not, with the nearest one, and for a file of other samples.
        """
        return ensemble(self, samples, study, keep, executor, threads, path, progress)

    def to_json(self, *, folder: str | os.PathLike[str] | None = None) -> str:
        """Return the text of a scene file, with every default.

        Parameters
        ----------
        folder : path, optional
            Where the file is to be: paths in the text are relative to it, and the arrays that stand in place of files are
            written there, into ``arrays/``. By default paths are those of the scene, and arrays are named but not written.

        Raises
        ------
        FileExistsError
            If another file has the name of one of the arrays.
        OSError
            If a file cannot be written.
        """
        if folder is None:
            return self._data.write()
        arrays, after = self._in_memory(), Path(folder)
        for path, text in arrays.items():
            if (after / path).exists() and (after / path).read_bytes() != text:
                raise FileExistsError(f"{after / path} is another file, which is left as it is")
        for path, text in arrays.items():
            (after / path).parent.mkdir(parents=True, exist_ok=True)
            (after / path).write_bytes(text)
        return self._data.write_in(os.fspath(folder), list(arrays))

    def to_dict(self) -> dict[str, Any]:
        """Return what a scene file holds, with every default, and what stands in place of files, as `Scene` takes it."""
        found: dict[str, Any] = with_contents(json.loads(self._data.write()), self._in_memory())
        return found

    def _in_memory(self) -> dict[str, bytes]:
        """Return what stands in place of files, by their paths."""
        folder = Path(self._data.folder)

        def is_of_disk(path: str, text: bytes) -> bool:
            return (folder / path).is_file() and (folder / path).read_bytes() == text

        return {path: text for path, text in self._data.files().items() if not is_of_disk(path, text)}

    def _content(self) -> str:
        found = self._hash or self._data.hash()
        object.__setattr__(self, "_hash", found)
        return found

    def __eq__(self, other: object) -> bool:
        return self._content() == other._content() if isinstance(other, Scene) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._content())

    def __reduce__(self) -> Any:
        return _restored, (self._data.write(), self._data.folder, self._data.files())

    def __repr__(self) -> str:
        studies = ", ".join(f"{name} ({kind})" if name != kind else name for name, kind in self.studies[:8])
        more = f" and {len(self.studies) - 8} more" if len(self.studies) > 8 else ""
        count = len(self._data.dofs)
        return (
            f"<scene {self.title!r}: {count} degree{'s' * (count != 1)} of freedom,"
            f" {len(self.parameters)} parameters; studies: {studies or 'none'}{more}>"
        )

    def _repr_html_(self) -> str:
        return of_scene(self)


def _number(name: str, value: Any) -> float:
    try:
        return float(value)
    except (TypeError, ValueError):
        raise TypeError(f"found {value!r} for {name!r}, must be a number or a text") from None


def _restored(text: str, folder: str, files: dict[str, bytes]) -> Scene:
    return Scene._of(_read(text, folder, files))


def _read(text: str, folder: str | os.PathLike[str], files: dict[str, bytes]) -> _core.Scene:
    text.encode()  # lone surrogates raise UnicodeEncodeError
    if ".mat" in text:
        provide()
    return _core.Scene.read(text, os.fspath(folder), files)


def schema() -> dict[str, Any]:
    """Return the format of scenes as a JSON Schema."""
    found: dict[str, Any] = json.loads(_core.schema())
    return found

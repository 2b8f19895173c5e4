"""Continuation and bifurcation of nonlinear vibration.

A scene is a structure with its forces and studies, as in a scene file; a study of it gives results, whose columns are
NumPy arrays:

>>> import arcslip
>>> scene = arcslip.Scene("examples/duffing_jenkins/scene.json")
>>> branch, = scene.frf()
>>> branch.units["amplitude"]
'm'
>>> bool(branch.events["peak"].amplitude.max() >= branch.amplitude.max())
True

Public are the names of ``__all__``, and their attributes that do not begin with an underscore.
"""

from ._core import __version__
from .config import show_config
from .ensembles.ensemble import Ensemble
from .ensembles.sobol import SobolIndices, saltelli
from .errors import ArcslipWarning, Fault, ParameterError, SceneError
from .files.loading import load
from .motions import Loop, Motion
from .optimum import Optimum
from .parameters import Parameter, Parameters
from .quantities import Facts, Quantity
from .results import Result, Results
from .scene import Scene, schema
from .tables import Row, Table

__all__ = [
    "ArcslipWarning",
    "Ensemble",
    "Facts",
    "Fault",
    "Loop",
    "Motion",
    "Optimum",
    "Parameter",
    "ParameterError",
    "Parameters",
    "Quantity",
    "Result",
    "Results",
    "Row",
    "Scene",
    "SceneError",
    "SobolIndices",
    "Table",
    "__version__",
    "load",
    "saltelli",
    "schema",
    "show_config",
]

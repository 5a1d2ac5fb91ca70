"""Real contact area, lubricant and friction of scanned rough surfaces.

Values are SI numbers, texts with a unit ("7 MPa") or quantities of pint; maps are arrays of shape
(ny, nx), row 0 on top, NaN where a height is missing. What is wrong with an argument is a ValueError.
"""

import os as _os

# Threads that wait between two loops sleep; spinning ones slow down whatever runs beside them. The
# OpenMP library reads this when it is loaded.
_os.environ.setdefault("OMP_WAIT_POLICY", "passive")

from . import ehl
from ._cite import cite
from ._combine import Combination, Volume, combine
from ._contact import Contact, Material, Materials, NotConverged, Solid, contact, materials
from ._density_curve import DensityCurve, Plateau, density_curve
from ._doubts import Doubt
from ._errors import InputError, InputFileNotFound, InputIncomplete, OutputError
from ._friction import Film, FluidFilm, Friction, Lubricant, fluid_film, friction, rain
from ._friction_table import FrictionEntry, FrictionTable
from ._generate import Format, formats, generate
from ._guesses import NameNotFound
from ._guesses import missing_name as _missing_name
from ._load import load
from ._parameter_table import parameters
from ._parameters import Parameter, Parameters
from ._progress import Progress, set_threads
from ._read import read
from ._records import Warning
from ._report import Report, report
from ._save import save
from ._scans import Scans
from ._section import Section
from ._slide import Slide, slide
from ._spectra import MeanSpectra, MeanSpectrum, Spectra, Spectrum, mean_spectra
from ._study import Results, Study
from ._surface import Surface
from ._tabor import version as __version__
from ._values import Value
from ._versions import show_versions
from .view import view

# Warning is not among them: it would take the place of Python's own.
__all__ = ["Combination", "Contact", "DensityCurve", "Doubt", "Film", "FluidFilm", "Format", "Friction",
           "FrictionEntry", "FrictionTable", "InputError", "InputFileNotFound", "InputIncomplete", "Lubricant", "Material", "Materials", "MeanSpectra", "MeanSpectrum", "NameNotFound", "NotConverged", "OutputError", "Parameter",
           "Parameters", "Plateau", "Progress", "Report", "Results", "Scans", "Section", "Slide", "Solid", "Spectra",
           "Spectrum", "Study", "Surface", "Value", "Volume", "cite", "combine", "contact",
           "density_curve", "ehl", "fluid_film", "formats", "friction", "generate", "load", "materials", "mean_spectra", "parameters", "rain",
           "read", "report", "save", "set_threads", "show_versions", "slide", "view"]

# Pickles and messages name classes where users find them.
for _name in (*__all__, "Warning"):
    if isinstance(globals()[_name], type):
        globals()[_name].__module__ = "tabor"
del _name


def __getattr__(name: str) -> object:
    if name.startswith("_"):
        raise AttributeError(f"module 'tabor' has no attribute {name!r}", name=name)
    raise _missing_name("tabor", name, __all__)


def __dir__() -> list[str]:
    return [*__all__, "Warning", "__version__"]

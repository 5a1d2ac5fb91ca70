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
from ._contact import Contact, Material, NotConverged, Solid, contact, materials
from ._friction import (DensityCurve, Film, FluidFilm, Friction, Lubricant, Plateau, density_curve, fluid_film,
                        friction, rain)
from ._friction_table import FrictionEntry, FrictionTable
from ._generate import Format, formats, generate
from ._progress import Progress, set_threads
from ._records import Warning
from ._report import Report, report
from ._save import save
from ._scans import Scans
from ._slide import Slide, slide
from ._study import Results, Study
from ._surface import Parameter, Parameters, Spectra, Spectrum, Surface, read
from ._tabor import version as __version__
from .view import view

__all__ = ["Combination", "Contact", "DensityCurve", "Film", "FluidFilm", "Format", "Friction",
           "FrictionEntry", "FrictionTable", "Lubricant", "Material", "NotConverged", "Parameter",
           "Parameters", "Plateau", "Progress", "Report", "Results", "Scans", "Slide", "Solid", "Spectra",
           "Spectrum", "Study", "Surface", "Volume", "Warning", "cite", "combine", "contact",
           "density_curve", "ehl", "fluid_film", "formats", "friction", "generate", "materials", "rain",
           "read", "report", "save", "set_threads", "slide", "view"]

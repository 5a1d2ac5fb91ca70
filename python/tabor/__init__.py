"""Real contact area, lubricant and friction of scanned rough surfaces.

Values are SI numbers, texts with a unit ("7 MPa") or quantities of pint; maps are arrays of shape
(ny, nx), row 0 on top, NaN where a height is missing. What is wrong with an argument is a ValueError.
"""

from ._contact import Contact, Material, NotConverged, Solid, contact, materials
from ._friction import Film, FluidFilm, Friction, Lubricant, fluid_film, friction, rain
from ._progress import Progress
from ._records import Warning
from ._surface import Parameter, Parameters, Spectra, Spectrum, Surface, read
from ._tabor import set_threads
from ._tabor import version as __version__

__all__ = ["Contact", "Film", "FluidFilm", "Friction", "Lubricant", "Material", "NotConverged", "Parameter",
           "Parameters", "Progress", "Solid", "Spectra", "Spectrum", "Surface", "Warning", "contact",
           "fluid_film", "friction", "materials", "rain", "read", "set_threads"]

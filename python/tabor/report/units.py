"""SI numbers as a person writes them."""

import math
import re

from tabor.report.errors import InputError

_PREFIXES = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""))
_SMALL_PREFIXES = ((1e-3, "m"), (1e-6, "µ"), (1e-9, "n"))
_WHOLE_UNITS = ("", "1", "SI", "%", "°", "kg", "kg/m", "K", "Pa s")  # shown without a prefix
_METRES = ((1.0, "m"), (1e-3, "mm"), (1e-6, "µm"), (1e-9, "nm"))
_POWERS = {
    "m": (1, "{0}"), "m²": (2, "{0}²"), "m³": (3, "{0}³"), "m⁴": (4, "{0}⁴"), "1/m": (-1, "1/{0}"), "rad/m": (-1, "rad/{0}"), "1/m²": (-2, "1/{0}²"),
    "m³/m²": (1, "{0}³/{0}²"),
}  # fmt: skip
_USUAL = {"1/Pa": (1e9, "1/GPa"), "kg/m²": (1e3, "g/m²"), "Pa/m": (1e-12, "MPa/µm")}  # where one multiple suits all numbers
_PRESSURES = {"pa": 1.0, "kpa": 1e3, "mpa": 1e6, "gpa": 1e9}


def number(value, digits=4):
    """Rounded to significant digits, without a trailing zero or an exponent where none is needed."""
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return "\N{EN DASH}"
    if isinstance(value, (bool, str)):
        return str(value)
    if isinstance(value, int):
        return f"{value:,}".replace(",", "\N{NARROW NO-BREAK SPACE}").replace("-", "\N{MINUS SIGN}")
    shown = f"{value:.{digits}g}"
    if "e" in shown:
        mantissa, exponent = shown.split("e")
        mantissa = mantissa.replace("-", "\N{MINUS SIGN}")
        return f"{mantissa}\N{MULTIPLICATION SIGN}10{_superscript(int(exponent))}"
    return shown.replace("-", "\N{MINUS SIGN}")


def pressure(value):
    """7e6 -> '7 MPa'"""
    if value is None or math.isnan(value):
        return "\N{EN DASH}"
    scale, prefix = next((pair for pair in _PREFIXES if abs(value) >= pair[0]), (1.0, ""))
    return f"{number(value / scale)} {prefix}Pa"


def length_scale(largest):
    """(factor from metres, unit) in which `largest` [m] reads well."""
    for metres, unit in ((1e-3, "mm"), (1e-6, "µm"), (1e-9, "nm")):
        if largest >= metres * 0.9995:
            return 1 / metres, unit
    return 1e9, "nm"


def length(value):
    if value is None or math.isnan(value):
        return "\N{EN DASH}"
    factor, unit = length_scale(abs(value)) if abs(value) < 1 else (1.0, "m")
    return f"{number(value * factor)} {unit}"


def signs(unit):
    """The unit as it is printed: 'm^2' -> 'm²'; "" for a number without one."""
    unit = re.sub(r"\^([23])", lambda power: {"2": "²", "3": "³"}[power[1]], unit)
    return "" if unit == "1" else unit.replace("deg", "°")


def scale(largest, unit):
    """(factor from SI, unit with its prefix) in which `largest` [unit] reads well."""
    largest = abs(largest)
    if unit in _USUAL:
        return _USUAL[unit]
    if unit in _WHOLE_UNITS or not 0 < largest < math.inf:
        return 1.0, unit
    if unit in _POWERS:
        return _power_scale(largest, *_POWERS[unit])
    if "²" in unit or "³" in unit:
        return 1.0, unit
    pairs = (*_PREFIXES, *_SMALL_PREFIXES)
    if unit.startswith("m"):
        pairs = pairs[3:]  # nobody reads kilometres here
    size, prefix = next((pair for pair in pairs if largest >= pair[0] * 0.9995), pairs[-1])
    return 1 / size, prefix + unit


def _power_scale(largest, power, shown):
    """A length or area is at least one in the largest unit that allows it, a volume a thousandth, a density one in the smallest."""
    ordered = _METRES if power > 0 else _METRES[::-1]
    least = 0.9995e-3 if power == 3 else 0.9995
    size, prefixed = next((pair for pair in ordered if largest >= least * pair[0] ** power), ordered[-1])
    return size**-power, shown.format(prefixed)


def si(value, unit):
    """(5e-5, 's') -> '50 µs'"""
    if value is None or math.isnan(value):
        return "\N{EN DASH}"
    factor, shown = scale(value, unit)
    return f"{number(value * factor)} {shown}".rstrip()


def span(values, show):
    """'2 MPa to 15 MPa', or '2 MPa' where all are alike."""
    low, high = show(min(values)), show(max(values))
    return low if low == high else f"{low} to {high}"


def nth(place):
    """2 -> '2nd'"""
    endings = {1: "st", 2: "nd", 3: "rd"}
    return f"{place}{endings.get(place % 10, 'th') if place % 100 not in (11, 12, 13) else 'th'}"


def density(value):
    return f"{number(value)} g/m²"


def parse_pressure(text):
    """'7 MPa' -> 7e6; raises InputError naming the corrected form."""
    match = re.fullmatch(r"\s*([0-9.eE+-]+)\s*([a-zA-Z]*)\s*", text)
    unit = match.group(2).lower() if match else None
    if not match or unit not in _PRESSURES:
        raise InputError(f"--pressure {text}: expected a number with its unit, such as 7MPa")
    return _float(match.group(1), text) * _PRESSURES[unit]


def parse_density(text):
    match = re.fullmatch(r"\s*([0-9.eE+-]+)\s*g/m(\^2|2|²)\s*", text)
    if not match:
        raise InputError(f"--density {text}: expected a number with its unit, such as 0.45g/m^2")
    return _float(match.group(1), text)


def _float(digits, text):
    try:
        return float(digits)
    except ValueError:
        raise InputError(f"{text}: {digits} is not a number") from None


def _superscript(exponent):
    return str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))

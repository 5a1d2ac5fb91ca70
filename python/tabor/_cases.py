"""Cases of studies and friction tables as arrays over what was varied."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ._optional import needs

#: Columns of a study that its cases differ in, beside the scan.
_AXES = ("mean_pressure_Pa", "lubricant_density_g_per_m2", "sliding_speed_m_per_s")

Row = Mapping[str, Any]


def _scan_labels(rows: Sequence[Row], axes: Sequence[str]) -> list[tuple[Any, ...]]:
    """Group, scan and number of each row's scan: one that stands twice in a group under the same conditions counts anew."""
    seen: set[tuple[Any, ...]] = set()
    labels = []
    for row in rows:
        place = (row["group"], row["scan"], *(row[axis] for axis in axes))
        number = next(i for i in range(len(rows)) if (i, *place) not in seen)
        seen.add((number, *place))
        labels.append((row["group"], row["scan"], number))
    return labels


def _array(values: Sequence[Any], places: Any, shape: tuple[int, ...]) -> Any:
    """One column in the shape of the axes: texts, switches as 0 and 1, numbers; NaN or "" where there is no case."""
    is_full = len(values) == np.prod(shape)
    if any(isinstance(one, str) for one in values):
        found: Any = np.full(shape, "", dtype=object)
        values = [one if isinstance(one, str) else "" for one in values]
    elif is_full and all(isinstance(one, bool) for one in values):
        found = np.zeros(shape, dtype=np.int8)
    else:
        found = np.full(shape, np.nan)
    found[places] = values
    return found.astype(str) if found.dtype == object else found


def _dataset(rows: Sequence[Row], axes: Sequence[str], first: Mapping[str, Any], units: Mapping[str, str]) -> Any:
    """Columns over ``first``, a coordinate with the place of each row, and the axes, each with its values in order."""
    xarray = needs("xarray", "to_xarray()")
    values = {axis: sorted({row[axis] for row in rows}) for axis in axes}
    dims = (*(name for name in first), *axes)
    shape = (*(len(labels) for labels, _ in first.values()), *(len(many) for many in values.values()))
    places = (*(np.array(at) for _, at in first.values()), *(np.searchsorted(values[axis], [row[axis] for row in rows]) for axis in axes))

    def attributes(key: str) -> dict[str, str]:
        return {"units": units[key]} if units.get(key) else {}

    keys = [key for key in rows[0] if key not in dims]
    columns = {key: (dims, _array([row[key] for row in rows], places, shape), attributes(key)) for key in keys}
    coords = {**{name: (name, labels) for name, (labels, _) in first.items()},
              **{axis: (axis, np.array(many, dtype=float), attributes(axis)) for axis, many in values.items()}}
    return xarray.Dataset(columns, coords)


def study_to_xarray(rows: Sequence[Row], units: Mapping[str, str]) -> Any:
    """Cases of a study over scans, pressures, densities and speeds, ``group`` along the scans."""
    axes = [axis for axis in _AXES if axis in rows[0] and all(isinstance(row[axis], float) for row in rows)]
    labels = _scan_labels(rows, axes)
    scans = list(dict.fromkeys(labels))
    names = [scan for _, scan, _ in scans]
    shown = [scan if names.count(scan) == 1 else f"{scan} ({group}{', again' * number})" for group, scan, number in scans]
    plain = [{key: value for key, value in row.items() if key != "group"} for row in rows]
    found = _dataset(plain, axes, {"scan": (shown, [scans.index(one) for one in labels])}, units)
    return found.assign_coords(group=("scan", [group for group, _, _ in scans]))


def table_to_xarray(entries: Sequence[Any]) -> Any:
    """Entries of a friction table over pressure, density and, where friction depends on it, speed."""
    rows = [one._asdict() for one in entries]
    axes = ["mean_pressure", "lubricant_density"] + (["sliding_speed"] if rows[0]["sliding_speed"] is not None else [])
    plain = [{key: value for key, value in row.items() if value is not None} for row in rows]
    units = {"mean_pressure": "Pa", "lubricant_density": "kg/m^2", "sliding_speed": "m/s"}
    return _dataset(plain, axes, {}, units)

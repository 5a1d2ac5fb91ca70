"""A table of named columns of equal length."""

import numpy as np


class Table(dict):
    """{column name: 1-D array}. An empty table is false."""

    def __len__(self):
        return len(next(iter(self.values()))) if self.keys() else 0

    def __bool__(self):
        return len(self) > 0

    def where(self, mask):
        return Table({name: column[mask] for name, column in self.items()})

    def rows(self):
        names = list(self.keys())
        return [dict(zip(names, values)) for values in zip(*self.values())]

    def distinct(self, name):
        """Sorted distinct finite values of a numeric column."""
        values = np.asarray(self.get(name, []), dtype=float)
        return [float(value) for value in np.unique(values[np.isfinite(values)])]

    def equal(self, name, value):
        """Mask of the rows that carry `value`; numbers compare to 1e-9, as they were printed and read."""
        column = self[name]
        if isinstance(value, str):
            return np.array([item == value for item in column], dtype=bool)
        return np.isclose(np.asarray(column, dtype=float), value, rtol=1e-9, atol=0)

    def not_converged(self):
        return int(np.sum(~converged(self))) if self else 0


def converged(table):
    """Boolean mask; a table without that column has nothing to doubt."""
    column = table.get("converged")
    if column is None:
        return np.ones(len(table), dtype=bool)
    if column.dtype == object:
        return np.array([item.strip().lower() in ("1", "true", "yes") for item in column], dtype=bool)
    return column.astype(bool)

"""Rows of numbers on their way to arrays."""

import array

import numpy as np

from frontseat_driver.plots.mission import Series


class Columns:
    """Times, each with the same count of values."""

    def __init__(self):
        self._flat = array.array("d")
        self._width = 1

    def add(self, *row):
        self._flat.extend(row)
        self._width = len(row)

    def series(self, offset_s=0.0):
        if not self._flat:
            return Series()
        table = np.frombuffer(self._flat, dtype=float).reshape(-1, self._width)
        return Series(table[:, 0] + offset_s, *table[:, 1:].T.copy())

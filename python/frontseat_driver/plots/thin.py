"""Fewer points, the same picture: what is drawn of a long recording."""

import numpy as np


def kept(values, bins):
    """Indices, in order, that keep every extreme: first, last, least and greatest of each of
    `bins` equal stretches of each array in `values`; everything when that is less."""
    count = len(values[0])
    if count <= (2 + 2 * len(values)) * bins:
        return np.arange(count)
    edges = np.linspace(0, count, bins + 1).astype(int)
    picked = [edges[:-1], edges[1:] - 1]
    for value in values:
        low = np.where(np.isfinite(value), value, np.inf)
        high = np.where(np.isfinite(value), value, -np.inf)
        pairs = list(zip(edges[:-1], edges[1:]))
        picked.append([start + int(np.argmin(low[start:end])) for start, end in pairs])
        picked.append([start + int(np.argmax(high[start:end])) for start, end in pairs])
    return np.unique(np.concatenate(picked))


def broken_at(x, y, breaks):
    """Both arrays with a NaN before every index in `breaks`, where a line must not be drawn."""
    return np.insert(x, breaks, x[breaks]), np.insert(y, breaks, np.nan)


def breaks_of_heading(heading_deg):
    """Where a heading went through north: the line would cross the whole axis."""
    return np.flatnonzero(np.abs(np.diff(heading_deg)) > 180.0) + 1


def breaks_of_time(t, longest_s):
    """After a hole in the data; a line over it would tell what nobody measured."""
    return np.flatnonzero(np.diff(t) > longest_s) + 1

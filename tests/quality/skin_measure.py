"""How still strokes lie on skin, measured between neighbouring frames of a shot. Needs numpy.

Every pixel that two frames show, by the motion vectors, is compared with the place on the frame
before where its rest position was. A ratio is the strokes' change over their own deviation
(unrelated strokes have the root of 2); a slide is how far, in pixels, they moved on the skin.
"""

import numpy as np

from exr_planes import read_planes

CHANNELS = ("IndexOB.V", "Vector.X", "Vector.Y", "Rest.R", "Rest.G", "Rest.B", "Position.Y")
WINDOW = 4          # pixels each way over which a slide is found
LEAST_SLOPE = 0.1   # of the median: windows with less structure across them say nothing
FEWEST = 50


class Frame:
    def __init__(self, aovs, picture):
        planes = list(read_planes(aovs, ["data." + name for name in CHANNELS]).values())
        self.ids, self.motion, self.side = planes[0], planes[1:3], planes[6]
        self.rest = np.stack(planes[3:6])
        self.strokes = read_planes(picture, ["R"])["R"]


def sample(plane, x, y):
    """Catmull-Rom over 4 x 4 pixels at lists of places."""
    left, top = np.floor(x).astype(int), np.floor(y).astype(int)

    def weights(f):
        return (-.5 * f + f ** 2 - .5 * f ** 3, 1 - 2.5 * f ** 2 + 1.5 * f ** 3,
                .5 * f + 2 * f ** 2 - 1.5 * f ** 3, -.5 * f ** 2 + .5 * f ** 3)
    across, down = weights(x - left), weights(y - top)
    width, flat = plane.shape[1], plane.ravel()
    first = (top - 1) * width + left - 1
    return sum(across[i] * down[j] * flat[first + j * width + i]
               for j in range(4) for i in range(4))


def everywhere(where, reach):
    """Where all pixels up to `reach` away hold, too; not at the border."""
    result = np.zeros_like(where)
    inner = slice(reach, -reach)
    result[inner, inner] = True
    height, width = where.shape
    for j in range(2 * reach + 1):
        for i in range(2 * reach + 1):
            result[inner, inner] &= where[j:height - 2 * reach + j, i:width - 2 * reach + i]
    return result


def compared(now, before):
    """(rows, columns) of pixels whose skin both frames show, and the (x, y) where it was."""
    height, width = now.ids.shape
    alike = np.zeros_like(now.ids, bool)
    for number in np.unique(now.ids[now.ids > 0]):
        alike |= everywhere(now.ids == number, 1)
    rows, columns = np.nonzero(alike)
    x, y = columns + now.motion[0][rows, columns], rows - now.motion[1][rows, columns]
    inside = (x > 2) & (y > 2) & (x < width - 3) & (y < height - 3)
    rows, columns, x, y = (values[inside] for values in (rows, columns, x, y))
    ids, column, row = now.ids[rows, columns], np.rint(x).astype(int), np.rint(y).astype(int)
    seen = np.ones(len(rows), bool)
    for j in range(-2, 3):
        for i in range(-2, 3):
            seen &= before.ids[row + j, column + i] == ids
    moved = np.stack([sample(axis, x, y) for axis in before.rest])
    here = now.rest[:, rows, columns]
    error = np.sqrt(((moved - here) ** 2).sum(0))
    # The nearer neighbour's: the other may lie on a limb behind.
    step = np.minimum(*(np.sqrt(((now.rest[:, rows, columns + side] - here) ** 2).sum(0))
                        for side in (-1, 1)))
    size = np.abs(now.rest[:, now.ids > 0]).max()
    seen &= error < 1.5 * np.maximum(step, 1e-6) + 0.002 * size
    return rows[seen], columns[seen], x[seen], y[seen]


def window_sums(plane):
    """Sums over windows, at their middles; 0 at the border."""
    side = 2 * WINDOW + 1
    total = np.zeros((plane.shape[0] + 1, plane.shape[1] + 1))
    total[1:, 1:] = plane.cumsum(0).cumsum(1)
    result = np.zeros_like(plane)
    result[WINDOW:-WINDOW, WINDOW:-WINDOW] = (
        total[side:, side:] - total[:-side, side:] - total[side:, :-side] + total[:-side, :-side])
    return result


def slides(now, change, where):
    """Length of each window's slide, NaN where its strokes do not tell (least squares over it)."""
    down, across = np.gradient(now.strokes)
    across, down, change = (np.where(where, plane, 0.0) for plane in (across, down, change))
    xx, xy, yy = (window_sums(a * b) for a, b in ((across, across), (across, down), (down, down)))
    xt, yt = window_sums(across * change), window_sums(down * change)
    determinant = xx * yy - xy * xy
    least = (xx + yy) / 2 - np.sqrt(((xx - yy) / 2) ** 2 + xy * xy)
    whole = window_sums(where.astype(float)) > (2 * WINDOW + 1) ** 2 - 0.5
    if not whole.any():
        return np.full_like(change, np.nan)
    told = whole & (least > LEAST_SLOPE * np.median(least[whole])) & (determinant > 0)
    safe = np.where(told, determinant, 1.0)
    x, y = (yy * xt - xy * yt) / safe, (xx * yt - xy * xt) / safe
    return np.where(told, np.hypot(x, y), np.nan)


class Shot:
    """What is summed up over the frames of a shot for each of its parts."""

    def __init__(self):
        self.changes, self.deviations, self.slides = {}, {}, {}

    def add(self, now, before, parts):
        rows, columns, x, y = compared(now, before)
        change = np.zeros_like(now.strokes)
        change[rows, columns] = now.strokes[rows, columns] - sample(before.strokes, x, y)
        where = np.zeros_like(now.ids, bool)
        where[rows, columns] = True
        slide = slides(now, change, where)
        for name, part in parts.items():
            taken = where & part
            if taken.sum() < FEWEST:
                continue
            self.changes.setdefault(name, []).append(np.sqrt((change[taken] ** 2).mean()))
            self.deviations.setdefault(name, []).append(now.strokes[taken].std())
            told = slide[taken]
            self.slides.setdefault(name, []).append(told[~np.isnan(told)])

    def parts(self):
        return list(self.changes)

    def ratio(self, part):
        return float(np.mean(np.array(self.changes[part]) / self.deviations[part]))

    def slide(self, part):
        """(mean, what 99 % stay below) in pixels a frame."""
        told = np.concatenate(self.slides[part])
        return (float(told.mean()), float(np.percentile(told, 99))) if len(told) else (0.0, 0.0)

    def jump(self, part):
        return float(max(self.changes[part]) / np.median(self.changes[part]))

    def contrast(self, part):
        """Least and most deviation of a frame, over the median."""
        values = np.array(self.deviations[part]) / np.median(self.deviations[part])
        return float(values.min()), float(values.max())


def measure(folder, shot, ground, frames, parts_of):
    found, before = Shot(), None
    for number in frames:
        now = Frame(f"{folder}/{shot}/aovs/{shot}.{number:04}.exr",
                    f"{folder}/{shot}/{ground}/{shot}.{number:04}.exr")
        if before:
            found.add(now, before, parts_of(now))
        before = now
    return found

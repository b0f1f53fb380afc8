"""Geometry images as data: what `lozenge export --as npz` and `lozenge build --arrays` write, read with NumPy alone.

This file stands by itself: it needs neither the rest of the package nor what that is compiled with, and may be copied to where a
model is trained. With PyTorch installed `Assets` is one of its datasets, and `collate` makes tensors; without, both work the same on
arrays. docs/data.md says what the arrays are.
"""
import json
import pathlib

import numpy as np

try:
    import torch as _torch
    from torch.utils.data import Dataset as _Dataset
except ImportError:
    _torch = None
    _Dataset = object

__all__ = ["Assets", "Grid", "Patches", "collate", "load"]

#: Arrays of each sample; what else is of samples has one of these beginnings.
_OF_SAMPLES = ("positions", "normals", "mask", "caps", "joints_", "weights_", "source_")


#: Arrays that aren't of samples or texels.
_TABLES = ("adjacency", "places", "first_levels", "material_classes", "body_of")


def _is_of_samples(name):
    return name.startswith(_OF_SAMPLES)


class Grid(dict):
    """The arrays of all patches with equally many samples, by name: [patch, side, side, ...]; row j is v, column i is u."""

    def __init__(self, patches, side, arrays):
        super().__init__(arrays)
        self.patches = patches  #: range of their numbers
        self.side = side  #: samples


class Patches:
    """A geometry image: `grids`, and tables for all patches.

    Most images have one grid, whose arrays the Patches have by name: `patches["positions"]` is float32 [patch, N, N, 3]. Where parts
    have scales of their own there are several, of fewer and fewer samples a side; `padded` and `at` make one of them.
    """

    def __init__(self, about, tables, grids):
        self.about = about  #: what the JSON beside a geometry image says (docs/format.md)
        self.tables = tables  #: arrays that aren't of samples or texels, by name
        self.grids = grids  #: [Grid], the finest first

    @property
    def adjacency(self):
        """int32 [patch, side]: neighbour's number * 4 + its side; -1 where the surface ends."""
        return self.tables["adjacency"]

    def __len__(self):
        return len(self.adjacency)

    def __getitem__(self, name):
        if name in self.tables:
            return self.tables[name]
        grids = [grid for grid in self.grids if len(grid.patches)]
        if len(grids) == 1:
            return grids[0][name]
        raise ValueError(f"{name}: patches have different numbers of samples; look into `grids`, or use `padded` or `at`")

    @property
    def sides(self):
        """int64 [patch]: samples a side."""
        return np.concatenate([np.full(len(grid.patches), grid.side) for grid in self.grids])

    def flat(self, name):
        """An array of samples as one row of all, patch by patch: [samples, ...]. `vertices` and `triangles` count in it."""
        return np.concatenate([grid[name].reshape(-1, *grid[name].shape[3:]) for grid in self.grids])

    def padded(self, name):
        """An array of samples of all patches, as large as the finest: [patch, N, N, ...], zeros where a patch has no more."""
        side = max(grid.side for grid in self.grids)
        first = self.grids[0][name]
        whole = np.zeros((len(self), side, side, *first.shape[3:]), first.dtype)
        for grid in self.grids:
            whole[grid.patches.start:grid.patches.stop, :grid.side, :grid.side] = grid[name]
        return whole

    def at(self, side):
        """The level of detail whose finest patches have so many samples a side (2^k + 1): every second, every fourth, ... sample.
        It has no maps."""
        made = []
        for grid in self.grids:
            steps, rest = divmod(grid.side - 1, side - 1) if side > 1 else (0, 1)
            if grid.side < side:
                steps, rest = 1, 0
            if rest or steps & (steps - 1):
                raise ValueError(f"at: there is no level of {side} samples a side below {grid.side}")
            arrays = {name: array[:, ::steps, ::steps] for name, array in grid.items() if _is_of_samples(name)}
            fewer = (grid.side - 1) // steps + 1
            if made and made[-1].side == fewer:
                last = made.pop()
                arrays = {name: np.concatenate([last[name], array]) for name, array in arrays.items()}
                made.append(Grid(range(last.patches.start, grid.patches.stop), fewer, arrays))
            else:
                made.append(Grid(grid.patches, fewer, arrays))
        return Patches(self.about, self.tables, made)

    def _side_samples(self):
        """For each grid int64 [patch, side, place]: numbers of the samples along the sides, counter-clockwise."""
        begin = 0
        for grid in self.grids:
            n = grid.side
            k = np.arange(n)
            rows = np.stack([0 * k, k, 0 * k + n - 1, n - 1 - k])
            columns = np.stack([k, 0 * k + n - 1, n - 1 - k, 0 * k])
            first = begin + n * n * np.arange(len(grid.patches))
            begin += n * n * len(grid.patches)
            yield grid, first[:, None, None] + (rows * n + columns)[None]

    def vertices(self):
        """(int64 [samples], how many): the vertex that each sample is, by the adjacency table alone; -1 where there is no sample."""
        mask = self.flat("mask")
        vertex = np.arange(len(mask))
        pairs = []
        for grid, along in self._side_samples():
            across = self.adjacency[grid.patches.start:grid.patches.stop]
            patch, side = np.nonzero(across >= 0)
            other = across[patch, side]
            pairs.append((along[patch, side].ravel(), along[other // 4 - grid.patches.start, other % 4, ::-1].ravel()))
        here, there = (np.concatenate(ends) for ends in zip(*pairs))
        while True:  # the lowest number goes around each corner
            before = vertex.copy()
            np.minimum.at(vertex, here, before[there])
            if np.array_equal(vertex, before):
                break
        numbers = np.full(len(mask), -1)
        distinct, numbers[mask] = np.unique(vertex[mask], return_inverse=True)
        return numbers, len(distinct)

    def triangles(self):
        """int64 [triangles, 3]: samples at the corners, counter-clockwise seen from outside; each patch has samples of its own."""
        made = []
        begin = 0
        for grid in self.grids:
            n = grid.side
            a = begin + np.arange(len(grid.patches) * n * n).reshape(-1, n, n)
            begin += a.size
            a, b, c, d = a[:, :-1, :-1], a[:, :-1, 1:], a[:, 1:, :-1], a[:, 1:, 1:]
            mask = grid["mask"]
            on_diagonal = mask[:, :-1, :-1] & ~mask[:, :-1, 1:] & mask[:, 1:, 1:]
            made.append(np.stack([a, b, c], -1)[mask[:, :-1, 1:]])
            made.append(np.stack([d, c, b], -1)[mask[:, :-1, 1:]])
            made.append(np.stack([a, d, c], -1)[on_diagonal])
        return np.concatenate(made)


def load(path):
    """The Patches in a .npz.

    :raises ValueError: where the file isn't one that Lozenge wrote
    """
    with np.load(path, allow_pickle=False) as file:
        arrays = {name: file[name] for name in file.files}
    try:
        about = json.loads(arrays.pop("about").item())
        tables = {name: arrays.pop(name) for name in list(arrays) if name in _TABLES or name.startswith("mesh_")}
        by_level = {}
        for name, array in arrays.items():
            name, _, level = name.partition(".")
            by_level.setdefault(int(level or 0), {})[name] = array
        grids = [_grid(of, level, tables["first_levels"]) for level, of in sorted(by_level.items())]
        if sum(len(grid.patches) for grid in grids) != len(tables["adjacency"]):
            raise ValueError("patches are missing")
    except (KeyError, AttributeError, IndexError, ValueError) as wrong:
        raise ValueError(f"{path}: isn't what `lozenge export --as npz` writes ({wrong})") from wrong
    return Patches(about, tables, grids)


def _grid(arrays, level, first_levels):
    """Those of the patches that begin on a level, which are in order."""
    begin, end = np.searchsorted(first_levels, [level, level + 1]).tolist()
    count, side = arrays["positions"].shape[:2]
    for name, array in arrays.items():
        if _is_of_samples(name) and array.shape[:3] != (end - begin, side, side):
            raise ValueError(f"{name} has shape {array.shape}, for {end - begin} patches")
    return Grid(range(begin, begin + count), side, arrays)


class Assets(_Dataset):
    """The assets of a batch (`lozenge batch ... --arrays`) that are done, in the order of their names: a sequence of Patches.

    :param manifest: the batch's manifest.jsonl; arrays lie beside it
    :param transform: what to make of the Patches of each; None: themselves
    :raises FileNotFoundError: where an asset has no .npz
    """

    def __init__(self, manifest, transform=None):
        manifest = pathlib.Path(manifest)
        rows = {}
        for line in manifest.read_text(encoding="utf-8").splitlines():
            try:
                row = json.loads(line)
                rows[row["output"]] = row
            except (ValueError, KeyError, TypeError):
                continue  # what a killed process left of a row
        self.rows = [rows[name] for name in sorted(rows) if rows[name].get("status") == "done"]  #: of the manifest
        self.files = [manifest.parent / (row["output"] + ".npz") for row in self.rows]
        self.transform = transform
        for file in self.files:
            if not file.exists():
                raise FileNotFoundError(f"{file}: isn't there; build with --arrays, or use `lozenge export --as npz`")

    def __len__(self):
        return len(self.files)

    def __getitem__(self, number):
        patches = load(self.files[number])
        return self.transform(patches) if self.transform else patches


def collate(assets, tensors=_torch is not None):
    """Several Patches of one and the same number of samples a side as one, for a DataLoader's `collate_fn`: a dict of what all have.

    Patches come one after the other, so that [patch, ...] arrays are joined and `adjacency` counts on; "asset" [patch] says whose each is.
    :param tensors: whether arrays become PyTorch's
    :raises ValueError: where samples a side differ (`Patches.at` makes them the same)
    """
    assets = list(assets)
    grids = [[grid for grid in asset.grids if len(grid.patches)] for asset in assets]
    if any(len(of) != 1 for of in grids) or len({of[0].side for of in grids}) != 1:
        raise ValueError("collate: patches have different numbers of samples; use Patches.at first")
    first = np.cumsum([0] + [len(asset) for asset in assets])
    joined = {"asset": np.repeat(np.arange(len(assets)), np.diff(first)),
              "adjacency": np.concatenate([np.where(asset.adjacency >= 0, asset.adjacency + 4 * begin, -1)
                                           for asset, begin in zip(assets, first)])}
    names = set.intersection(*(set(of[0]) for of in grids))
    for name in sorted(name for name in names if not name.endswith("_at")):
        arrays = [of[0][name] for of in grids]
        if len({array.shape[1:] for array in arrays}) == 1:
            joined[name] = np.concatenate(arrays)
    if tensors:
        return {name: _torch.from_numpy(np.ascontiguousarray(array)) for name, array in joined.items()}
    return joined

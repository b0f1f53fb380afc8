"""Lozenge from Python: meshes as NumPy arrays become geometry images, texture coordinates, maps and assets.

Positions are float32 [vertices, 3] in the mesh's own unit of length, triangles are integers [triangles, 3], counter-clockwise seen from outside.
Float32 and int32 arrays are read where they are; others are converted once. Arrays that objects have are views, alive as long as anybody
uses them. The interpreter's lock is free while Lozenge works; Ctrl-C stops that. `progress`, where a function takes it, is called
as progress(what, share). `threads`, where a function takes it, is the most threads that it may use; 0: one for each core. It holds for
the whole process while the call lasts: of several calls at once the lowest number counts. The same input gives the same bits, on any
number of threads.
"""
import json as _json
from typing import NamedTuple as _NamedTuple

import numpy as _numpy

from . import _lozenge
from ._lozenge import GeometryImage, Map, Maps, Mesh, Samples, read, read_geometry_image, write_geometry_image
from .errors import (Error, InternalError, LimitError, RefusedError, UnsupportedError, UnusableInputError,
                     UsageError)

__all__ = ["Build", "Correspondence", "Error", "GeometryImage", "InternalError", "LimitError", "Map", "Maps", "Mesh",
           "RefusedError", "Samples", "UnsupportedError", "Unwrapped", "UnusableInputError", "UsageError", "bake", "build",
           "export", "parameterize", "read", "read_geometry_image", "unwrap", "write_geometry_image"]


class Correspondence(_NamedTuple):
    """Points of the mesh that was parameterized."""

    triangles: _numpy.ndarray  #: int32 [...]: numbers of its triangles; -1: there is none, or it caps a hole
    weights: _numpy.ndarray  #: float32 [..., 3]: of the triangle's three corners; they add up to 1

    def interpolate(self, triangles, values):
        """Values [vertices, ...] of the mesh's vertices, such as its positions, at these points: [..., ...]; zeros where there is none."""
        values = _numpy.asarray(values)
        corners = values[_numpy.asarray(triangles)[self.triangles]]
        weights = self.weights.reshape(self.weights.shape + (1,) * (values.ndim - 1))
        return (corners * weights).sum(axis=self.triangles.ndim)


class Unwrapped(_NamedTuple):
    """A mesh with texture coordinates."""

    positions: _numpy.ndarray  #: float32 [vertices, 3]
    triangles: _numpy.ndarray  #: int32 [triangles, 3]: all that were given, cut where charts end
    uvs: _numpy.ndarray  #: float32 [vertices, 2]: from 0 to 1, v down
    source_vertices: _numpy.ndarray  #: int32 [vertices, 3]: the given vertices that each lies between
    weights: _numpy.ndarray  #: float32 [vertices, 3]: of those; (1, 0, 0) of one that was given


class Build(_NamedTuple):
    """What a build made."""

    files: list  #: pathlib.Path of each
    notes: list  #: sentences on what isn't as it was asked for, or was in the source
    report: dict  #: as the command's --report writes it


def parameterize(positions, triangles=None, *, domain_faces=None, energy="isometric", fill_holes=2.0, threads=0, progress=None):
    """Maps a surface onto equilateral triangles.

    :param positions: float32 [vertices, 3], or a Mesh; corners of equal positions are one vertex
    :param triangles: integers [triangles, 3]; none where a Mesh is given
    :param domain_faces: triangles of the domain, or the least and the most; None: as the surface asks for
    :param energy: "isometric", "mips" or "symmetric-dirichlet"
    :param fill_holes: of arrays, holes of at most this length around are filled, in percent of the diagonal of their box
    :raises UnusableInputError: where an index is out of range, a position isn't finite, or no triangle has any area
    """
    if isinstance(positions, Mesh):
        if triangles is not None:
            raise UsageError("triangles: a Mesh has its own")
        return _lozenge._parameterize_mesh(positions, domain_faces, energy, threads, progress)
    return _lozenge._parameterize_arrays(_numpy.asarray(positions), _numpy.asarray(triangles), domain_faces, energy, fill_holes,
                                         threads, progress)


def _correspondence(self, size, image=None, *, gutter=None, maps=None, threads=0, progress=None):
    """The source point of every texel of a square atlas: Correspondence of [size, size], row 0 at the top.

    :param image: the geometry image whose maps are meant; None: `geometry_image`
    :param gutter: texels around each patch that continue it into its neighbours; None: as `bake` has it
    :param maps: over whose atlas: `bake` orders the patches of a Mesh that has a look of its own by what they show; None: they lie in
        the order of the image
    """
    return Correspondence(*_lozenge.Map._correspondence(self, size, image, gutter, maps, threads, progress))


def _sources(self, of):
    """The source points of all samples, patch by patch: Correspondence of [all samples]. :param of: the Map that was sampled"""
    return Correspondence(*_lozenge.Samples._sources(self, of))


Map.correspondence = _correspondence
Samples.sources = _sources


def unwrap(positions, triangles, *, map_size=0, gutter=2, texels_per_unit=0.0, domain_faces=None, fill_holes=2.0, threads=0, progress=None):
    """Texture coordinates for a mesh: Unwrapped.

    :param map_size: side of the atlas in texels; 0: 2048, or as much more as it needs
    :param gutter: texels around each chart that belong to it
    :param texels_per_unit: texels to a unit of length, which decide the atlas's side; 0: they don't
    """
    return Unwrapped(*_lozenge._unwrap(_numpy.asarray(positions), _numpy.asarray(triangles), map_size, gutter, texels_per_unit,
                                       domain_faces, fill_holes, threads, progress))


def bake(map, image, maps=(), *, size=0, gutter=None, occlusion_rays=64, threads=0, progress=None):
    """Texture maps over a geometry image's atlas, from the surface that it was sampled from: Maps, by name.

    :param maps: names: "normal", "object-normal", "occlusion", "position", "base-color", "orm", "emissive", "source-normal"; none: what
        the command bakes
    :param size: side of the square atlas in texels; 0: as the command chooses it
    """
    return _lozenge._bake(map, image, list(maps), size, gutter, occlusion_rays, threads, progress)


def export(path, map, image, maps, *, triangle_budget=0, coarser_levels=-1, finest="auto", threads=0):
    """Writes the asset that an engine loads: a .glb with levels of detail and the maps as textures. Returns numbers of what it holds.

    :param triangle_budget: most triangles of the finest level; 0: no limit
    :param coarser_levels: how many at most; -1: as many as there are down to some hundred triangles
    :param finest: "source": the source's own triangles; "samples"; "auto": whichever are fewer
    """
    return _lozenge._export(path, map, image, maps, triangle_budget, coarser_levels, finest, threads)


def build(path, folder=".", *, name="", domain_faces=None, samples=0, error=0.05, map_size=0, triangle_budget=0, fill_holes=2.0,
          preview=True, arrays=False, threads=0, progress=None):
    """What `lozenge build` does with a file, to the bit: Build.

    :param folder: of the outputs; made where it isn't there
    :param samples: a side of each patch, 2^k + 1; 0: the fewest that hold the source to `error`
    :param error: root mean square of the distance to the source, in percent of the diagonal of its box
    :param arrays: whether to write NAME.npz, which `lozenge.data` reads
    """
    files, notes, report = _lozenge._build(path, folder, name, domain_faces, samples, error, map_size, triangle_budget, fill_holes,
                                           preview, arrays, threads, progress)
    return Build(files, notes, _json.loads(report))

from os import PathLike
from typing import Any, Callable, Iterable, Iterator, List, NamedTuple, Optional, Tuple, Union, overload
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import Error as Error, InternalError as InternalError, LimitError as LimitError, RefusedError as RefusedError
from .errors import UnsupportedError as UnsupportedError, UnusableInputError as UnusableInputError, UsageError as UsageError

_Path = Union[str, "PathLike[str]"]
_Faces = Union[None, int, Tuple[int, int]]
_Progress = Optional[Callable[[str, float], Any]]
_Floats = NDArray[np.float32]
_Ints = NDArray[np.int32]

class Mesh:
    """A surface as the importer makes it: welded, mended, small holes filled."""
    @property
    def positions(self) -> _Floats:
        """[vertices, 3], a view."""
    @property
    def triangles(self) -> _Ints:
        """[triangles, 3], a view."""
    @property
    def origin(self) -> str: ...
    @property
    def material_names(self) -> List[str]: ...

class Correspondence(NamedTuple):
    triangles: _Ints
    weights: _Floats
    def interpolate(self, triangles: ArrayLike, values: ArrayLike) -> NDArray[Any]: ...

class Unwrapped(NamedTuple):
    positions: _Floats
    triangles: _Ints
    uvs: _Floats
    source_vertices: _Ints
    weights: _Floats

class Build(NamedTuple):
    files: List[Path]
    notes: List[str]
    report: dict[str, Any]

class GeometryImage:
    @property
    def samples(self) -> int:
        """N, a side of the patches on level 0."""
    @property
    def patches(self) -> int: ...
    @property
    def columns(self) -> int:
        """Tiles side by side in the pictures."""
    @property
    def levels(self) -> int: ...
    @property
    def first_levels(self) -> _Ints:
        """[patch] the finest level that has it."""
    @property
    def adjacency(self) -> _Ints:
        """[patch, side, (patch, side)] across each side; -1, -1 where the surface ends. Sides: docs/format.md. A view."""
    @property
    def places(self) -> _Ints:
        """[patch, 6] on the domain: vertices a and b, triangle and side on the left, and on the right. A view."""
    def position_picture(self, level: int = 0) -> _Floats:
        """[height, width, 3]: the picture of all tiles, a view."""
    def normal_picture(self, level: int = 0) -> _Floats: ...
    def positions(self, level: int = 0) -> _Floats:
        """[patch, N, N, 3]: row j is v = j / (N - 1), column i is u; of the patches that the level has. A copy."""
    def normals(self, level: int = 0) -> _Floats:
        """The same of unit normals."""
    def mask(self, level: int = 0) -> NDArray[np.bool_]:
        """[patch, N, N]: whether the surface has the sample."""
    def write(self, path: _Path) -> None: ...

class Samples:
    @property
    def samples(self) -> int: ...
    @property
    def patches(self) -> int: ...
    @property
    def first(self) -> NDArray[np.int64]:
        """[patches + 1] where each patch's samples begin, row by row."""
    @property
    def positions(self) -> _Floats:
        """[all samples, 3], a view."""
    @property
    def normals(self) -> _Floats: ...
    @property
    def geometry_image(self) -> GeometryImage: ...
    def sources(self, of: Map) -> Correspondence: ...

class Map:
    @property
    def positions(self) -> _Floats:
        """[vertices, 3] of the surface that is mapped: the source's, where long edges were split some more. A view."""
    @property
    def triangles(self) -> _Ints: ...
    @property
    def domain_triangle(self) -> _Ints:
        """[vertex] the domain triangle that it lies in, a view."""
    @property
    def alpha_beta(self) -> NDArray[np.float64]:
        """[vertex, 2] the weights of that triangle's corners 0 and 1, multiples of 2^-40; a view."""
    @property
    def domain(self) -> _Ints:
        """[domain triangle, 3] vertices of the domain, a view."""
    @property
    def neighbours(self) -> _Ints:
        """[domain triangle, side, (triangle, side)]; -1, -1 at the boundary. A view."""
    @property
    def distortion(self) -> dict[str, float]:
        """"area", "angle", "aggregate" (0: none), "l2_stretch" (1: none)."""
    @property
    def notes(self) -> List[str]:
        """Sentences on repairs and on the domain's size."""
    def sample(self, samples: int = 0, *, error: float = 0.05, threads: int = 0, progress: _Progress = None) -> Samples:
        """Samples a side of each patch: 2^k + 1; 0: the fewest that hold the source to `error` (RMS, percent of its box's diagonal)."""
    @property
    def geometry_image(self) -> GeometryImage:
        """`sample().geometry_image`, made anew each time."""
    def correspondence(self, size: int, image: Optional[GeometryImage] = None, *, gutter: Optional[int] = None,
                       maps: Optional[Maps] = None, threads: int = 0, progress: _Progress = None) -> Correspondence: ...

class Maps:
    """Texture maps by name, all over one atlas: `maps["normal"]` is float32 [height, width, channels], a view that may be written
    to; `maps["base-color"] = array` adds one or replaces it. Colours are linear, from 0 to 1; directions are unit vectors."""
    def __getitem__(self, name: str) -> _Floats: ...
    def __setitem__(self, name: str, texels: ArrayLike) -> None: ...
    def __contains__(self, name: str) -> bool: ...
    def __len__(self) -> int: ...
    def __iter__(self) -> Iterator[str]: ...
    def keys(self) -> List[str]: ...
    def write(self, folder: _Path, name: str, *, bits: int = 8) -> None:
        """NAME.normal.png and so on; positions as .exr."""

def read(path: _Path, *, fill_holes: float = 2.0, strict: bool = False, threads: int = 0, progress: _Progress = None) -> Mesh: ...
@overload
def parameterize(positions: Mesh, *, domain_faces: _Faces = None, energy: str = "isometric", threads: int = 0, progress: _Progress = None) -> Map: ...
@overload
def parameterize(positions: ArrayLike, triangles: ArrayLike, *, domain_faces: _Faces = None, energy: str = "isometric",
                 fill_holes: float = 2.0, threads: int = 0, progress: _Progress = None) -> Map: ...
def unwrap(positions: ArrayLike, triangles: ArrayLike, *, map_size: int = 0, gutter: int = 2, texels_per_unit: float = 0.0,
           domain_faces: _Faces = None, fill_holes: float = 2.0, threads: int = 0, progress: _Progress = None) -> Unwrapped: ...
def bake(map: Map, image: GeometryImage, maps: Iterable[str] = (), *, size: int = 0, gutter: Optional[int] = None,
         occlusion_rays: int = 64, threads: int = 0, progress: _Progress = None) -> Maps: ...
def export(path: _Path, map: Map, image: GeometryImage, maps: Maps, *, triangle_budget: int = 0, coarser_levels: int = -1,
           finest: str = "auto", threads: int = 0) -> dict[str, Any]: ...
def build(path: _Path, folder: _Path = ".", *, name: str = "", domain_faces: _Faces = None, samples: int = 0, error: float = 0.05,
          map_size: int = 0, triangle_budget: int = 0, fill_holes: float = 2.0, preview: bool = True,
          arrays: bool = False, threads: int = 0, progress: _Progress = None) -> Build: ...
def read_geometry_image(path: _Path) -> GeometryImage: ...
def write_geometry_image(path: _Path, image: GeometryImage) -> None: ...

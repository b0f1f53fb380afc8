from os import PathLike
from pathlib import Path
from typing import Any, Callable, Dict, Iterable, List, Optional, Tuple, Union

import numpy as np
from numpy.typing import NDArray

_Path = Union[str, "PathLike[str]"]
_Array = NDArray[Any]
_Ints = NDArray[np.int64]

class Grid(Dict[str, _Array]):
    """The arrays of all patches with equally many samples, by name: [patch, side, side, ...]."""
    patches: range
    side: int
    def __init__(self, patches: range, side: int, arrays: Dict[str, _Array]) -> None: ...

class Patches:
    """A geometry image: `grids`, and tables for all patches."""
    about: Dict[str, Any]
    tables: Dict[str, _Array]
    grids: List[Grid]
    def __init__(self, about: Dict[str, Any], tables: Dict[str, _Array], grids: List[Grid]) -> None: ...
    @property
    def adjacency(self) -> NDArray[np.int32]:
        """[patch, side]: neighbour's number * 4 + its side; -1 where the surface ends."""
    @property
    def sides(self) -> _Ints:
        """[patch]: samples a side."""
    def __len__(self) -> int: ...
    def __getitem__(self, name: str) -> _Array: ...
    def flat(self, name: str) -> _Array:
        """[samples, ...]: an array of samples as one row of all, patch by patch."""
    def padded(self, name: str) -> _Array:
        """[patch, N, N, ...], zeros where a patch has no more."""
    def at(self, side: int) -> Patches:
        """The level of detail whose finest patches have so many samples a side; it has no maps."""
    def vertices(self) -> Tuple[_Ints, int]:
        """([samples], how many): the vertex that each sample is, by the adjacency table alone; -1 where there is no sample."""
    def triangles(self) -> _Ints:
        """[triangles, 3]: samples at the corners, counter-clockwise seen from outside."""

class Assets:
    """The assets of a batch that are done; a torch.utils.data.Dataset where PyTorch is installed."""
    rows: List[Dict[str, Any]]
    files: List[Path]
    transform: Optional[Callable[[Patches], Any]]
    def __init__(self, manifest: _Path, transform: Optional[Callable[[Patches], Any]] = None) -> None: ...
    def __len__(self) -> int: ...
    def __getitem__(self, number: int) -> Any: ...

def load(path: _Path) -> Patches: ...
def collate(assets: Iterable[Patches], tensors: bool = ...) -> Dict[str, Any]: ...

from os import PathLike
from typing import Any, Iterable, Iterator, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

__version__: str

# Control points (patches, rows, columns, components), or several such arrays where degrees differ.
_Nets = Union[ArrayLike, Sequence[NDArray[Any]]]
_Names = Union[str, Iterable[str]]
_Arrays = dict[str, NDArray[Any]]
_Out = Optional[dict[str, NDArray[Any]]]
# Orders in u and in v, and the arrays of these derivatives.
_Orders = Optional[Iterable[tuple[int, int]]]
_Derivatives = dict[tuple[int, int], NDArray[Any]]
_DerivativeOut = Optional[_Derivatives]
# Control points, or with weights beside them a pair of points and weights.
_Points = Any

# Of u, along a row, and of v; None: uniform knots, the whole domain.
_Knots = Optional[tuple[Optional[ArrayLike], Optional[ArrayLike]]]
_Ranges = Optional[tuple[Optional[ArrayLike], Optional[ArrayLike]]]

class PatchIndexError(IndexError, ValueError): ...

class PatchSet:
    def __init__(
        self,
        points: _Nets,
        weights: Optional[_Nets] = None,
        dtype: Optional[DTypeLike] = None,
        *,
        local_origin: bool = False,
        relative_to: Optional[ArrayLike] = None,
        threads: int = 0,
        homogeneous: bool = False,
    ) -> None: ...
    def __len__(self) -> int: ...
    @property
    def components(self) -> int: ...
    @property
    def dtype(self) -> np.dtype[Any]: ...
    def degrees(self, patch: int) -> tuple[int, int]: ...
    def is_rational(self, patch: int) -> bool: ...
    def evaluate_grid(
        self,
        nu: Union[int, ArrayLike],
        nv: Union[int, ArrayLike],
        outputs: _Names = ('position',),
        out: _Out = None,
        threads: int = 0,
    ) -> _Arrays: ...
    def evaluate(
        self,
        patch: Union[int, ArrayLike],
        u: ArrayLike,
        v: ArrayLike,
        outputs: _Names = ('position',),
        out: _Out = None,
        threads: int = 0,
    ) -> _Arrays: ...
    def evaluate_derivatives(
        self,
        patch: Union[int, ArrayLike],
        u: ArrayLike,
        v: ArrayLike,
        derivatives: _Orders,
        out: _DerivativeOut = None,
        threads: int = 0,
    ) -> _Derivatives: ...
    def evaluate_grid_derivatives(
        self,
        nu: Union[int, ArrayLike],
        nv: Union[int, ArrayLike],
        derivatives: _Orders,
        out: _DerivativeOut = None,
        threads: int = 0,
    ) -> _Derivatives: ...
    def error_bounds(self, patch: Optional[int] = None) -> dict[str, NDArray[np.float64]]: ...

class CurveSet:
    def __init__(
        self,
        points: ArrayLike,
        weights: Optional[ArrayLike] = None,
        dtype: Optional[DTypeLike] = None,
        *,
        local_origin: bool = False,
        relative_to: Optional[ArrayLike] = None,
        threads: int = 0,
        homogeneous: bool = False,
    ) -> None: ...
    def __len__(self) -> int: ...
    @property
    def degree(self) -> int: ...
    @property
    def components(self) -> int: ...
    @property
    def rational(self) -> bool: ...
    @property
    def dtype(self) -> np.dtype[Any]: ...
    def evaluate_grid(
        self, n: int, outputs: _Names = ('position',), out: _Out = None, threads: int = 0
    ) -> _Arrays: ...
    def evaluate(
        self,
        curve: Union[int, ArrayLike],
        t: ArrayLike,
        outputs: _Names = ('position',),
        out: _Out = None,
        threads: int = 0,
    ) -> _Arrays: ...
    def error_bounds(self, curve: Optional[int] = None) -> dict[str, NDArray[np.float64]]: ...

class SplineSurface:
    def __init__(
        self,
        points: ArrayLike,
        degrees: tuple[int, int] = (3, 3),
        knots: _Knots = None,
        weights: Optional[ArrayLike] = None,
        homogeneous: bool = False,
        periodic: tuple[bool, bool] = (False, False),
        ranges: _Ranges = None,
        knot_tolerance: float = 0.0,
        dtype: Optional[DTypeLike] = None,
    ) -> None: ...
    def __len__(self) -> int: ...
    @property
    def spans(self) -> tuple[int, int]: ...
    @property
    def components(self) -> int: ...
    @property
    def dtype(self) -> np.dtype[Any]: ...
    @property
    def intervals(self) -> NDArray[np.float64]: ...
    @property
    def patch_set(self) -> PatchSet: ...
    def to_bezier(self) -> _Points: ...
    def locate(self, U: ArrayLike, V: ArrayLike) -> _Arrays: ...
    def evaluate(
        self,
        U: ArrayLike,
        V: ArrayLike,
        outputs: _Names = ('position',),
        out: _Out = None,
        threads: int = 0,
        derivatives: Optional[Iterable[tuple[int, int]]] = None,
    ) -> dict[Any, NDArray[Any]]: ...
    def evaluate_grid(
        self,
        U: ArrayLike,
        V: ArrayLike,
        outputs: _Names = ('position',),
        out: _Out = None,
        threads: int = 0,
        derivatives: Optional[Iterable[tuple[int, int]]] = None,
    ) -> dict[Any, NDArray[Any]]: ...

class SplineCurve:
    def __init__(
        self,
        points: ArrayLike,
        degree: int = 3,
        knots: Optional[ArrayLike] = None,
        weights: Optional[ArrayLike] = None,
        homogeneous: bool = False,
        periodic: bool = False,
        range: Optional[ArrayLike] = None,
        knot_tolerance: float = 0.0,
        dtype: Optional[DTypeLike] = None,
    ) -> None: ...
    def __len__(self) -> int: ...
    @property
    def spans(self) -> int: ...
    @property
    def degree(self) -> int: ...
    @property
    def components(self) -> int: ...
    @property
    def dtype(self) -> np.dtype[Any]: ...
    @property
    def intervals(self) -> NDArray[np.float64]: ...
    @property
    def curve_set(self) -> CurveSet: ...
    def to_bezier(self) -> _Points: ...
    def locate(self, t: ArrayLike) -> _Arrays: ...
    def evaluate(
        self,
        t: ArrayLike,
        outputs: _Names = ('position',),
        out: _Out = None,
        threads: int = 0,
        derivatives: Optional[Iterable[int]] = None,
    ) -> dict[Any, NDArray[Any]]: ...

class Mesh:
    @property
    def positions(self) -> NDArray[Any]: ...
    @property
    def normals(self) -> Optional[NDArray[Any]]: ...
    @property
    def parameters(self) -> Optional[NDArray[Any]]: ...
    @property
    def patches(self) -> Optional[NDArray[np.uint32]]: ...
    @property
    def triangles(self) -> NDArray[np.uint32]: ...
    @property
    def deviation(self) -> float: ...
    @property
    def deviations(self) -> NDArray[np.float64]: ...
    @property
    def split_edges(self) -> int: ...
    @property
    def unjoined_edges(self) -> int: ...
    @property
    def largest_gap(self) -> float: ...
    def save(
        self,
        path: Union[str, bytes, PathLike[str], PathLike[bytes]],
        point_data: Optional[dict[str, ArrayLike]] = None,
    ) -> None: ...

class Polylines:
    def __len__(self) -> int: ...
    def __getitem__(self, index: int) -> NDArray[Any]: ...
    def __iter__(self) -> Iterator[NDArray[Any]]: ...
    @property
    def points(self) -> NDArray[Any]: ...
    @property
    def first(self) -> NDArray[np.int64]: ...
    @property
    def deviation(self) -> float: ...
    @property
    def deviations(self) -> NDArray[np.float64]: ...

def flatten(
    points: ArrayLike,
    tolerance: Union[float, ArrayLike],
    weights: Optional[ArrayLike] = None,
    *,
    dtype: Optional[DTypeLike] = None,
    threads: int = 0,
    homogeneous: bool = False,
) -> Polylines: ...
def tessellate(
    points: Union[_Nets, SplineSurface, Sequence[SplineSurface]],
    tolerance: Union[None, float, ArrayLike] = None,
    weights: Optional[_Nets] = None,
    *,
    relative: Optional[float] = None,
    grid: Union[None, int, tuple[int, int]] = None,
    crease: Optional[float] = None,
    normals: bool = True,
    parameters: bool = False,
    orient: bool = False,
    flip: bool = False,
    snap: float = 0.0,
    split_edges: bool = False,
    point_size: float = 0.0,
    drop_repeated: bool = False,
    longest_edge: Optional[float] = None,
    thorough: bool = False,
    dtype: Optional[DTypeLike] = None,
    threads: int = 0,
    homogeneous: bool = False,
) -> Mesh: ...
def available_isas() -> list[str]: ...
def elevate(
    points: ArrayLike, degree_u: int, degree_v: int, weights: Optional[ArrayLike] = None,
    *, homogeneous: bool = False
) -> _Points: ...
def reverse_u(
    points: ArrayLike, weights: Optional[ArrayLike] = None, *, homogeneous: bool = False
) -> _Points: ...
def reverse_v(
    points: ArrayLike, weights: Optional[ArrayLike] = None, *, homogeneous: bool = False
) -> _Points: ...
def transpose(
    points: ArrayLike, weights: Optional[ArrayLike] = None, *, homogeneous: bool = False
) -> _Points: ...
def hodograph_u(points: ArrayLike) -> NDArray[Any]: ...
def hodograph_v(points: ArrayLike) -> NDArray[Any]: ...
def split_u(
    points: ArrayLike, u: float = 0.5, weights: Optional[ArrayLike] = None,
    *, homogeneous: bool = False
) -> tuple[_Points, _Points]: ...
def split_v(
    points: ArrayLike, v: float = 0.5, weights: Optional[ArrayLike] = None,
    *, homogeneous: bool = False
) -> tuple[_Points, _Points]: ...
def split(
    points: ArrayLike, u: float = 0.5, v: float = 0.5, weights: Optional[ArrayLike] = None,
    *, homogeneous: bool = False
) -> tuple[_Points, _Points, _Points, _Points]: ...
def segment(
    points: ArrayLike,
    u0: float,
    u1: float,
    v0: float,
    v1: float,
    weights: Optional[ArrayLike] = None,
    *,
    homogeneous: bool = False,
) -> _Points: ...
def spline_to_bezier(
    points: ArrayLike,
    degrees: tuple[int, int] = (3, 3),
    knots: _Knots = None,
    weights: Optional[ArrayLike] = None,
    homogeneous: bool = False,
    periodic: tuple[bool, bool] = (False, False),
    ranges: _Ranges = None,
    knot_tolerance: float = 0.0,
) -> _Points: ...
def control_boxes(
    points: ArrayLike, weights: Optional[ArrayLike] = None,
    *, homogeneous: bool = False
) -> tuple[NDArray[Any], NDArray[Any]]: ...
def tight_boxes(
    points: ArrayLike, levels: int = 2, weights: Optional[ArrayLike] = None,
    *, homogeneous: bool = False
) -> tuple[NDArray[Any], NDArray[Any]]: ...
def flatness(
    points: ArrayLike, weights: Optional[ArrayLike] = None, *, homogeneous: bool = False
) -> NDArray[Any]: ...

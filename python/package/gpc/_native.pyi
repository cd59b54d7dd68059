from collections.abc import Callable, Sequence
from os import PathLike
from typing import Any, Literal, Optional, Union, overload

import numpy as np
import numpy.typing as npt
from typing_extensions import TypedDict, Unpack, final

__all__ = [
    "Camera",
    "Comparison",
    "DeviceError",
    "GpcError",
    "Renderer",
    "Scene",
    "SceneError",
    "__version__",
    "compare",
    "render",
]

__version__: str

_FloatImage = npt.NDArray[np.float32]
_CodeImage = npt.NDArray[np.uint8]
_Layers = dict[str, npt.NDArray[Any]]
_Vector = Union[Sequence[float], npt.NDArray[np.float64]]
_Matrix = Union[Sequence[Sequence[float]], npt.NDArray[np.float64]]
_Size = tuple[int, int]
_Source = Union[Scene, str, PathLike[str], Any]
"""A Scene, a file, or a mesh or scene of trimesh."""

class _Options(TypedDict, total=False):
    """Keyword arguments that all ways of making an image have in common."""

    samples: int
    """Samples of a pixel that aliases: 1 to 1,024, by default 64."""
    method: Literal["superpixel", "none", "ssaa", "msaa"]
    filter: Literal["box", "tent", "gaussian", "mitchell", "blackman-harris"]
    """Filter by which a pixel is averaged. Locations of shape (N, 2) have no neighbours, and are averaged by the box alone."""
    filter_radius: Optional[float]
    """Distance in pixels at which the filter ends; None for the filter's default."""
    contrast: Optional[int]
    """Codes of 8 bits by which colours must differ for a pixel to be sampled again."""
    shading: Literal["triangle", "part", "sample"]
    background: Optional[_Vector]
    """Linear red, green and blue; None for transparent."""
    exposure: float
    """Stops: 1 is twice as bright."""
    region: Optional[tuple[int, int, int, int]]
    """Left, top, width and height in pixels of the part that is rendered."""
    line_width: float
    point_size: float

class GpcError(Exception):
    """An error of the renderer."""

class SceneError(GpcError):
    """A scene that can't be read or shown."""

class DeviceError(GpcError):
    """No suitable device, a lost device, or too little memory."""

@final
class Camera:
    """A camera. World space is glTF's: right-handed, y up."""

    @staticmethod
    def orbit(azimuth: float = 35.0, elevation: float = 20.0, zoom: float = 1.0, fov: float = 40.0) -> Camera: ...
    @staticmethod
    def look_at(
        eye: _Vector,
        target: Optional[_Vector] = None,
        up: _Vector = ...,
        fov: float = 40.0,
        near: Optional[float] = None,
    ) -> Camera: ...
    @staticmethod
    def of_scene(name: str = "0", fov: Optional[float] = None) -> Camera: ...
    @staticmethod
    def from_pose(camera_to_world: _Matrix, fov: float = 40.0, near: Optional[float] = None) -> Camera: ...
    @staticmethod
    def from_intrinsics(matrix: _Matrix, world_to_camera: _Matrix, near: Optional[float] = None) -> Camera: ...

@final
class Scene:
    """A scene: triangles, lines and points, materials, textures, lights, cameras and animations."""

    @property
    def warnings(self) -> list[str]: ...
    @property
    def bounds(self) -> Optional[tuple[tuple[float, float, float], tuple[float, float, float]]]: ...
    @property
    def triangles(self) -> int: ...
    @property
    def cameras(self) -> list[Optional[str]]: ...
    @staticmethod
    def load(
        path: Union[str, PathLike[str]],
        *,
        variant: Optional[str] = None,
        environment: Union[None, str, PathLike[str]] = None,
    ) -> Scene: ...
    @staticmethod
    def from_bytes(data: bytes, name: str = "scene", base: Union[None, str, PathLike[str]] = None) -> Scene: ...
    @staticmethod
    def from_arrays(
        vertices: npt.ArrayLike,
        faces: npt.ArrayLike,
        *,
        normals: Optional[npt.ArrayLike] = None,
        uvs: Optional[npt.ArrayLike] = None,
        colors: Optional[npt.ArrayLike] = None,
        texture: Optional[_CodeImage] = None,
        base_color: _Vector = ...,
        metallic: float = 0.0,
        roughness: float = 0.7,
        unlit: bool = False,
        double_sided: bool = True,
    ) -> Scene: ...
    @staticmethod
    def from_trimesh(object: Any) -> Scene: ...

@final
class Renderer:
    """A device with a scene on it. It may be used from several threads, one after the other."""

    def __new__(
        cls,
        scene: _Source,
        *,
        shadows: bool = False,
        time: float = 0.0,
        animation: Optional[str] = None,
        device: Optional[str] = None,
        max_memory: Optional[int] = None,
        validation: bool = False,
    ) -> Renderer: ...
    @property
    def device(self) -> str: ...
    @property
    def validation_messages(self) -> list[str]: ...
    @overload
    def render(
        self, camera: Optional[Camera] = None, size: _Size = ..., *, dtype: Literal["uint8"], **options: Unpack[_Options]
    ) -> _CodeImage: ...
    @overload
    def render(
        self, camera: Optional[Camera] = None, size: _Size = ..., *, layers: Sequence[str], dtype: str = "float32",
        **options: Unpack[_Options],
    ) -> _Layers: ...
    @overload
    def render(
        self, camera: Optional[Camera] = None, size: _Size = ..., *, dtype: Literal["float32"] = "float32",
        **options: Unpack[_Options],
    ) -> _FloatImage: ...
    @overload
    def render_views(
        self, cameras: Sequence[Camera], size: _Size = ..., *, progress: Optional[Callable[[int, int], object]] = None,
        dtype: Literal["uint8"], **options: Unpack[_Options],
    ) -> _CodeImage: ...
    @overload
    def render_views(
        self, cameras: Sequence[Camera], size: _Size = ..., *, progress: Optional[Callable[[int, int], object]] = None,
        dtype: Literal["float32"] = "float32", **options: Unpack[_Options],
    ) -> _FloatImage: ...
    def zoom(
        self,
        center: _Vector,
        radius: float,
        magnify: float,
        camera: Optional[Camera] = None,
        size: _Size = ...,
        *,
        shape: Literal["circle", "rectangle"] = "circle",
        smooth: bool = False,
        dtype: Literal["float32", "uint8"] = "float32",
        layers: Sequence[str] = ...,
        **options: Unpack[_Options],
    ) -> Any: ...
    def panorama(
        self,
        projection: Literal["equirectangular", "cylindrical", "fisheye", "cubemap"],
        size: _Size = ...,
        camera: Optional[Camera] = None,
        *,
        fov: Optional[float] = None,
        dtype: Literal["float32", "uint8"] = "float32",
        layers: Sequence[str] = ...,
        **options: Unpack[_Options],
    ) -> Any: ...
    def sample(
        self,
        locations: npt.NDArray[np.float64],
        plane: _Size,
        camera: Optional[Camera] = None,
        *,
        jacobians: Optional[npt.NDArray[np.float64]] = None,
        dtype: Literal["float32", "uint8"] = "float32",
        layers: Sequence[str] = ...,
        **options: Unpack[_Options],
    ) -> Any: ...

@final
class Comparison:
    """Differences between an image and a reference, as a display shows them."""

    @property
    def rmse(self) -> float: ...
    @property
    def psnr(self) -> float: ...
    @property
    def max(self) -> float: ...
    @property
    def flip(self) -> float: ...
    @property
    def over_2(self) -> int: ...
    @property
    def over_8(self) -> int: ...

@overload
def render(
    scene: _Source,
    size: _Size = ...,
    camera: Optional[Camera] = None,
    *,
    dtype: Literal["uint8"],
    shadows: bool = False,
    time: float = 0.0,
    animation: Optional[str] = None,
    device: Optional[str] = None,
    max_memory: Optional[int] = None,
    **options: Unpack[_Options],
) -> _CodeImage: ...
@overload
def render(
    scene: _Source,
    size: _Size = ...,
    camera: Optional[Camera] = None,
    *,
    layers: Sequence[str],
    dtype: str = "float32",
    shadows: bool = False,
    time: float = 0.0,
    animation: Optional[str] = None,
    device: Optional[str] = None,
    max_memory: Optional[int] = None,
    **options: Unpack[_Options],
) -> _Layers: ...
@overload
def render(
    scene: _Source,
    size: _Size = ...,
    camera: Optional[Camera] = None,
    *,
    dtype: Literal["float32"] = "float32",
    shadows: bool = False,
    time: float = 0.0,
    animation: Optional[str] = None,
    device: Optional[str] = None,
    max_memory: Optional[int] = None,
    **options: Unpack[_Options],
) -> _FloatImage: ...
def compare(
    reference: Union[str, PathLike[str], _FloatImage, _CodeImage], image: Union[str, PathLike[str], _FloatImage, _CodeImage]
) -> Comparison: ...

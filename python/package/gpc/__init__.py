"""Renders glTF, OBJ, STL and PLY scenes to NumPy arrays.

Images are antialiased only where they alias, with up to 1,024 samples a pixel. Neither a display nor a GPU is needed: Mesa's
software driver serves (Debian and Ubuntu: ``apt-get install libvulkan1 mesa-vulkan-drivers``).

    >>> import gpc
    >>> image = gpc.render("scene.glb", size=(1280, 720))          # float32, (720, 1280, 4)
    >>> codes = gpc.render("scene.glb", size=(1280, 720), dtype="uint8")

A :class:`Renderer` keeps the device and the scene for many images.
"""

from ._native import (
    Camera,
    Comparison,
    DeviceError,
    GpcError,
    Renderer,
    Scene,
    SceneError,
    __version__,
    compare,
    render,
)

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

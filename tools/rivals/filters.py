#!/usr/bin/env python3
"""Compares pixel filters with those of Mitsuba 3, and makes docs/pictures/filter-mitsuba.png.

Run by hand from the root of the repository, in an environment outside of it, since the project needs none of this:

    python -m venv /tmp/venv && /tmp/venv/bin/pip install mitsuba trimesh networkx pillow
    /tmp/venv/bin/python tools/rivals/filters.py target/release/gpc

The scene is a rope of three strands and a wire, which both programs read from one PLY file. The picture shows its coverage,
enlarged: above by Mitsuba with 4,096 samples a pixel, below by superpixels with 64 samples. From left to right: box, tent, Gaussian,
Mitchell. The root of the mean square of the difference is printed for each filter.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import mitsuba as mi
import numpy as np
import trimesh
from PIL import Image

mi.set_variant("scalar_rgb")

SIZE = (64, 48)
FOV = 30.0
FILTERS = ("box", "tent", "gaussian", "mitchell")
ENLARGED = 4
EYE, TARGET = np.array([0.0, 0.0, 8.0]), np.zeros(3)


def tube(path: np.ndarray, radius: float) -> trimesh.Trimesh:
    """A tube of eight sides along a path."""
    tangents = np.gradient(path, axis=0)
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    across = np.cross(tangents, [0.0, 0.0, 1.0])
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    up = np.cross(across, tangents)
    sides, count = 8, len(path)
    angles = 2 * np.pi * np.arange(sides) / sides
    ring = np.cos(angles)[None, :, None] * across[:, None, :] + np.sin(angles)[None, :, None] * up[:, None, :]
    vertices = (path[:, None, :] + radius * ring).reshape(-1, 3)
    faces = []
    for i in range(count - 1):
        for side in range(sides):
            a, b = i * sides + side, i * sides + (side + 1) % sides
            faces += [[a, b, a + sides], [b, b + sides, a + sides]]
    return trimesh.Trimesh(vertices, faces, process=False)


def scene() -> trimesh.Trimesh:
    along = np.linspace(-3.0, 3.0, 600)
    strands = []
    for strand in range(3):
        angle = 9.0 * along + 2 * np.pi * strand / 3
        height = 0.8 + 0.1 * along
        strands.append(tube(np.stack([along, height + 0.09 * np.cos(angle), 0.09 * np.sin(angle)], axis=1), 0.03))
    sagging = np.stack([along, -0.9 + 0.11 * along**2, np.zeros_like(along)], axis=1)
    return trimesh.util.concatenate([*strands, tube(sagging, 0.018)])


def by_mitsuba(ply: Path, name: str) -> np.ndarray:
    film = {
        "type": "hdrfilm",
        "width": SIZE[0],
        "height": SIZE[1],
        "pixel_format": "rgba",
        "component_format": "float32",
        "rfilter": {"type": name},
    }
    sensor = {
        "type": "perspective",
        "fov": FOV,
        "fov_axis": "y",
        "to_world": mi.ScalarTransform4f().look_at(origin=list(EYE), target=list(TARGET), up=[0, 1, 0]),
        "film": film,
        "sampler": {"type": "multijitter", "sample_count": 4096},
    }
    loaded = mi.load_dict(
        {"type": "scene", "integrator": {"type": "depth"}, "sensor": sensor, "mesh": {"type": "ply", "filename": str(ply)}}
    )
    return np.array(mi.render(loaded, spp=4096, seed=1), dtype=np.float64)[:, :, 3].clip(0, 1)


def by_gpc(gpc: str, folder: Path, ply: Path, name: str) -> np.ndarray:
    out = folder / "out.exr"
    eye, target = (",".join(map(str, place)) for place in (EYE, TARGET))
    command = [gpc, "render", ply, "-o", out, "--size", f"{SIZE[0]}x{SIZE[1]}", "--filter", name, "--fov", str(FOV)]
    subprocess.run([*command, f"--eye={eye}", f"--target={target}"], check=True, capture_output=True)
    return np.array(mi.Bitmap(str(out)), dtype=np.float64)[:, :, 3]


def enlarged(alpha: np.ndarray) -> np.ndarray:
    srgb = np.where(alpha <= 0.0031308, 12.92 * alpha, 1.055 * alpha ** (1 / 2.4) - 0.055)
    codes = np.round(255 * srgb).astype(np.uint8)
    large = np.kron(codes, np.ones((ENLARGED, ENLARGED), np.uint8))
    return np.pad(large, 2, constant_values=255)


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        ply = folder / "rope.ply"
        scene().export(ply)
        rows = [], []
        for pixel_filter in FILTERS:
            pair = by_mitsuba(ply, pixel_filter), by_gpc(sys.argv[1], folder, ply, pixel_filter)
            print(f"{pixel_filter}: {np.sqrt(np.mean((pair[0] - pair[1]) ** 2)):.4f}")
            for row, alpha in zip(rows, pair):
                row.append(enlarged(alpha))
        picture = np.vstack([np.hstack(row) for row in rows])
        Image.fromarray(picture).save("docs/pictures/filter-mitsuba.png", optimize=True)


if __name__ == "__main__":
    main()

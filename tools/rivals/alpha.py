#!/usr/bin/env python3
"""Compares alpha, which is coverage, with Mitsuba 3: an independent truth for where edges are.

Run by hand from the root of the repository, in an environment outside of it, since the project needs none of this:

    python -m venv /tmp/venv && /tmp/venv/bin/pip install mitsuba trimesh networkx pillow
    /tmp/venv/bin/python tools/rivals/alpha.py target/release/gpc >docs/bench/alpha-lavapipe-22.3.csv

Each scene becomes one PLY file, which both programs read, so that neither materials nor textures matter. The truth is the mean of
two images of Mitsuba with 4,096 stratified samples a pixel each (`multijitter`) and a box filter. Half of the difference of these
images says how far the truth is off; it is the row `truth`. The rows `mitsuba` have the sampler `independent`, whose samples are
random.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import mitsuba as mi
import numpy as np
import trimesh

from head import head

mi.set_variant("scalar_rgb")

SIZE = (320, 180)
FOV = 35.0
SAMPLES = (64, 256, 1024)
TRUTH = 4096
SHARED = Path("../shared/scenes")
SCENES = {
    "letters": Path("assets/letters.glb"),
    "fence": Path("assets/fence.glb"),
    "DeskFanAnimated": SHARED / "DeskFanAnimated/vintageFan_animated.gltf",
    "DutchShip": SHARED / "DutchShip/dutch_ship_medium_1k.gltf",
    "LowpolyCity": SHARED / "LowpolyCity/scene.gltf",
}


def by_mitsuba(ply: Path, eye, target, sampler: str, samples: int, seed: int) -> np.ndarray:
    scene = mi.load_dict(
        {
            "type": "scene",
            "integrator": {"type": "depth"},
            "sensor": {
                "type": "perspective",
                "fov": FOV,
                "fov_axis": "y",
                "near_clip": 1e-3 * float(np.linalg.norm(eye - target)),
                "far_clip": 1e3 * float(np.linalg.norm(eye - target)),
                "to_world": mi.ScalarTransform4f().look_at(origin=list(eye), target=list(target), up=[0, 1, 0]),
                "film": {
                    "type": "hdrfilm",
                    "width": SIZE[0],
                    "height": SIZE[1],
                    "pixel_format": "rgba",
                    "component_format": "float32",
                    "rfilter": {"type": "box"},
                },
                "sampler": {"type": sampler, "sample_count": samples},
            },
            "mesh": {"type": "ply", "filename": str(ply)},
        }
    )
    return np.array(mi.render(scene, spp=samples, seed=seed), dtype=np.float64)[:, :, 3]


def by_gpc(gpc: str, folder: Path, ply: Path, eye, target, method: str, samples: int) -> np.ndarray:
    out = folder / "out.exr"
    eye, target = (",".join(f"{x:.9g}" for x in place) for place in (eye, target))
    command = [gpc, "render", ply, "-o", out, "--size", f"{SIZE[0]}x{SIZE[1]}", "--aa", method, "--samples", str(samples)]
    command += [f"--eye={eye}", f"--target={target}", "--fov", str(FOV)]
    subprocess.run(command, check=True, capture_output=True)
    return np.array(mi.Bitmap(str(out)), dtype=np.float64)[:, :, 3]


def main() -> None:
    gpc = sys.argv[1]
    print(head([gpc], SIZE))
    print(f"# mitsuba: {mi.__version__}, {mi.variant()}")
    print("scene,renderer,samples,edge_pixels,rmse,largest", flush=True)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for scene, path in SCENES.items():
            mesh = trimesh.load(path, force="scene").to_geometry()
            ply = folder / f"{scene}.ply"
            trimesh.Trimesh(mesh.vertices, mesh.faces, process=False).export(ply, vertex_normal=False)
            low, high = mesh.bounds
            target = (low + high) / 2
            eye = target + np.array([0.5, 0.35, 0.8]) * np.linalg.norm(high - low)
            truths = [by_mitsuba(ply, eye, target, "multijitter", TRUTH, seed) for seed in (1, 2)]
            truth = (truths[0] + truths[1]) / 2
            edges = int(((truth > 0) & (truth < 1)).sum())

            def row(renderer: str, samples: int, alpha: np.ndarray) -> None:
                error = alpha - truth
                rmse = np.sqrt((error**2).mean())
                print(f"{scene},{renderer},{samples},{edges},{rmse:.3e},{np.abs(error).max():.5f}", flush=True)

            for samples in SAMPLES:
                for method in ("superpixel", "ssaa"):
                    row(method, samples, by_gpc(gpc, folder, ply, eye, target, method, samples))
                row("mitsuba", samples, by_mitsuba(ply, eye, target, "independent", samples, 3))
            row("truth", 2 * TRUTH, truths[0])


if __name__ == "__main__":
    main()

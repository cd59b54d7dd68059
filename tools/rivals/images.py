#!/usr/bin/env python3
"""Measures images a second of data sets: gpc, pyrender and F3D on the same machine, from the same cameras.

Run by hand from the root of the repository, in an environment outside of it, since the project needs none of this:

    python -m venv /tmp/venv && /tmp/venv/bin/pip install pyrender f3d 'numpy<2' out/wheel/gpc_render-*.whl
    /tmp/venv/bin/python tools/rivals/images.py SCENE... >docs/bench/python-lavapipe-22.3.csv

Each image is a uint8 array in memory; nothing is written. Loading is left out, and so is the first image. pyrender and F3D draw
by OpenGL of Mesa's software driver, through EGL. Each renderer runs in a process of its own, by turns, and the best of three runs
counts.
"""

import argparse
import json
import math
import os
import subprocess
import sys
import time
from importlib import metadata
from pathlib import Path

import numpy as np

from head import head

SIZE = (320, 240)
FOV = 35.0
PACKAGES = {"pyrender": "pyrender", "F3D": "f3d"}
KINDS = {
    "gpc, one sample": {"method": "none"},
    "gpc, 16 samples": {"samples": 16},
    "gpc, 64 samples": {"samples": 64},
    "pyrender, MSAA 4": {},
    "F3D, no antialiasing": {"aa": "none"},
    "F3D, SSAA": {"aa": "ssaa"},
}


def cameras(scene: Path, views: int) -> list:
    """Eyes around the scene's bounds, with the bounds' middle."""
    import trimesh

    low, high = np.asarray(trimesh.load(scene, force="scene").bounds, dtype=float)
    middle, radius = (low + high) / 2, float(np.linalg.norm(high - low)) / 2
    distance = radius / math.sin(math.radians(FOV) / 2)
    random = np.random.default_rng(1)
    eyes = []
    for _ in range(views):
        azimuth, height = random.uniform(0.0, 2 * math.pi), random.uniform(-0.2, 1.0)
        across = math.sqrt(1 - height * height)
        eyes.append(middle + distance * np.array([math.sin(azimuth) * across, height, math.cos(azimuth) * across]))
    return [(eye, middle, radius) for eye in eyes]


def by_gpc(scene: Path, options: dict):
    import gpc

    renderer = gpc.Renderer(scene)
    return lambda eye, middle, _: renderer.render(
        gpc.Camera.look_at(list(eye), list(middle), fov=FOV), SIZE, dtype="uint8", **options
    )


def by_pyrender(scene: Path, _: dict):
    os.environ["PYOPENGL_PLATFORM"] = "egl"
    import pyrender
    import trimesh

    stage = pyrender.Scene.from_trimesh_scene(trimesh.load(scene, force="scene"), bg_color=[0, 0, 0, 0])
    camera = pyrender.PerspectiveCamera(yfov=math.radians(FOV))
    eye_node = stage.add(camera)
    light_node = stage.add(pyrender.DirectionalLight(intensity=3.0))
    renderer = pyrender.OffscreenRenderer(*SIZE)

    def render(eye, middle, radius):
        back = (eye - middle) / np.linalg.norm(eye - middle)
        right = np.cross([0.0, 1.0, 0.0], back)
        right /= np.linalg.norm(right)
        pose = np.eye(4)
        pose[:3, 0], pose[:3, 1], pose[:3, 2], pose[:3, 3] = right, np.cross(back, right), back, eye
        camera.znear, camera.zfar = 0.05 * radius, 20 * radius
        stage.set_pose(eye_node, pose)
        stage.set_pose(light_node, pose)
        return renderer.render(stage, flags=pyrender.RenderFlags.RGBA)[0]

    return render


def by_f3d(scene: Path, options: dict):
    import f3d

    f3d.Log.set_verbose_level(f3d.Log.QUIET)
    engine = f3d.Engine.create_egl()
    engine.window.size = SIZE
    engine.scene.add(str(scene))
    engine.options["render.effect.antialiasing.mode"] = options["aa"]

    def render(eye, middle, _):
        camera = engine.window.camera
        camera.position, camera.focal_point, camera.view_up = tuple(eye), tuple(middle), (0.0, 1.0, 0.0)
        camera.view_angle = FOV
        image = engine.window.render_to_image(True)
        return np.frombuffer(image.content, np.uint8).reshape(image.height, image.width, image.channel_count)

    return render


def run(scene: Path, kind: str, views: int) -> dict:
    """Renders in this process."""
    name = kind.split(",")[0]
    render = {"gpc": by_gpc, "pyrender": by_pyrender, "F3D": by_f3d}[name](scene, KINDS[kind])
    places = cameras(scene, views)
    shown = [render(*place) for place in places[:3]]
    if not all(image.shape[:2] == SIZE[::-1] and image.std() > 1 for image in shown):
        sys.exit(f"{kind}: an image of {scene} shows nothing, or has the wrong size")
    start = time.perf_counter()
    for place in places:
        render(*place)
    return {"seconds": time.perf_counter() - start}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", type=Path, nargs="+")
    parser.add_argument("--views", type=int, default=200)
    parser.add_argument("--kind", choices=KINDS, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.kind:
        print(json.dumps(run(arguments.scenes[0], arguments.kind, arguments.views)))
        return
    print(head([sys.executable, "-m", "gpc"], SIZE))
    versions = [f"{name} {metadata.version(package)}" for name, package in PACKAGES.items()]
    print(f"# versions: {', '.join(versions)}")
    print(f"# views: {arguments.views}")
    print("scene,renderer,images_per_second", flush=True)
    for scene in arguments.scenes:
        seconds: dict = {kind: [] for kind in KINDS}
        for _ in range(3):
            for kind, found in seconds.items():
                command = [sys.executable, __file__, str(scene), "--kind", kind, "--views", str(arguments.views)]
                done = subprocess.run(command, check=True, capture_output=True, text=True)
                found.append(json.loads(done.stdout.splitlines()[-1])["seconds"])
        name = scene.parent.name if scene.stem in ("scene", "garage") else scene.stem
        for kind, found in seconds.items():
            print(f'{name},"{kind}",{arguments.views / min(found):.2f}', flush=True)


if __name__ == "__main__":
    main()

"""Renders many views on the workers of a Dask cluster, one device each. Files that exist are left out, so the command may be
started again after a failure.

    python workers.py scene.glb out --views 10000 --scheduler tcp://host:8786
"""

import argparse
from functools import lru_cache
from pathlib import Path

from dask.distributed import Client, as_completed
from PIL import Image

import gpc


@lru_cache(maxsize=1)
def renderer(scene: str) -> gpc.Renderer:
    """The worker's device with the scene, which stays for the next view."""
    return gpc.Renderer(scene)


def render(scene: str, out: str, azimuth: float, size: "tuple[int, int]") -> str:
    """Renders one view into a file that is whole or not there."""
    path = Path(out)
    part = path.with_suffix(".part")
    with part.open("wb") as file:
        Image.fromarray(renderer(scene).render(gpc.Camera.orbit(azimuth), size, dtype="uint8")).save(file, "png")
    part.replace(path)
    return out


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scene", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--views", type=int, default=10000)
    parser.add_argument("--size", type=int, nargs=2, default=(320, 240))
    parser.add_argument("--scheduler", help="address of a scheduler; without it, two local workers")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    views = {arguments.out / f"{view:06}.png": 360.0 * view / arguments.views for view in range(arguments.views)}
    missing = {str(path.absolute()): azimuth for path, azimuth in views.items() if not path.exists()}
    print(f"{len(missing)} of {len(views)} views are missing")
    with Client(arguments.scheduler) if arguments.scheduler else Client(n_workers=2, threads_per_worker=1) as client:
        scene, size = str(arguments.scene.absolute()), tuple(arguments.size)
        futures = [client.submit(render, scene, out, azimuth, size) for out, azimuth in missing.items()]
        for future in as_completed(futures):
            future.result()


if __name__ == "__main__":
    main()

"""Renders a data set: views of a scene from random directions, with depth, triangle IDs and the camera of each.

    python dataset.py scene.glb out --views 1000
"""

import argparse
import json
from pathlib import Path

import numpy as np
from PIL import Image

import gpc


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scene", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--views", type=int, default=1000)
    parser.add_argument("--size", type=int, nargs=2, default=(320, 240))
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    renderer = gpc.Renderer(arguments.scene)
    random = np.random.default_rng(1)
    for index in range(arguments.views):
        # Heights are even, so that directions are evenly spread over the sphere.
        view = {"azimuth": random.uniform(0.0, 360.0), "elevation": float(np.degrees(np.arcsin(random.uniform(-0.2, 1.0))))}
        image = renderer.render(gpc.Camera.orbit(**view), tuple(arguments.size), layers=["depth", "id"], dtype="uint8")
        name = arguments.out / f"{index:06}"
        Image.fromarray(image["color"]).save(name.with_suffix(".png"))
        np.savez_compressed(name.with_suffix(".npz"), depth=image["depth"], id=image["id"])
        name.with_suffix(".json").write_text(json.dumps(view))


if __name__ == "__main__":
    main()

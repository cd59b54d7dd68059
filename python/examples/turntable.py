"""Renders a turntable as an animation.

    python turntable.py scene.glb turn.webp --frames 60
"""

import argparse
from pathlib import Path

import numpy as np
from PIL import Image

import gpc


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scene", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--frames", type=int, default=60)
    parser.add_argument("--size", type=int, nargs=2, default=(640, 360))
    arguments = parser.parse_args()
    cameras = [gpc.Camera.orbit(azimuth) for azimuth in np.linspace(0.0, 360.0, arguments.frames, endpoint=False)]
    frames = gpc.Renderer(arguments.scene).render_views(
        cameras,
        tuple(arguments.size),
        background=(1.0, 1.0, 1.0),
        dtype="uint8",
        progress=lambda done, total: print(f"\r{done} of {total}", end="", flush=True),
    )
    print()
    first, *others = [Image.fromarray(frame[..., :3]) for frame in frames]
    first.save(arguments.out, save_all=True, append_images=others, duration=33, loop=0)


if __name__ == "__main__":
    main()

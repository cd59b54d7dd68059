"""Renders a scene through a calibrated lens: each pixel is sampled where the lens really looks, and nothing is resampled.

The camera is OpenCV's: intrinsics, and distortion coefficients as cv2.calibrateCamera gives them. Superpixels follow the
distortion, so edges are as smooth at the rim as in the middle.

    python lens.py scene.glb out.png
"""

import argparse
from pathlib import Path

import cv2
import numpy as np
import numpy.typing as npt
from PIL import Image

import gpc

Places = npt.NDArray[np.float64]

WIDTH, HEIGHT = SIZE = (640, 480)
INTRINSICS = np.array([[500.0, 0.0, 321.5], [0.0, 502.0, 238.0], [0.0, 0.0, 1.0]])
DISTORTION = np.array([-0.28, 0.09, 0.001, -0.0005, -0.01])


def distort(plain: Places) -> Places:
    """Pixels at which the lens shows places of the undistorted plane."""
    rays = np.concatenate([(plain - INTRINSICS[:2, 2]) / np.diag(INTRINSICS)[:2], np.ones((len(plain), 1))], axis=1)
    shown = cv2.projectPoints(rays, np.zeros(3), np.zeros(3), INTRINSICS, DISTORTION)[0]
    return np.asarray(shown, dtype=np.float64).reshape(-1, 2)


def locations() -> Places:
    """Place on the undistorted plane of each pixel, counted from the plane's upper left corner."""
    columns, rows = np.meshgrid(np.arange(WIDTH, dtype=np.float64), np.arange(HEIGHT, dtype=np.float64))
    pixels = np.stack([columns, rows], axis=-1).reshape(-1, 2)
    plain = np.asarray(cv2.undistortPoints(pixels, INTRINSICS, DISTORTION, P=INTRINSICS), np.float64).reshape(-1, 2)
    for _ in range(20):  # OpenCV's five steps leave errors of some pixels in the corners.
        plain = plain + pixels - distort(plain)
    # OpenCV counts from the centre of the first pixel.
    return plain.reshape(HEIGHT, WIDTH, 2) + 0.5


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scene", type=Path)
    parser.add_argument("out", type=Path)
    arguments = parser.parse_args()
    scene = gpc.Scene.load(arguments.scene)
    low, high = np.array(scene.bounds)
    # Looks along -z at the middle of the scene: OpenCV's camera has y down and z forward.
    world_to_camera = np.diag([1.0, -1.0, -1.0, 1.0])
    eye = 0.5 * (low + high) + [0.0, 0.0, 0.9 * np.linalg.norm(high - low)]
    world_to_camera[:3, 3] = -world_to_camera[:3, :3] @ eye
    camera = gpc.Camera.from_intrinsics(INTRINSICS, world_to_camera)
    image = gpc.Renderer(scene).sample(locations(), SIZE, camera, background=(0.4, 0.5, 0.6), dtype="uint8")
    Image.fromarray(image).save(arguments.out)


if __name__ == "__main__":
    main()

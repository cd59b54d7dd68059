"""Images, cameras and locations."""

import os
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import gpc

from conftest import ASSETS

SIZE = (160, 90)


def test_an_image_is_that_of_the_command(letters: Path, tmp_path: Path) -> None:
    out = tmp_path / "out.png"
    command = [sys.executable, "-m", "gpc", "render", str(letters), "--size", "160x90", "-o", str(out)]
    subprocess.run(command, check=True, capture_output=True)
    codes = gpc.render(letters, size=SIZE, dtype="uint8")
    assert codes.shape == (90, 160, 4) and codes.dtype == np.uint8
    assert gpc.compare(out, codes).max == 0.0


def test_light_and_codes_show_the_same(renderer: gpc.Renderer) -> None:
    light = renderer.render(size=SIZE, background=(0.2, 0.3, 0.4))
    assert light.shape == (90, 160, 4) and light.dtype == np.float32
    codes = renderer.render(size=SIZE, background=(0.2, 0.3, 0.4), dtype="uint8")
    assert gpc.compare(light, codes).max <= 0.5001 / 255


def test_layers(renderer: gpc.Renderer) -> None:
    names = ["depth", "id", "normal", "samples", "superpixel"]
    layers = renderer.render(size=SIZE, layers=names)
    assert list(layers) == ["color", *names]
    shown = layers["id"] > 0
    assert 0.01 < shown.mean() < 0.9
    assert np.all(layers["depth"][shown] > 0.0) and np.all(layers["depth"][~shown] == 0.0)
    assert np.allclose(np.linalg.norm(layers["normal"][shown], axis=-1), 1.0, atol=1e-3)
    assert np.all(layers["samples"][layers["superpixel"]] == 64) and np.all(layers["samples"][~layers["superpixel"]] == 1)


def test_filters(renderer: gpc.Renderer) -> None:
    sharp = renderer.render(size=SIZE)
    soft = renderer.render(size=SIZE, filter="gaussian")
    softer = renderer.render(size=SIZE, filter="gaussian", filter_radius=2.5)
    steps = [float(np.abs(np.diff(image[..., 3], axis=1)).max()) for image in (sharp, soft, softer)]
    assert steps[0] > steps[1] > steps[2]
    with pytest.raises(ValueError, match="radius must be from 0.5 to 2.5"):
        renderer.render(size=SIZE, filter="tent", filter_radius=4.0)


def test_a_region_is_a_part_of_the_image(renderer: gpc.Renderer) -> None:
    whole = renderer.render(size=SIZE)
    assert np.array_equal(whole[20:60, 30:100], renderer.render(size=SIZE, region=(30, 20, 70, 40)))


def test_views_are_the_single_images(renderer: gpc.Renderer) -> None:
    cameras = [gpc.Camera.orbit(azimuth=azimuth) for azimuth in (0.0, 40.0, 80.0)]
    calls: list[tuple[int, int]] = []
    views = renderer.render_views(cameras, SIZE, progress=lambda done, total: calls.append((done, total)), dtype="uint8")
    assert views.shape == (3, 90, 160, 4) and calls == [(1, 3), (2, 3), (3, 3)]
    for camera, view in zip(cameras, views):
        assert np.array_equal(view, renderer.render(camera, SIZE, dtype="uint8"))


def test_cameras_that_describe_the_same_view_agree(renderer: gpc.Renderer) -> None:
    """The same view as eye and target, as OpenGL's matrix and as OpenCV's, whose first pixel's centre is (0, 0)."""
    eye, near, fov = np.array([0.5, 1.0, 6.0]), 0.01, 50.0
    back = (eye - np.array([0.0, 0.5, 0.0])) / np.linalg.norm(eye - np.array([0.0, 0.5, 0.0]))
    right = np.cross([0.0, 1.0, 0.0], back)
    right /= np.linalg.norm(right)
    pose = np.eye(4)
    pose[:3, :3] = np.stack([right, np.cross(back, right), back], axis=1)
    pose[:3, 3] = eye
    width, height = SIZE
    focal = 0.5 * height / np.tan(0.5 * np.radians(fov))
    matrix = np.array([[focal, 0.0, 0.5 * width - 0.5], [0.0, focal, 0.5 * height - 0.5], [0.0, 0.0, 1.0]])
    to_camera = np.diag([1.0, -1.0, -1.0, 1.0]) @ np.linalg.inv(pose)
    cameras = [
        gpc.Camera.look_at(eye, [0.0, 0.5, 0.0], fov=fov, near=near),
        gpc.Camera.from_pose(pose, fov=fov, near=near),
        gpc.Camera.from_intrinsics(matrix, to_camera, near=near),
    ]
    first, *others = [renderer.render(camera, SIZE) for camera in cameras]
    assert first[..., 3].max() == 1.0
    for other in others:
        assert gpc.compare(first, other).psnr > 60.0
    # Pixels that are not square: the same directions are found at half the height.
    flat = matrix * np.array([[1.0], [0.5], [1.0]])
    flat[1, 2] = 0.25 * height - 0.5
    squeezed = renderer.render(gpc.Camera.from_intrinsics(flat, to_camera, near=near), (width, height // 2), background=(0, 0, 0))
    halved = renderer.render(cameras[0], (width, 2 * (height // 2)), background=(0, 0, 0)).reshape(height // 2, 2, width, 4).mean(axis=1)
    assert gpc.compare(halved, squeezed).psnr > 25.0


def test_locations_at_pixel_centres_are_the_image(renderer: gpc.Renderer) -> None:
    width, height = SIZE
    u, v = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    locations = np.stack([u, v], axis=-1)
    image = renderer.render(size=SIZE, background=(0.2, 0.3, 0.4))
    sampled = renderer.sample(locations, SIZE, background=(0.2, 0.3, 0.4))
    assert gpc.compare(image, sampled).psnr > 45.0
    listed = renderer.sample(locations[40, 60:100], SIZE, background=(0.2, 0.3, 0.4))
    assert listed.shape == (40, 4)
    assert np.abs(listed - image[40, 60:100]).max() < 0.1
    locations[:, :80] = np.nan
    assert np.all(renderer.sample(locations, SIZE)[:, :79] == 0.0)


def test_zooms_and_panoramas(renderer: gpc.Renderer) -> None:
    zoomed = renderer.zoom((80, 45), 20, 3.0, size=SIZE)
    assert zoomed.shape == (90, 160, 4) and not np.array_equal(zoomed, renderer.render(size=SIZE))
    around = renderer.panorama("equirectangular", (128, 64), dtype="uint8")
    assert around.shape == (64, 128, 4) and around[..., 3].any()


def test_shadows_darken(letters: Path) -> None:
    lit, shadowed = (gpc.render(letters, size=SIZE, shadows=shadows)[..., :3].mean() for shadows in (False, True))
    assert shadowed < lit


def test_impossible_requests_name_what_was_asked(renderer: gpc.Renderer) -> None:
    with pytest.raises(ValueError, match="2000"):
        renderer.render(size=SIZE, samples=2000)
    with pytest.raises(ValueError, match="superpixel, ssaa"):
        renderer.render(size=SIZE, method="best")  # type: ignore[call-overload]
    with pytest.raises(TypeError, match="sampels"):
        renderer.render(size=SIZE, sampels=4)  # type: ignore[call-overload]
    with pytest.raises(ValueError, match="float32"):
        renderer.render(size=SIZE, dtype="float64")  # type: ignore[call-overload]
    with pytest.raises(ValueError, match="depth"):
        renderer.render(size=SIZE, layers=["dept"])
    with pytest.raises(ValueError, match="no camera"):
        renderer.render(gpc.Camera.of_scene("main"), SIZE)
    with pytest.raises(gpc.DeviceError, match="no such device"):
        gpc.Renderer(ASSETS / "letters.glb", device="no such device")


def test_other_threads_run_while_the_device_works(renderer: gpc.Renderer) -> None:
    done = threading.Event()
    counted = 0

    def render() -> None:
        renderer.render(size=(960, 540), samples=256)
        done.set()

    thread = threading.Thread(target=render)
    thread.start()
    while not done.is_set():
        counted += 1
        time.sleep(0.001)
    thread.join()
    assert counted > 3


def test_a_signal_stops_the_work(letters: Path) -> None:
    script = f"""
import gpc, os, signal, threading
renderer = gpc.Renderer({str(letters)!r})
renderer.render(size=(64, 64))
threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
try:
    while True:
        renderer.render_views([gpc.Camera.orbit()] * 1000, (64, 64))
except KeyboardInterrupt:
    print("stopped", renderer.render(size=(64, 64)).shape)
"""
    ended = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=300)
    assert ended.stdout.strip() == "stopped (64, 64, 4)", ended.stderr


def test_no_driver_says_what_to_install(letters: Path) -> None:
    script = f"import gpc\ntry:\n    gpc.Renderer({str(letters)!r})\nexcept gpc.DeviceError as error:\n    print(error)\n"
    environment = {**os.environ, "VK_ICD_FILENAMES": "/nowhere.json", "VK_DRIVER_FILES": "/nowhere.json"}
    ended = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, env=environment)
    assert "mesa-vulkan-drivers" in ended.stdout, ended.stdout + ended.stderr


def test_validation_has_nothing_to_say(renderer: gpc.Renderer) -> None:
    assert renderer.validation_messages == []

"""Scenes from files, bytes, arrays and trimesh, and comparisons."""

from pathlib import Path

import numpy as np
import pytest

import gpc

QUAD = np.array([[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]])
FACES = np.array([[0, 1, 2], [0, 2, 3]])
FRONT = gpc.Camera.look_at([0.0, 0.0, 4.0], [0.0, 0.0, 0.0], fov=40.0)


def test_files_and_bytes_are_the_same_scene(letters: Path) -> None:
    loaded = gpc.Scene.load(letters)
    assert loaded.warnings == [] and loaded.triangles > 100 and loaded.bounds is not None
    of_bytes = gpc.Scene.from_bytes(letters.read_bytes())
    assert np.array_equal(gpc.render(loaded, size=(96, 54)), gpc.render(of_bytes, size=(96, 54)))


def test_a_file_that_is_none(tmp_path: Path) -> None:
    with pytest.raises(gpc.SceneError, match="missing.glb"):
        gpc.Scene.load(tmp_path / "missing.glb")
    (tmp_path / "broken.glb").write_bytes(b"glTF\2\0\0\0")
    with pytest.raises(gpc.SceneError, match="broken.glb"):
        gpc.render(tmp_path / "broken.glb")


def test_arrays_make_a_textured_quad() -> None:
    uvs = np.array([[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]])
    texture = np.zeros((32, 32, 3), np.uint8)
    texture[:16, :16] = (255, 0, 0)
    texture[16:, 16:] = (0, 0, 255)
    scene = gpc.Scene.from_arrays(QUAD, FACES, uvs=uvs, texture=texture, unlit=True)
    assert scene.triangles == 2
    codes = gpc.render(scene, size=(64, 64), camera=FRONT, dtype="uint8")
    # The tone curve mixes a little of each channel into the others.
    upper_left, lower_right = codes[18, 18].astype(int), codes[46, 46].astype(int)
    assert upper_left[0] > upper_left[2] + 100 and lower_right[2] > lower_right[0] + 100, (upper_left, lower_right)


def test_colours_of_vertices_and_opacity() -> None:
    colors = np.tile([0.0, 1.0, 0.0, 0.5], (4, 1))
    image = gpc.render(gpc.Scene.from_arrays(QUAD, FACES, colors=colors, unlit=True), size=(64, 64), camera=FRONT)
    red, green, _, alpha = image[32, 32]
    assert alpha == pytest.approx(0.5, abs=1e-3) and green > 0.3 and red < 0.02


def test_large_coordinates_lose_nothing() -> None:
    far = np.array([461234.0, 5428765.0, 321.0])
    camera = gpc.Camera.look_at(far + [0.0, 0.0, 4.0], far, fov=40.0)
    near = gpc.render(gpc.Scene.from_arrays(0.01 * QUAD + [0.3, 0.2, 0.0], FACES), size=(64, 64), camera=gpc.Camera.orbit(0, 0))
    there = gpc.render(gpc.Scene.from_arrays(0.01 * QUAD + far, FACES), size=(64, 64), camera=gpc.Camera.orbit(0, 0))
    assert gpc.compare(near, there).psnr > 50.0
    assert gpc.render(gpc.Scene.from_arrays(QUAD + far, FACES), size=(64, 64), camera=camera)[32, 32, 3] == 1.0


def test_broken_arrays_name_the_row() -> None:
    with pytest.raises(ValueError, match=r"face 1 has vertex 9"):
        gpc.Scene.from_arrays(QUAD, [[0, 1, 2], [0, 2, 9]])
    with pytest.raises(ValueError, match=r"\(N, 3\)"):
        gpc.Scene.from_arrays(QUAD[:, :2], FACES)
    with pytest.raises(ValueError, match="row 2"):
        gpc.Scene.from_arrays(np.where(np.arange(12).reshape(4, 3) == 7, np.nan, QUAD), FACES)
    with pytest.raises(ValueError, match="normals has 3 rows"):
        gpc.Scene.from_arrays(QUAD, FACES, normals=QUAD[:3])


def test_objects_of_trimesh() -> None:
    trimesh = pytest.importorskip("trimesh")
    image = gpc.render(trimesh.creation.icosphere(), size=(64, 64))
    assert image[32, 32, 3] == 1.0 and image[0, 0, 3] == 0.0


def test_comparisons(tmp_path: Path) -> None:
    image = np.full((8, 8, 3), 100, np.uint8)
    other = image.copy()
    other[0, 0] = 110
    found = gpc.compare(image, other)
    assert found.max == pytest.approx(10 / 255, abs=1e-6) and found.over_8 == 1 and found.flip > 0.0
    assert found.rmse == pytest.approx(10 / 255 / 8, rel=1e-4)
    assert gpc.compare(image, image).psnr == float("inf")
    with pytest.raises(ValueError, match="8 x 8 and 4 x 8"):
        gpc.compare(image, image[:, :4])
    with pytest.raises(ValueError, match="height, width"):
        gpc.compare(image[..., :2], image)

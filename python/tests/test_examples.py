"""The examples, at small sizes."""

import subprocess
import sys
from pathlib import Path

import numpy as np
from PIL import Image

import gpc

EXAMPLES = Path(__file__).parents[1] / "examples"


def run(name: str, *arguments: object) -> str:
    command = [sys.executable, str(EXAMPLES / name), *map(str, arguments)]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def test_a_data_set(letters: Path, tmp_path: Path) -> None:
    run("dataset.py", letters, tmp_path, "--views", 3, "--size", 64, 48)
    assert len(list(tmp_path.glob("*.png"))) == 3
    stored = np.load(tmp_path / "000002.npz")
    color = np.asarray(Image.open(tmp_path / "000002.png"))
    assert stored["id"].shape == (48, 64) and np.all(color[stored["id"] > 0, 3] > 0)


def test_a_turntable(letters: Path, tmp_path: Path) -> None:
    run("turntable.py", letters, tmp_path / "turn.webp", "--frames", 4, "--size", 64, 48)
    with Image.open(tmp_path / "turn.webp") as film:
        assert film.size == (64, 48) and film.n_frames == 4  # type: ignore[attr-defined]


def test_a_lens_bends_as_opencv_says(letters: Path, tmp_path: Path) -> None:
    sys.path.insert(0, str(EXAMPLES))
    import lens

    run("lens.py", letters, tmp_path / "lens.png")
    bent = np.asarray(Image.open(tmp_path / "lens.png"))
    rows, columns = np.array([0, 479, 100]), np.array([0, 639, 320])
    shown = lens.distort(lens.locations()[rows, columns] - 0.5)
    assert np.abs(shown - np.stack([columns, rows], axis=-1)).max() < 1e-3
    assert bent.shape == (480, 640, 4) and len(np.unique(bent.reshape(-1, 4), axis=0)) > 100


def test_two_workers_render_what_is_missing(letters: Path, tmp_path: Path) -> None:
    arguments = [letters, tmp_path, "--views", 6, "--size", 64, 48]
    assert run("workers.py", *arguments).startswith("6 of 6")
    first = (tmp_path / "000001.png").read_bytes()
    (tmp_path / "000001.png").unlink()
    assert run("workers.py", *arguments).startswith("1 of 6")
    assert (tmp_path / "000001.png").read_bytes() == first
    expected = gpc.render(letters, (64, 48), gpc.Camera.orbit(60.0), dtype="uint8")
    assert np.array_equal(np.asarray(Image.open(tmp_path / "000001.png")), expected)

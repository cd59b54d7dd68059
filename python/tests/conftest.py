from pathlib import Path

import pytest

import gpc

ASSETS = Path(__file__).parents[2] / "assets"


@pytest.fixture(scope="session")
def letters() -> Path:
    return ASSETS / "letters.glb"


@pytest.fixture(scope="session")
def renderer(letters: Path) -> gpc.Renderer:
    return gpc.Renderer(letters, validation=True)

"""The head of a CSV of measurements, as `gpc bench` writes it."""

import subprocess
import tempfile
from pathlib import Path


def head(gpc: list, size: tuple) -> str:
    """Lines that name driver, machine, date and commit. `gpc` is the command."""
    with tempfile.TemporaryDirectory() as folder:
        options = "--size 16x16 --methods none --samples 1 --reference 256 --repeat 1".split()
        command = [*gpc, "bench", "assets/checker.glb", "--out", folder, *options]
        subprocess.run(command, check=True, capture_output=True)
        lines = (Path(folder) / "results.csv").read_text().splitlines()
    kept = [line for line in lines if line.startswith(("# driver: ", "# machine: ", "# date: "))]
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], check=True, capture_output=True, text=True)
    return "\n".join([f"# commit: {commit.stdout.strip()}", *kept, f"# size: {size[0]}x{size[1]}"])

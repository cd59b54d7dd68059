"""``python -m gpc`` is the command ``gpc``, which the package installs beside Python's own commands."""

import os
import sys
import sysconfig
from pathlib import Path


def main() -> None:
    """Replaces this process by the command."""
    folders = [sysconfig.get_path("scripts"), sysconfig.get_path("scripts", f"{os.name}_user")]
    for folder in folders:
        command = Path(folder) / "gpc"
        if command.is_file():
            os.execv(command, [str(command), *sys.argv[1:]])
    sys.exit(f"the command gpc is in none of {', '.join(folders)}: install the package again, from a wheel of `make wheel`")


if __name__ == "__main__":
    main()

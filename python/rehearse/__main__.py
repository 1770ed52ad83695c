"""The command line: python3 -m rehearse learn pendubot --learner gp-mi."""

from __future__ import annotations

import sys
from pathlib import Path

from ._core import command_line


def share() -> Path:
    """The folder of the page of reports: in the package, or in the build folder that it stands in."""
    package = Path(__file__).resolve().parent
    inside = package / "share"
    return inside if inside.exists() else package.parent.parent / "share" / "rehearse"


def main() -> int:
    return int(command_line(["rehearse", *sys.argv[1:]], str(share())))


if __name__ == "__main__":
    sys.exit(main())

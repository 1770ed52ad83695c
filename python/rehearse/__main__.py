"""The command line: python3 -m rehearse learn pendubot --learner gp-mi."""

from __future__ import annotations

import sys
from pathlib import Path

from ._core import command_line


def share() -> Path:
    """The folder of the page of reports: in the package, or beside it in the build or installation folder."""
    package = Path(__file__).resolve().parent
    places = [package / "share"] + [folder / "share" / "rehearse" for folder in package.parents]
    return next((place for place in places if (place / "report.html").exists()), places[0])


def main() -> int:
    return int(command_line(["rehearse", *sys.argv[1:]], str(share())))


if __name__ == "__main__":
    sys.exit(main())

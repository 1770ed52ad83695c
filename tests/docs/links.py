#!/usr/bin/env python3
"""links.py ROOT: every relative link and #anchor of README.md, CONTRIBUTING.md, CHANGELOG.md and docs/**.md leads somewhere.

Anchors are those that GitHub makes of headings: lower case, spaces are hyphens, punctuation is left out, the second of two equal ones
ends in -1. Every page of docs/ has a place in the menu of mkdocs.yml. Every page begins with a paragraph.
"""
import functools
import pathlib
import re
import sys
import urllib.parse

ROOT = pathlib.Path(sys.argv[1]).resolve()
sys.path.insert(0, str(ROOT / "scripts/docs"))
from page_links import LINK, prose  # noqa: E402


@functools.lru_cache(None)
def anchors(path):
    found = {}
    for line, counts in prose(path.read_text()):
        if counts and (heading := re.match(r"#{1,6} +(.*?) *#*$", line)):
            text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading[1]).replace("`", "").lower()
            slug = re.sub(r"[^\w\- ]", "", text).replace(" ", "-")
            found[slug] = found.get(slug, -1) + 1
            if found[slug]:
                found[f"{slug}-{found[slug]}"] = 0
    return found


def wrong(page):
    for number, (line, counts) in enumerate(prose(page.read_text()), 1):
        for link in LINK.finditer(re.sub(r"`[^`]*`", "", line)) if counts else ():
            target = link[2] + (link[3] or "")
            address = urllib.parse.urlsplit(target)
            if address.scheme or address.netloc:
                continue
            there = page.parent / urllib.parse.unquote(address.path) if address.path else page
            if not there.exists():
                yield f"{page.relative_to(ROOT)}:{number}: {target} is not there"
            elif address.fragment and there.suffix == ".md" and urllib.parse.unquote(address.fragment) not in anchors(there):
                yield f"{page.relative_to(ROOT)}:{number}: {target}: no such heading"


def without_purpose(page):
    """A page begins with a paragraph, whose first sentence says its purpose; the change log is a list."""
    title, *rest = (line for line in page.read_text().split("\n") if line.strip())
    if not title.startswith("# ") or not re.match(r"[\w`\[(\"]|\*\*", "".join(rest[:1])):
        yield f"{page.relative_to(ROOT)}: no paragraph follows the title: say the page's purpose in its first sentence"


def main():
    docs = sorted((ROOT / "docs").rglob("*.md"))
    pages = [ROOT / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")] + docs
    found = [text for page in pages for text in wrong(page)]
    found += [text for page in pages if page.name != "CHANGELOG.md" for text in without_purpose(page)]
    menu = set(re.findall(r"[\w./-]+\.md", (ROOT / "mkdocs.yml").read_text()))
    found += [f"docs/{name} is not in the menu of mkdocs.yml"
              for name in (str(page.relative_to(ROOT / "docs")) for page in docs) if name not in menu]
    print("\n".join(found) or f"{len(pages)} pages: every link leads somewhere")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""check_site.py SITE: every link and anchor of the pages of a built site leads somewhere, and nothing comes from a network."""
import html.parser
import pathlib
import sys
import urllib.parse

SITE = pathlib.Path(sys.argv[1]).resolve()
LOADED = {"script": "src", "img": "src", "link": "href", "iframe": "src", "source": "src"}


class Page(html.parser.HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.ids, self.links, self.loaded = set(), [], []
        self.feed(path.read_text())

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.ids |= {values[key] for key in ("id", "name") if values.get(key)}
        if tag == "a" and values.get("href"):
            self.links.append(values["href"])
        if values.get(LOADED.get(tag)):
            self.loaded.append(values[LOADED[tag]])


def wrong(pages):
    for path, page in pages.items():
        for target in page.loaded:
            if "//" in target:
                yield f"{path.relative_to(SITE)} loads {target}"
        for target in page.links + page.loaded:
            address = urllib.parse.urlsplit(target)
            if address.scheme or address.netloc or path.name == "404.html":
                continue
            there = (path.parent / urllib.parse.unquote(address.path)).resolve() if address.path else path
            there = there / "index.html" if there.is_dir() else there
            anchor = urllib.parse.unquote(address.fragment)
            if not there.is_file():
                yield f"{path.relative_to(SITE)} leads to {target}, which is not there"
            elif anchor and there in pages and anchor not in pages[there].ids:
                yield f"{path.relative_to(SITE)} leads to {target}, an anchor that is not there"


def main():
    pages = {path: Page(path) for path in sorted(SITE.rglob("*.html"))}
    found = sorted(set(wrong(pages)))
    print("\n".join(found[:50]) or f"{len(pages)} pages: every link leads somewhere, nothing comes from a network")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

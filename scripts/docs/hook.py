"""A hook of MkDocs (mkdocs.yml): the same Markdown works in the repository and on the site.

- A link that leaves docs/ leads to a page of the site. A header leads to Doxygen's page of it. Another source, or a folder, has a page
  that shows it. Tables and data are copied. CONTRIBUTING.md and CHANGELOG.md are pages of their own, README.md is the home page.
- Lists are indented as Python-Markdown wants them (github_lists.py).

scripts/site names the folder of Doxygen's results in REHEARSE_SITE_WORK.
"""
import os
import pathlib
import posixpath
import re
import sys
import xml.etree.ElementTree

from mkdocs.structure.files import File

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import github_lists  # noqa: E402
from page_links import LINK, prose  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = {"README.md": "index.md", "CONTRIBUTING.md": "contributing.md", "CHANGELOG.md": "changelog.md"}
DATA = {".csv", ".json", ".png", ".svg", ".bin"}
LANGUAGES = {".cpp": "cpp", ".hpp": "cpp", ".py": "python", ".toml": "toml", ".c": "c", ".js": "javascript", ".xml": "xml",
             ".txt": "cmake", ".sh": "bash", "": "bash"}
STAR = re.compile(r"(?<=\d)\*(?=[ |])")  # 0.84* begins no emphasis
headers = {}  # src/rehearse/…/NAME.hpp → cpp/….html
texts = {}    # page of the site → its Markdown, of pages that docs/ has not


def folders():
    return pathlib.Path(os.environ["REHEARSE_SITE_WORK"])


def read_headers():
    """Doxygen's page of every header."""
    tags = xml.etree.ElementTree.parse(folders() / "rehearse.tag").getroot()
    for file in tags.iter("compound"):
        if file.get("kind") == "file":
            path = file.findtext("path", "") + file.findtext("name")
            headers[path] = "cpp/" + file.findtext("filename")


def links(page, text):
    """What the links of a page of the repository lead to, by its path there."""
    for line, counts in prose(text):
        for match in LINK.finditer(line) if counts else ():
            if match[2] and ":" not in match[2]:
                yield posixpath.normpath(posixpath.join(posixpath.dirname(page), match[2]))


def place(path):
    """Where the site has what the repository has at `path`."""
    if path in PAGES:
        return PAGES[path]
    if path.startswith("docs/"):
        return path[len("docs/"):]
    if path in headers:
        return headers[path]
    here = ROOT / path
    if here.is_dir():
        return f"source/{path}/index.md"
    return f"source/{path}" if here.suffix in DATA else f"source/{path}.md"


def source_page(path):
    """The Markdown of the page that shows a file or a folder of the repository."""
    here = ROOT / path
    if here.is_dir():
        items = "\n".join(f"- [{child.name}]({child.name})" for child in listed(here))
        return f"# {path}\n\nThe files of this folder of the repository:\n\n{items}\n"
    text = here.read_text()
    if here.suffix == ".md":
        return text
    return f"# {path}\n\n````{LANGUAGES.get(here.suffix, 'text')}\n{text.rstrip()}\n````\n"


def listed(folder):
    ours = (c for c in folder.iterdir() if c.is_file() and not c.name.startswith("."))
    return sorted(c for c in ours if b"\0" not in c.read_bytes()[:1000])


def on_files(files, config):
    read_headers()
    site = config["site_dir"]

    def add(name, folder):
        files.append(File(name, str(folder), site, config["use_directory_urls"]))

    add("site.css", pathlib.Path(__file__).parent)
    for file in sorted((folders() / "cpp").rglob("*")):
        if file.is_file():
            add(str(file.relative_to(folders())), folders())
    todo = [f"docs/{file.src_uri}" for file in files.documentation_pages()] + ["CONTRIBUTING.md", "CHANGELOG.md"]
    seen = set(todo)
    while todo:
        page = todo.pop()
        here = ROOT / page
        if not page.startswith("docs/"):
            copy = folders() / "pages" / place(page)
            copy.parent.mkdir(parents=True, exist_ok=True)
            if copy.suffix == ".md":
                texts[place(page)] = page
                copy.write_text(source_page(page))
            else:
                copy.write_bytes(here.read_bytes())
            add(place(page), folders() / "pages")
        if here.is_dir():
            found = [f"{page}/{child.name}" for child in listed(here)]
        elif here.suffix == ".md" and here.is_file():
            found = links(page, here.read_text())
        else:
            found = []
        for path in found:
            if path not in seen and path != "README.md" and not path.startswith("docs/") and path not in headers:
                if (ROOT / path).exists():
                    seen.add(path)
                    todo.append(path)
    return files


def on_page_markdown(markdown, page, config, files):
    here = page.file.src_uri
    origin = texts.get(here, f"docs/{here}")
    if (ROOT / origin).is_dir():
        origin += "/index.md"

    def moved(match):
        if ":" in match[2] or not match[2]:
            return match[0]
        path = posixpath.normpath(posixpath.join(posixpath.dirname(origin), match[2]))
        if not (ROOT / path).exists():
            return match[0]  # MkDocs complains
        return match[1] + posixpath.relpath(place(path), posixpath.dirname(here) or ".") + (match[3] or "") + match[4]

    lines = [STAR.sub(r"\\*", LINK.sub(moved, line)) if counts else line for line, counts in prose(markdown)]
    return github_lists.indented("\n".join(lines))

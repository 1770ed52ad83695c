#!/usr/bin/env python3
"""cpp.py ROOT [COMPILER FLAG…]: every block of C++ or C on a page is compiled, or is what a source says.

A file of tests/docs/cpp has what a block needs around it; its line `//: PAGE WORDS` stands for the block of that page in which
these words are. With a compiler such files are compiled, without code. QUOTES are pages whose blocks stand in sources, line by
line. ELSEWHERE are pages whose blocks other tests compile, with their programs.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
import blocks  # noqa: E402

QUOTES = {"docs/gp-mi.md": ["src/rehearse/identification/learn.cpp"], "docs/same-robot.md": ["examples/same_robot/in_cpp.cpp"],
          "docs/cpp.md": ["examples/own_robot/gp_mi.cpp", "examples/own_robot/spring.hpp"],
          "docs/real-robot.md": ["examples/own_robot/own_loop.cpp"]}
ELSEWHERE = {"docs/actuators.md": "tests/cli/export.sh", "docs/export.md": "tests/cli/export.sh"}


def cpp_blocks(root):
    pages = [root / "README.md", root / "CONTRIBUTING.md", *sorted((root / "docs").rglob("*.md"))]
    return [(str(page.relative_to(root)), line, part) for page in pages
            for at, language, text, marked in blocks.blocks(page) if not marked
            for line, what, part in blocks.parts(at, language, text)
            if what in ("cpp", "c") and not blocks.SIGNS.search(re.sub("//.*", "", part))]


def lines(text):
    return [line.split("//")[0].strip() for line in text.split("\n") if line.strip()]


def filled(template, known, used):
    """The file with its blocks. known: all; used: takes their places."""
    def block(mark):
        page, words = mark[1].split(" ", 1)
        found = [(page, line, text) for at, line, text in known if at == page and words in text]
        if len(found) != 1:
            sys.exit(f"{template.name}: {len(found)} blocks of {page} have '{words}', must be one")
        used.add(found[0][:2])
        return found[0][2]

    return re.sub(r"^ *//: (.+)$", block, template.read_text(), flags=re.M)


def main():
    root, compiler = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2:]
    known, used, wrong = cpp_blocks(root), set(), []
    with tempfile.TemporaryDirectory() as name:
        folder, templates = pathlib.Path(name), root / "tests/docs/cpp"
        for template in sorted(path for path in templates.rglob("*") if path.is_file()):
            path = folder / template.relative_to(templates)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(filled(template, known, used))
        for path in sorted(folder.rglob("*.cpp")) if compiler else ():
            done = subprocess.run([*compiler, "-fsyntax-only", f"-I{folder}", path], capture_output=True, text=True)
            if done.returncode:
                wrong.append(f"{path.relative_to(folder)} does not compile:\n{done.stderr[:4000]}")
    for page, line, text in known:
        if page in QUOTES:
            source = [each for path in QUOTES[page] for each in lines((root / path).read_text())]
            if missing := [each for each in lines(text) if each not in source]:
                wrong.append(f"{page}:{line}: not in {' or '.join(QUOTES[page])}: {missing}")
        elif (page, line) not in used and page not in ELSEWHERE:
            wrong.append(f"{page}:{line}: no file of tests/docs/cpp has this block")
    print("\n\n".join(wrong))
    print(f"{len(known)} blocks of C++ and C, {'compiled' if compiler else 'not compiled'}; {len(wrong)} wrong")
    return 1 if wrong or not known else 0


if __name__ == "__main__":
    sys.exit(main())

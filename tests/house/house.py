#!/usr/bin/env python3
"""house.py ROOT: the house plan of CONTRIBUTING.md, as far as a program can tell.

- No source and no test is longer than 300 lines, but for kernels and what is generated.
- No source depends on one that depends on it: NAME.hpp and NAME.cpp count as one.
- No public function has more than six parameters: kernels and classes' private ones excepted.
- Nine of ten .cpp files of the library have a test of their name.
"""
import collections
import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1])
SOURCES = ROOT / "src" / "rehearse"
LONGEST = 300
MOST_PARAMETERS = 6
INCLUDE = re.compile(r'^#include "([^"]+)"', re.M)


def in_test(path):
    return "test" in path.parts


def too_long():
    folders = ["src", "apps", "python", "web/src", "benchmarks", "examples", "tests"]
    for path in (p for folder in folders for p in (ROOT / folder).rglob("*")):
        if path.suffix in (".cpp", ".hpp", ".h", ".ts") and not path.stem.endswith("kernel"):
            lines = path.read_text().count("\n")
            if lines > LONGEST:
                yield f"{path.relative_to(ROOT)} has {lines} lines, must have at most {LONGEST}"


def dependencies(root, prefix):
    """NAME → the NAMEs it includes; a name is a path without its ending."""
    graph = collections.defaultdict(set)
    for path in root.rglob("*"):
        if path.suffix not in (".cpp", ".hpp", ".h") or in_test(path):
            continue
        name = str(path.relative_to(root).with_suffix(""))
        for included in INCLUDE.findall(path.read_text()):
            if included.startswith(prefix):
                other = str(pathlib.Path(included[len(prefix):]).with_suffix(""))
                if other != name:
                    graph[name].add(other)
    return graph


def cycles(graph):
    """Every group of names that depend on each other (Tarjan 1972)."""
    index, low, stack, found = {}, {}, [], []

    def visit(name):
        index[name] = low[name] = len(index)
        stack.append(name)
        for other in sorted(graph.get(name, ())):
            if other not in index:
                visit(other)
                low[name] = min(low[name], low[other])
            elif other in stack:
                low[name] = min(low[name], index[other])
        if low[name] == index[name]:
            group = stack[stack.index(name):]
            del stack[stack.index(name):]
            if len(group) > 1:
                found.append(sorted(group))

    sys.setrecursionlimit(10000)
    for name in sorted(graph):
        if name not in index:
            visit(name)
    return [f"{', '.join(group)} depend on each other" for group in found]


def parameters(text, begin):
    """How many parameters a list has that opens before `begin`, and where it ends."""
    depth, angles, commas, i = 1, 0, 0, begin
    while depth and i < len(text):
        c = text[i]
        depth += (c in "({[") - (c in ")}]")
        angles += (c == "<") - (c == ">" and text[i - 1] != "-")
        commas += c == "," and depth == 1 and angles == 0
        i += 1
    return (0 if text[begin:i - 1].strip() == "" else commas + 1), i


def too_many_parameters():
    for path in SOURCES.rglob("*.hpp"):
        if in_test(path) or path.stem.endswith("kernel"):
            continue
        text = re.sub(r"//.*", "", path.read_text())
        text = re.sub(r"^ private:.*?^};", "};", text, flags=re.M | re.S)
        for call in re.finditer(r"(\w+)\((?=\s*(?:const )?[\w:<>]+[&*]* \w)", text):
            count, end = parameters(text, call.end())
            if count > MOST_PARAMETERS:
                yield f"{path.relative_to(ROOT)}: {call[1]} has {count} parameters, may have {MOST_PARAMETERS}"


def without_test():
    sources = [p for p in SOURCES.rglob("*.cpp") if not in_test(p)]
    tests = {p.stem[: -len("_test")] for p in SOURCES.rglob("test/*_test.cpp")}
    missing = [p for p in sources if p.stem not in tests]
    if 10 * len(missing) > len(sources):
        names = ", ".join(str(p.relative_to(SOURCES)) for p in sorted(missing))
        yield f"{len(missing)} of {len(sources)} sources have no test of their name, at most a tenth may: {names}"


wrong = list(too_long()) + cycles(dependencies(SOURCES, "rehearse/")) + cycles(dependencies(ROOT / "apps", "apps/"))
wrong += list(too_many_parameters()) + list(without_test())
print("\n".join(wrong) if wrong else "the house is in order")
sys.exit(1 if wrong else 0)

"""Lists as GitHub reads them, written as Python-Markdown reads them: a level is four spaces, a blank line stands before the first item.

Comments on lines of their own are left out, since they would join tables.
"""
import re

ITEM = re.compile(r"^( *)([-*+]|\d+\.)( +)(?=\S)")
COMMENT = re.compile(r"^ *<!--.*-->$")
FENCE = re.compile(r"^ *(```+|~~~+)")


def indented(text):
    result, columns = [], []  # columns: where the text of each open item begins
    fence, blank = None, True
    for line in text.split("\n"):
        depth = len(line) - len(line.lstrip(" "))
        found = FENCE.match(line)
        if fence:
            result.append(line if not columns else "    " * len(columns) + line[columns[-1]:])
            fence = None if found and found[1] == fence else fence
            continue
        if COMMENT.match(line):
            line = ""
        if not line.strip():
            result.append("")
            blank = True
            continue
        item = ITEM.match(line)
        if item and (columns or depth < 4):
            while columns and depth < columns[-1]:
                columns.pop()
            if not columns and not blank and not ITEM.match(result[-1].lstrip()):
                result.append("")
            result.append("    " * len(columns) + line[depth:])
            columns.append(depth + len(item[2]) + len(item[3]))
        else:
            if blank:
                while columns and depth < columns[-1]:
                    columns.pop()
            lazy = bool(columns) and depth < columns[-1]
            result.append("    " * len(columns) + (line.lstrip() if lazy else line[columns[-1] if columns else 0:]))
            fence = found[1] if found else None
        blank = False
    return "\n".join(result)

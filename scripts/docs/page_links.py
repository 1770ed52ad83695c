"""Where the links of a page of Markdown are. Used by the site (hook.py) and by tests/docs/links.py."""
import re

# [text](path#anchor), an image too; the text may have brackets. Groups: up to the path, the path, the anchor with its #, the end.
LINK = re.compile(r"(!?\[(?:[^\[\]]|\[[^\]]*\])*\]\()([^)\s#]*)(#[^)\s]*)?(\))")


def prose(text):
    """Lines, each with whether it is prose: no code, fenced or indented after a blank line."""
    fenced = code = False
    blank = True
    for line in text.split("\n"):
        fence = line.lstrip().startswith(("```", "~~~"))
        fenced ^= fence
        code = line.startswith("    ") and (blank or code)
        blank = not line.strip()
        yield line, not (fenced or fence or code)

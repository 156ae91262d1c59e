#!/usr/bin/env python3
"""Checks the documentation: every relative link and image of README.md, CONTRIBUTING.md, docs/ and cases/ leads to a file,
every anchor to a heading, and every page directly in docs/ is linked from docs/index.md.

Usage: scripts/check_links.py [ROOT]; exit 1 and one line per broken link.
"""
import pathlib
import re
import sys
import urllib.parse

FENCE = re.compile(r"^\s*(```|~~~)")
HEADING = re.compile(r"^#{1,6} +(.*?) *#*$")
LINK = re.compile(r"!?\[(?:[^\]\[]|\[[^\]]*\])*\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)")
CODE = re.compile(r"(`+).+?\1")


def slug(heading):
    """The anchor that GitHub gives to a heading, of its text without markup."""
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    text = re.sub(r"[^\w\- ]", "", text.replace("`", "").strip().lower())
    return text.replace(" ", "-")


def prose(text):
    """The numbered lines outside of fenced code blocks."""
    fenced = False
    for number, line in enumerate(text.splitlines(), 1):
        if FENCE.match(line):
            fenced = not fenced
        elif not fenced:
            yield number, line


def anchors(text):
    known = {}
    for _, line in prose(text):
        found = HEADING.match(line)
        if found:
            name = slug(found[1])
            count = known.get(name, 0)
            known[name] = count + 1
            yield f"{name}-{count}" if count else name


def links(text):
    """Number of the line and target of each link. Brackets in code are not links, code in the text of a link is text."""
    for number, line in prose(text):
        for found in LINK.finditer(CODE.sub(lambda code: re.sub(r"[\[\]()!]", "", code[0]), line)):
            yield number, found[1]


def broken(page, root):
    for number, target in links(page.read_text()):
        if re.match(r"[a-z][a-z0-9+.-]*:", target):
            continue
        path, _, anchor = target.partition("#")
        file = page.parent / urllib.parse.unquote(path) if path else page
        place = f"{page.relative_to(root)}:{number}"
        if not file.exists():
            yield f"{place}: there is no file {path}"
        elif anchor and file.suffix == ".md" and anchor not in set(anchors(file.read_text())):
            yield f"{place}: {file.resolve().relative_to(root.resolve())} has no heading for #{anchor}"


def unlisted(root):
    index = root / "docs/index.md"
    listed = {target.partition("#")[0] for _, target in links(index.read_text())}
    for page in sorted((root / "docs").glob("*.md")):
        if page != index and page.name not in listed:
            yield f"docs/index.md: has no link to {page.name}"


def pages(root):
    yield from (root / name for name in ("README.md", "CONTRIBUTING.md") if (root / name).exists())
    for folder in ("docs", "cases"):
        yield from sorted((root / folder).rglob("*.md"))


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent)
    found = [fault for page in pages(root) for fault in broken(page, root)] + list(unlisted(root))
    print("\n".join(found) if found else "documentation: all links and anchors resolve")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

"""Builds docs/ with MkDocs, for scripts/site: python3 tools/site/build.py FOLDER

The order of the pages is that of docs/index.md, the anchors are those of GitHub, and no page loads anything from a
network."""
import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
ENTRY = re.compile(r"- \[([^\]]+)\]\(([^)#]+\.md)\)")


def navigation(index):
    """The sections of the index and their pages, as MkDocs has them."""
    sections = [{"Overview": "index.md"}]
    for line in index.splitlines():
        if line.startswith("## "):
            sections.append({line[3:]: []})
        elif found := ENTRY.match(line):
            list(sections[-1].values())[0].append({found[1]: found[2]})
    return sections


def configuration(folder):
    # JSON is YAML.
    return json.dumps({
        "site_name": "Hyoryu",
        "docs_dir": str(ROOT / "docs"),
        "site_dir": str(folder),
        "use_directory_urls": False,
        "theme": {"name": "readthedocs", "highlightjs": False, "collapse_navigation": False},
        "extra_css": ["style/site.css"],
        "hooks": [str(ROOT / "tools/site/hooks.py")],
        "plugins": [],
        "markdown_extensions": ["tables", "fenced_code", "sane_lists"],
        "nav": navigation((ROOT / "docs/index.md").read_text()),
    }, indent=1)


def main():
    folder = pathlib.Path(sys.argv[1]).resolve()
    folder.parent.mkdir(parents=True, exist_ok=True)
    settings = folder.with_suffix(".yml")
    settings.write_text(configuration(folder))
    done = subprocess.run(["mkdocs", "build", "--quiet", "--clean", "--strict", "--config-file", settings])
    if done.returncode == 0:
        print(f"site: {folder / 'index.html'}")
    return done.returncode


if __name__ == "__main__":
    sys.exit(main())

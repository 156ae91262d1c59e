#!/usr/bin/env python3
"""The documentation against the program: links, the case of the guide, the layers, and the site where MkDocs is installed."""
import pathlib
import re
import shutil
import subprocess
import sys

from program import CASES, ProgramTest, main

ROOT = CASES.parent
sys.path.insert(0, str(ROOT / "scripts"))

import check_layers  # noqa: E402
import check_links  # noqa: E402


class Documentation(ProgramTest):
    def faults(self, pages):
        """The faults that the check tells of a tree with these pages."""
        for name, text in pages.items():
            (self.dir / name).parent.mkdir(parents=True, exist_ok=True)
            (self.dir / name).write_text(text)
        done = subprocess.run([sys.executable, ROOT / "scripts/check_links.py", self.dir], capture_output=True, text=True)
        self.assertEqual(done.stderr, "")
        self.assertEqual(done.returncode, 0 if done.stdout.startswith("documentation: ") else 1)
        return done.stdout.splitlines() if done.returncode else []

    def test_all_links_of_the_documentation_resolve(self):
        done = subprocess.run([sys.executable, ROOT / "scripts/check_links.py", ROOT], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_the_check_follows_links_to_files_anchors_and_images(self):
        self.assertEqual(self.faults({
            "README.md": "[the index](docs/index.md), [`code` and text](docs/one.md#a-title--with-code)\n![one](docs/one.png)\n",
            "docs/one.png": "",
            "docs/one.md": "# A title, `with` code\n## A title & `with code`\n# Twice\n# Twice\n[up](../README.md) [here](#twice-1)\n",
            "docs/index.md": "[one](one.md) [elsewhere](https://example.org/none.md)\n```\n[in code](none.md)\n```\n`[too](none.md)`\n",
        }), [])

    def test_the_check_names_each_broken_link_with_its_line(self):
        whole = {"README.md": "[index](docs/index.md)\n", "docs/index.md": "# Index\n[one](one.md)\n", "docs/one.md": "# One\n"}
        for page in whole:
            for text, expected in (("[x](none.md)", "none.md"), ("![x](none.png)", "none.png"), ("[x](#none)", "#none"),
                                   ("[`a` b](no/such.md#one)", "no/such.md"), ("| [x](none.md) | y |", "none.md")):
                for before in ("", "```\ncode\n```\n", "\n\n"):
                    broken = {**whole, page: whole[page] + before + text + "\n"}
                    line = len(broken[page].splitlines())
                    found = self.faults(broken)
                    self.assertEqual(len(found), 1, (broken, found))
                    self.assertTrue(found[0].startswith(f"{page}:{line}: "), found)
                    self.assertIn(expected, found[0])

    def test_the_check_names_pages_that_the_index_leaves_out(self):
        self.assertEqual(self.faults({"README.md": "", "docs/index.md": "# Index\n", "docs/lost.md": "# Lost\n"}),
                         ["docs/index.md: has no link to lost.md"])

    def test_the_case_of_the_guide_is_sound(self):
        guide = (ROOT / "docs/writing-a-case.md").read_text()
        case = self.write("\n".join(re.findall(r"^```toml\n(.*?)^```", guide, re.S | re.M)))
        done = self.call("check", case)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_the_table_of_layers_is_that_of_the_check(self):
        allowed_by = check_layers.MAY_INCLUDE
        text = (ROOT / "docs/architecture.md").read_text().split("## Data")[0]
        table = {name: set(re.findall(r"\w+", cell)) - {"none"}
                 for name, cell in re.findall(r"^\| `(\w+)` \| (.*?) \|", text, re.M) if name != "app"}
        expected = {name: allowed for name, allowed in allowed_by.items() if name not in ("app", "view", "vtk")}
        self.assertEqual(table, expected)

    def test_the_site_has_every_page_and_loads_nothing_from_a_network(self):
        if shutil.which("mkdocs") is None:
            self.skipTest("MkDocs is not installed")
        folder = self.dir / "site"
        done = subprocess.run([sys.executable, ROOT / "tools/site/build.py", folder], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        for page in (ROOT / "docs").rglob("*.md"):
            html = (folder / page.relative_to(ROOT / "docs")).with_suffix(".html").read_text()
            self.assertEqual(re.findall(r"<(?:script|link|img)[^>]*(?:src|href)=\"(?:https?:)?//", html), [], page)
            for anchor in check_links.anchors(page.read_text()):
                if not re.search(r"-\d+$", anchor):  # of headings that occur twice
                    self.assertIn(f'id="{anchor}"', html, page)


if __name__ == "__main__":
    main()

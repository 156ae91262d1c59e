#!/usr/bin/env python3
"""The documentation against the program: links, the case of the guide, the layers, and the site where MkDocs is installed."""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tomllib

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

    def test_c6_references_are_those_of_the_sources(self):
        # Kramer et al. (2021): 0.7561 s only makes times dimensionless, 0.8093 s is the measured first damped period at
        # 0.3 D; models with the memory of the waves (Cummins 1962): first peak of the sphere 0.793 s, of the cylinder 0.637 s.
        for case, peak, no_peak, others in (("kramer_sphere", 0.793, (0.7561,), (0.8093,)),
                                            ("heave_cylinder", 0.637, (0.6208, 0.7561), ())):
            benchmark = tomllib.loads((CASES / case / "verify.toml").read_text())
            constants = benchmark.get("constants", {})
            peaks = {}
            for check in benchmark["check"]:
                if check["measure"] == "peak_time" and check["index"] == 1:
                    expected = check["expected"]
                    peaks[check["name"]] = constants.get(expected, expected)
            self.assertEqual(peaks["first peak after release [s]"], peak, case)
            self.assertLessEqual(set(peaks.values()), {peak, *others}, case)
            for number in no_peak:
                self.assertNotIn(number, peaks.values(), case)
            self.assertIn("Cummins", benchmark["source"], case)

    def test_e13_the_readme_of_a_case_has_its_end(self):
        told = 0
        for readme in CASES.glob("*/README.md"):
            end = tomllib.loads((readme.parent / "case.toml").read_text())["time"]["end"]
            for line in re.findall(r"^- Size.*(?:\n  .*)*", readme.read_text(), re.M):
                for seconds in re.findall(r"(?<![-\w.])([0-9.]+) s(?:[.,;]|$)", line):
                    told += 1
                    self.assertEqual(float(seconds.rstrip(".")), end, readme)
        self.assertGreater(told, 0)

    def test_e13_the_record_is_of_one_commit(self):
        self.assertEqual(len(set(re.findall(r"commit ([0-9a-f]{7,40})", (ROOT / "docs/verification.md").read_text()))), 1)

    def calls(self, script, *arguments, stubs, says="", failing="none"):
        """What a script calls in a tree where each of the stubs only tells its name and says a word; and its exit code."""
        tree = self.dir / "tree"
        stub = f'#!/bin/sh\necho "$(basename "$0") $*" >>"{tree}/called"\necho {says}\n[ "$(basename "$0")" != "$FAILING" ]\n'
        for path in (script, *stubs):
            (tree / path).parent.mkdir(parents=True, exist_ok=True)
            (tree / path).write_text((ROOT / path).read_text() if path == script else stub)
            (tree / path).chmod(0o755)
        (tree / "called").write_text("")
        done = subprocess.run([tree / script, *arguments], capture_output=True, text=True,
                              env={"PATH": f"{tree}/bin:/usr/bin:/bin", "FAILING": failing})
        return [line.strip() for line in (tree / "called").read_text().splitlines()], done.returncode

    def ci(self, number, failing="none"):
        """What .ci/run calls at the commit of that number, and its exit code."""
        scripts = [f"scripts/{name}" for name in ("test", "sanitize", "valgrind", "lint", "package")]
        calls, code = self.calls(".ci/run", stubs=["bin/git", *scripts], says=number, failing=failing)
        return [call for call in calls if not call.startswith("git ")], code

    def test_e13_the_turns_leave_nothing_out_and_a_failure_of_any_is_one(self):
        turns = [] # of the parts of lint, the rarest, one comes every 8 commits; the parts of memory take turns by 8
        failed = set()
        for number in range(96):
            turn, code = self.ci(number)
            self.assertEqual(code, 0)
            turns.append(turn)
            self.assertEqual(turn[0].split()[0], "test")
            for script in {call.split()[0] for call in turn} - failed:
                failed.add(script)
                self.assertNotEqual(self.ci(number, failing=script)[1], 0, (number, script))
        self.assertEqual({call for turn in turns for call in turn},
                         {"test", "test --portable", "package --check", "valgrind", "sanitize --threads --quick",
                          *(f"sanitize --quick {part}" for part in ("bodies", "scenes", "files", "steps")),
                          *(f"lint --part {k}/6" for k in range(6))})
        for one, next_one in zip(turns, turns[1:]): # memory is never left out twice in a row
            self.assertIn("sanitize --quick", " ".join(one + next_one))

    def test_e13_the_parts_of_the_sanitizers_leave_out_no_layer_and_build_what_they_run(self):
        def built_and_run(*part):
            stubs = ["scripts/install_dependencies", "bin/cmake", "bin/ctest"]
            calls, code = self.calls("scripts/sanitize", "--quick", *part, stubs=stubs)
            self.assertEqual(code, 0, part)
            build, run = calls[-2].split(), calls[-1].split()
            return set(build[build.index("--target") + 1:]), set(run[run.index("-L") + 1].strip("^$()").split("|"))
        fuzz = re.search(r"foreach\(target (.*)\)", (ROOT / "tests/fuzz/CMakeLists.txt").read_text()).group(1)
        targets = {f"fuzz_{target.split(':')[0]}" for target in fuzz.split()}
        union = set()
        for part in (["bodies"], ["scenes"], ["files"], ["steps"], []):
            built, run = built_and_run(*part)
            self.assertEqual(built, {f"test_{label}" for label in run - {"fuzz"}} | (targets if "fuzz" in run else set()))
            self.assertEqual(built & union, built if not part else set(), part) # no part repeats another
            union |= built
        self.assertEqual(built, union)
        layers = re.search(r"foreach\(layer (.*)\)", (ROOT / "tests/CMakeLists.txt").read_text()).group(1).split()
        above = {"report", "assess", "bench", "view"} # what the whole step does not need
        self.assertEqual(union, targets | {f"test_{layer}" for layer in set(layers) - above})

    def test_e13_lint_checks_format_clang_tidy_and_a_build_without_vtk(self):
        lint = (ROOT / "scripts/lint").read_text()
        for part in ("clang-format --dry-run --Werror", "clang-tidy-19", "--warnings-as-errors='*'", "cmake --build --preset clang"):
            self.assertIn(part, lint)
        presets = json.loads((ROOT / "CMakePresets.json").read_text())["configurePresets"]
        clang = next(preset for preset in presets if preset["name"] == "clang")["cacheVariables"]
        self.assertEqual((clang["CMAKE_CXX_COMPILER"], clang["HYORYU_VTK"], clang["HYORYU_STRICT"]), ("clang++-19", "OFF", "ON"))

    def test_e13_parameters_of_tests_print_as_words(self):
        for program in sorted((pathlib.Path(self.program).parent / "tests").glob("test_*")):
            if program.is_file() and program.suffix == "":
                done = subprocess.run([program, "--gtest_list_tests"], capture_output=True, text=True)
                self.assertNotIn("-byte object", done.stdout, program)

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

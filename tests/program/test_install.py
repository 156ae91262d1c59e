#!/usr/bin/env python3
"""What `cmake --install` puts where, and that it works from there, with and without the part that needs VTK."""
import pathlib
import shutil
import subprocess

from program import CASES, FLOOD, HYORYU, ProgramTest, main

BUILD = pathlib.Path(HYORYU).parent


class Install(ProgramTest):
    def install(self, *arguments):
        done = subprocess.run(["cmake", "--install", BUILD, "--prefix", self.dir / "usr", *arguments],
                              capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.program = str(self.dir / "usr/bin/hyoryu")

    def test_e14_the_program_works_where_it_is_installed(self):
        self.install("--component", "program")
        self.assertFalse((self.dir / "usr/lib/hyoryu").exists())
        self.assertEqual(self.call("--version").stdout,
                         subprocess.run([HYORYU, "--version"], capture_output=True, text=True).stdout)
        done = self.call("run", self.write(FLOOD), "-o", "out", "--until", "0.05", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.call("report", "out").returncode, 0)
        done = self.call("render", "out")
        self.assertEqual(done.returncode, 4)
        self.assertIn("VTK" if "VTK OFF" in self.call("--version").stdout else "hyoryu-vtk", done.stderr)

    def test_the_part_with_vtk_is_found_beside_it(self):
        if not (BUILD / "libhyoryu_vtk.so").exists():
            self.skipTest("built without VTK")
        self.install()
        self.call("run", self.write(FLOOD), "-o", "out", "--until", "0.05", "--quiet")
        done = self.call("render", "out", "--times", "0", "--width", "64", "--height", "64")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_texts_and_cases_are_there(self):
        self.install("--component", "program")
        share = self.dir / "usr/share"
        commands = [line.split()[0] for line in
                    self.call("--help").stdout.split("Subcommands:\n")[1].split("\n\n")[0].splitlines()]
        self.assertEqual(sorted(p.name for p in (share / "man/man1").iterdir()),
                         sorted(["hyoryu.1", *(f"hyoryu-{name}.1" for name in commands)]))
        for name in commands:
            self.assertEqual((share / f"man/man1/hyoryu-{name}.1").read_text(), self.call("man", name).stdout)
        self.assertEqual((share / "bash-completion/completions/hyoryu").read_text(),
                         self.call("completions", "bash").stdout)
        self.assertTrue((share / "zsh/vendor-completions/_hyoryu").exists())
        self.assertTrue((share / "fish/vendor_completions.d/hyoryu.fish").exists())
        self.assertTrue((share / "doc/hyoryu/copyright").exists())
        self.assertTrue((share / "doc/hyoryu/formulation.md").exists())
        self.assertEqual((share / "hyoryu/cases/floating_box/case.toml").read_text(),
                         (CASES / "floating_box/case.toml").read_text())


if __name__ == "__main__":
    if shutil.which("cmake") is None:
        raise SystemExit("cmake is not in the path")
    main()

#!/usr/bin/env python3
"""What a user gets wrong: messages, places, exit codes."""
import resource
import time

from program import FLOOD, ProgramTest, main

# A second body in the flood.
CUBE = """[[body]]
name = "cube"
shape = "box"
size = [0.2, 0.2, 0.2]
density = 400.0
position = [{}, {}, {}]
"""


class Mistakes(ProgramTest):
    def with_cube(self, x, y, z, more=""):
        return FLOOD.replace("[output]", CUBE.format(x, y, z) + more + "[output]")

    def refused(self, text, *expected, arguments=(), **options):
        before = set(self.files())
        name = self.write(text)
        done = self.call("run", name, "-o", "out", *arguments, **options)
        self.assertEqual(done.returncode, 2, done.stderr)
        for part in expected:
            self.assertIn(part, done.stderr)
        self.assertEqual(set(self.files()) - before, {"case.toml"} - before, "something was written")

    def test_a_refused_resumption_names_the_keys_of_debris_and_not_those_of_its_pieces(self):
        yard = """[time]
end = 0.02
step = 0.001
[particles]
spacing = 0.2
[[wall]]
shape = "plane"
[[body]]
name = "rock"
shape = "box"
size = [1.0, 1.0, 1.0]
density = 2000.0
position = [5.0, 5.0, 0.5]
[[debris]]
kind = "car"
name = "yard"
scatter = { corners = [[0, 0, 0], [30, 0, 0], [30, 30, 0], [0, 30, 0]], count = 3 }
"""
        self.write(yard)
        asked = ("run", "case.toml", "-o", "out", "--quiet")
        self.assertEqual(self.call(*asked, "--until", "0.01", "--set", "debris[0].scatter.gap=0.5").returncode, 0)
        for text, keys, values in (
                (yard.replace("count = 3", "count = 5, gap = 0.5"), ["debris[0].scatter.count"], ["with 3", "has 5"]),
                (yard.replace("count = 3", "count = 2, gap = 0.5").replace("2000.0", "2100.0"),
                 ["debris[0].scatter.count", "body[0].density"], ["with 3", "has 2", "2100"])):
            self.write(text)
            done = self.call(*asked, "--resume")
            self.assertEqual(done.returncode, 2)
            for part in [*keys, *values]:
                self.assertIn(part, done.stderr)
            self.assertNotIn("position", done.stderr)
            self.assertEqual(done.stderr.count("error:"), len(keys), done.stderr)

    def test_unknown_key(self):
        self.refused(FLOOD.replace("[fluid]", "[fluid]\ndensty = 1000.0"),
                     "case.toml:8:1", "fluid.densty", "density", "^^^^^^")

    def test_wrong_unit(self):
        self.refused(FLOOD.replace("spacing = 0.05", 'spacing = "5 s"'), "case.toml:6:11",
                     "particles.spacing")

    def test_negative_density(self):
        self.refused(FLOOD.replace("density = 400.0", "density = -400.0"), "density", "-400")

    def test_all_mistakes_at_once(self):
        text = FLOOD.replace("spacing = 0.05", 'spacing = "5 s"').replace("density = 400.0",
                                                                          "density = -400.0")
        self.refused(text, "particles.spacing", "density", "-400")

    def test_a_kernel_of_sph_with_mps(self):
        for kernel in ("isotropic", "wendland"):
            text = FLOOD.replace("[fluid]\n", f'[fluid]\nformulation = "mps"\nkernel = "{kernel}"\n')
            if kernel == "isotropic":
                self.refused(text, "`fluid.kernel`: is available for SPH only", "case.toml:9:10:", "leave kernel out")
            else:  # the default, written out
                self.assertEqual(self.call("check", self.write(text)).returncode, 0)

    def test_overlapping_bodies(self):
        second = '[[body]]\nname = "second"\nshape = "box"\nsize = [0.2, 0.2, 0.2]\n' \
                 "density = 500.0\nposition = [0.9, 0.26, 0.15]\n"
        self.refused(FLOOD.replace("[output]", second + "[output]"), "overlaps", "crate", "second")

    def test_body_in_the_floor(self):
        self.refused(FLOOD.replace("0.26, 0.125]", "0.26, 0.1]"), "overlaps", "basin")

    def test_missing_case(self):
        done = self.call("run", "nowhere.toml")
        self.assertEqual(done.returncode, 2)
        self.assertIn("nowhere.toml", done.stderr)

    def test_unreadable_mesh(self):
        (self.dir / "bad.stl").write_text("this is no mesh")
        mesh = FLOOD.replace('shape = "box"\nsize = [0.25, 0.25, 0.25]',
                             'shape = "mesh"\nfile = "bad.stl"')
        self.refused(mesh, "bad.stl")
        self.refused(mesh.replace("bad.stl", "missing.stl"), "missing.stl")

    def test_non_empty_results_folder(self):
        (self.dir / "out").mkdir()
        (self.dir / "out" / "precious.txt").write_text("mine")
        for arguments in ((), ("--force",)):
            done = self.call("run", self.write(FLOOD), "-o", "out", *arguments)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertEqual([p.name for p in (self.dir / "out").iterdir()], ["precious.txt"])

    def test_a_fixed_step_beyond_stability(self):
        self.refused(FLOOD.replace("end = 0.5", "end = 0.5\nstep = 0.1"), "time.step")

    def test_an_absurd_spacing_is_refused_with_the_estimate(self):
        self.refused(FLOOD.replace("spacing = 0.05", "spacing = 1e-7"), "particles")
        self.refused(FLOOD.replace("spacing = 0.05", "spacing = 1e-5"), "1.7e+14", "particles",
                     "of them of `")

    def test_a_case_beyond_the_memory_is_refused_with_the_estimate(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (2 << 30, 2 << 30))

        probe = self.call("--version", preexec_fn=limit)
        if "ShadowMemory" in probe.stderr:
            self.skipTest("a program with the address sanitizer does not start in so little memory")
        for spacing, expected in (("0.001", "their positions alone take"), ("0.0025", "the run needs")):
            self.refused(FLOOD.replace("spacing = 0.05", f"spacing = {spacing}"), expected, "2.",
                         preexec_fn=limit)

    def test_e10_memory_that_ends_on_the_way_is_a_message(self):
        # E10: from limits in which the program hardly starts to those in which the run fits.
        if "ShadowMemory" in self.call("--version", preexec_fn=self.limit_to(64 << 20)).stderr:
            self.skipTest("a program with the address sanitizer does not start in so little memory")
        name = self.write(FLOOD.replace("spacing = 0.05", "spacing = 0.025"))
        codes = set()
        for megabytes in range(44, 140, 8):
            done = self.call("run", name, "-o", "out", "--force", "--until", "0.002", "--threads", "1",
                             preexec_fn=self.limit_to(megabytes << 20))
            self.assertIn(done.returncode, (0, 2, 4), (megabytes, done.stderr))
            if done.returncode != 0:
                self.assertRegex(done.stderr, "memory|thread", megabytes)
            codes.add(done.returncode)
        self.assertTrue({0, 4} <= codes, codes)

    def limit_to(self, size):
        return lambda: resource.setrlimit(resource.RLIMIT_AS, (size, size))

    def test_a_wall_far_beyond_the_domain_is_counted(self):
        domain = "[domain]\nmin = [0.0, 0.0, 0.0]\nmax = [1.6, 0.5, 1.0]\n[fluid]"
        self.refused(FLOOD.replace("[fluid]", domain).replace("max = [1.6, 0.5, 1.0]\nopen",
                                                              "max = [1e7, 1e7, 1.0]\nopen"),
                     "particles")

    def test_e8_more_outputs_and_steps_than_can_be_are_refused_with_the_estimate(self):
        self.refused(FLOOD.replace("every = 0.05", "every = 1e-300"), "output.every", "5e+299 frames")
        self.refused(FLOOD.replace("end = 0.5", "end = 1e300"), "time.end", "at most 1e+15")
        self.refused(FLOOD.replace("end = 0.5", "end = 0.5\nstep = 1e-300"), "time.end", "5e+299")
        copies = "[body.copies]\ncount = [1000000000, 1, 1]\npitch = [1.0, 0.0, 0.0]\n[output]"
        self.refused(FLOOD.replace("[output]", copies), "body[0].copies.count", "1000000000")
        self.refused(FLOOD.replace("[output]", copies.replace("1000000000, 1, 1", "100000, 9, 9")),
                     "too many, at most 100000 bodies")

    def test_tables_are_named_as_in_the_file_whatever_copies_stand_before_them(self):
        for count in (2, 3):
            copies = f"[body.copies]\ncount = [1, 1, {count}]\npitch = [0.0, 0.0, 0.3]\n[[body]]\nname = \"beam\"\n"
            beam = 'shape = "box"\nsize = [0.2, 0.2, 0.2]\ndensity = 400.0\nposition = [1.58, 0.26, 0.5]\n[output]'
            self.refused(FLOOD.replace("[output]", copies + beam), "`body[1]`", 'body "beam" overlaps wall "basin"')

    def test_mistakes_that_place_nothing_do_not_hide_those_of_the_scene(self):
        gauge = '[[gauge]]\ntype = "force"\non = "{}"\n[output]'
        crowd = ('[[debris]]\nkind = "car"\nname = "a"\narray = {{ count = [2, 1, 1], pitch = [0.1, 0.0, 0.0], '
                 'from = [0.3, {}], on = "ground" }}\n[output]')
        for x, bad, key in ((0.9, ("[output]", crowd.format(5)), "debris[0].array"),
                            (0.9, ("[output]", crowd.format(0.2).replace('"car"', '"cart"')), "debris[0].kind"),
                            (0.9, ("every = 0.05", 'every = -1\nfields = ["velocty"]'), "output.fields"),
                            (0.7, ("[output]", gauge.format("scond")), "gauge[0].on"),
                            (0.05, ("[output]", '[contact]\nfriction = -1\n[output]'), "contact.friction")):
            text = self.with_cube(x, 0.26, 0.1).replace(*bad)
            overlap = 'body "cube" overlaps'
            self.refused(text, f"`{key}", overlap)
            self.assertEqual(self.call("check", "case.toml").stderr.count("error: "), 2 + ("every = -1" in text))
        # A body that is not known overlaps nothing.
        self.assertNotIn("overlaps", self.call("check", self.write(
            self.with_cube(0.9, 0.26, 0.1).replace("size = [0.2,", "size = [-0.2,"))).stderr)

    def test_a_body_beside_all_walls_is_told(self):
        plane = '[[wall]]\nname = "yard"\nshape = "plane"\npoint = [0, 0, -0.2]\nnormal = [0, 0, 1]\n'
        box = '[[wall]]\nname = "pad"\nshape = "box"\nmin = [-0.6, 0.0, -0.4]\nmax = [-0.3, 0.5, -0.2]\n'
        copies = "[body.copies]\ncount = [{}, 1, 1]\npitch = [0.45, 0.0, 0.0]\n"  # the fourth is outside
        for x, y, more, falls in ((0.5, 0.26, copies.format(3), False), (0.5, 0.26, copies.format(5), True),
                                  (-0.4, 0.26, "", True), (1.9, 0.3, "", True), (0.8, -0.3, "", True),
                                  (1.2, 0.3, "", False), (-0.4, 0.26, plane, False), (-0.4, 0.26, box, False),
                                  (1.9, 0.3, box, True), (-0.4, 0.26, "fixed = true\n", False)):
            self.write(self.with_cube(x, y, 0.7, more))
            done = self.call("check", "case.toml")
            self.assertEqual(done.returncode, 0, done.stderr)
            told = 'body "cube" lies outside of the basin "basin", and no wall is below it'
            told = told.replace("cube", "cube.4" if "copies" in more else "cube")
            self.assertEqual(done.stderr.count(told), falls, done.stderr)

    def test_a_block_that_other_blocks_cover_is_told(self):
        block = '[[fluid.block]]\nshape = "box"\nmin = [{0}, 0.0, 0.0]\nmax = [{1}, 0.5, {2}]\nvelocity = [1.0, 0.0, 0.0]\n[[wall]]'
        for low, high, top in ((0.1, 0.3, 0.4), (0.0, 0.5, 0.6), (0.2, 0.5, 0.3)):
            self.write(FLOOD.replace("[[wall]]", block.format(low, high, top)))
            done = self.call("check", "case.toml")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("`fluid.block[1]`: it adds no particles", done.stderr)
        self.write(FLOOD.replace("[[wall]]", block.format(0.5, 0.7, 0.4)))
        self.assertNotIn("adds no particles", self.call("check", "case.toml").stderr)

    def test_what_a_window_or_the_sound_cannot_carry_is_refused(self):
        window = """[[open]]
name = "river"
min = [0.0, 0.0, 0.0]
max = [0.0, 0.5, {}]
into = "+x"
kind = "inflow"
discharge = {}
[output]"""
        flood = FLOOD.replace('open = ["+z"]', 'open = ["+z", "-x"]')
        for discharge, top in ((0.25, 0.2), (0.05, 0.08)):
            critical = ((discharge / 0.5) ** 2 / 9.81) ** (1 / 3)
            self.refused(flood.replace("[output]", window.format(top, discharge)), "`open.river.max`",
                         f"rises to {critical:.4g}"[:-1])
        for speed in ("0.01", "1e-6"):
            self.refused(FLOOD.replace("[fluid]", f"[fluid]\nsound_speed = {speed}"), "`fluid.sound_speed`", "overflow")

    def test_e3_no_name_leads_out_of_the_results_folder(self):
        for name in ("../evil", "a/b", "/tmp/evil", "a\\\\b", "nul\\u0000", "line\\n"):
            self.refused(FLOOD.replace('"crate"', f'"{name}"'), "is not a valid name")
            self.refused(FLOOD.replace('"basin"\nshape', f'"{name}"\nshape'), "is not a valid name")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Tables of a contact.json: ratios to the other engines, to an earlier file, and the document.

Usage: report.py RESULTS.json [--against EARLIER.json] [--markdown FILE]
"""
import argparse
import json
import pathlib

OURS = "hyoryu"
# An error below this, in the unit of its number (0.1 nm, 0.1 um/s), is none: ratios count it as this.
EXACT = 1e-7

PREAMBLE = """# Contact benchmarks

Cost and accuracy of rigid contact: Hyoryu beside the engines that Debian packages, on the scenes
whose exact answer is known, and on heaps of boxes. Written by

    scripts/bench {extent}--markdown docs/contact-benchmarks.md

which builds `tools/bench/`, runs it and rewrites this file. `scripts/bench --against FILE` compares
our cost with that of an earlier `contact.json`. Without the engines it gives our rows alone; they
come with the Debian packages `libbullet-dev`, `libode-dev` and `libmujoco-dev`.

Measured on {machine}, {compiler}, {build} build, one thread; {versions}.

## What is fair here, and what is not

- Cost is CPU time of one thread inside the engine's step, without reading states. All engines run
  one after the other in each of at least three rounds of one program (fewer where a round of a large
  heap takes minutes), and of each fortieth of a run, in a heap of each step, the least time over the
  rounds counts, so that a machine busy with something else cannot make one engine look slow.
- The same shapes, masses, poses, velocities, gravity, restitution and friction for all; no damping,
  no sleeping. The errors are read from a run of their own and stand against exact answers (closed
  forms, or an event-driven solver good to 1e-8 m), never against Hyoryu.
- Hyoryu steps by 1 ms and by 10 ms, the others by 1 ms and by 0.1 ms. Costs are compared at 1 ms.
- We know our own engine better than the others. Each has one tight setting, below, that does well
  over all scenes; an expert could tune each scene further. Bullet runs in single precision, as it is
  packaged by default, and on a floor that is a box, since its plane lets a box tumble. ODE's
  friction is an axis-aligned pyramid, which is its only model. MuJoCo has no restitution
  coefficient: its contacts are springs and dashpots, set so that e comes out over ten steps; where
  nothing can touch it runs with its fourth-order integrator. Its buffer cannot hold 1,000 boxes.
- The rest position of soft or position-corrected contact lies a little below the surface; "sink"
  and "overlap" count that as error, which a game or a controller need not care about.
- The apex of the timber's right end depends on the law for simultaneous impacts. Ours solves them in
  rounds; for an engine that solves all at once the exact apex is 0, so its error of 37 to 38 mm is
  a choice of law, not a defect.
- From the heaps' first impacts on, no two engines follow the same path; there, cost per contact,
  overlap and energy at the end are what can be compared. Contacts are points as each engine makes
  them.

"""


def machine_here():
    """The processor and its widest registers, as Linux tells them."""
    text = pathlib.Path("/proc/cpuinfo").read_text()
    known = dict(line.split(":", 1) for line in text.split("\n\n")[0].splitlines() if ":" in line)
    known = {key.strip(): value.strip() for key, value in known.items()}
    flags = known.get("flags", "").split()
    registers = "AVX-512" if "avx512f" in flags else "AVX2" if "avx2" in flags else "narrower than AVX2"
    return f"{known.get('model name', 'an unknown processor')} ({registers})"


def by_engine(scene, dt=None):
    return {r["engine"]: r for r in scene["results"] if dt is None or r["dt_s"] == dt}


def figure(value):
    return "–" if value is None else f"{value or 0:.3g}"  # or 0: no negative zero


def error_ratio(peer, ours):
    """How many times larger a peer's error is than ours, or that both are as good as none."""
    theirs, mine = abs(peer["error"]), abs(ours["error"])
    if max(theirs, mine) < EXACT:
        return "both exact"
    return ("> " if mine < EXACT else "") + figure(max(theirs, EXACT) / max(mine, EXACT))


def print_ratios(document):
    engines = [e["name"] for e in document["engines"] if e["name"] != OURS]
    if not engines:
        print("no other engine in these results")
        return
    print("our cost a step at 1 ms, as a share of each engine's")
    print(f"{'scene':<14}" + "".join(f"{name:>17}" for name in engines))
    for scene in document["scenes"]:
        rows = by_engine(scene, 1e-3)
        if OURS in rows:
            cells = [f"{rows[OURS]['us_per_step'] / rows[n]['us_per_step']:>17.2f}" if n in rows else
                     f"{'–':>17}" for n in engines]
            print(f"{scene['name']:<14}" + "".join(cells))


def print_against(document, earlier):
    before = {s["name"]: by_engine(s, 1e-3) for s in earlier["scenes"]}
    print("\nour cost a step at 1 ms, now and before [us]")
    print(f"{'scene':<14}{'now':>12}{'before':>12}{'ratio':>8}   (ratio of the peers' median)")
    for scene in document["scenes"]:
        now = by_engine(scene, 1e-3)
        old = before.get(scene["name"], {})
        if OURS not in now or OURS not in old:
            continue
        ratios = {n: now[n]["us_per_step"] / old[n]["us_per_step"] for n in now if n in old}
        peers = sorted(r for n, r in ratios.items() if n != OURS)
        machine = f"{peers[len(peers) // 2]:>8.2f}" if peers else ""
        print(f"{scene['name']:<14}{now[OURS]['us_per_step']:>12.2f}{old[OURS]['us_per_step']:>12.2f}"
              f"{ratios[OURS]:>8.2f}   {machine}")


def cost_table(document):
    engines = [e["name"] for e in document["engines"]]
    lines = ["| scene | " + " | ".join(engines) + " |", "|---" * (len(engines) + 1) + "|"]
    for scene in document["scenes"]:
        if scene["kind"] == "exact":
            rows = by_engine(scene, 1e-3)
            cells = [figure(rows[n]["us_per_step"]) if n in rows else "–" for n in engines]
            lines.append(f"| {scene['name']} | " + " | ".join(cells) + " |")
    return lines


def error_tables(document):
    lines = []
    for scene in document["scenes"]:
        if scene["kind"] != "exact":
            continue
        metrics = scene["results"][0]["metrics"]
        heads = [f"{m['name']} [{m['unit']}]" if m["unit"] != "1" else m["name"] for m in metrics]
        lines += [f"\n**{scene['name']}**: {scene['what']}, {scene['duration_s']:g} s.\n",
                  "| engine | step [ms] | CPU [ms] per simulated s | " + " | ".join(heads) + " |",
                  "|---" * (len(heads) + 3) + "|"]
        for r in scene["results"]:
            cost = 1e-3 * r["us_per_step"] / r["dt_s"]
            cells = [figure(m["error"]) for m in r["metrics"]]
            lines.append(f"| {r['engine']} | {1e3 * r['dt_s']:g} | {figure(cost)} | "
                         + " | ".join(cells) + " |")
    return lines


def claim_table(document):
    """Our error at 1 ms beside the best of the peers at 0.1 ms, for each number of each scene."""
    lines = ["| scene | number | unit | ours at 1 ms | best peer at 0.1 ms | which | ratio |",
             "|---|---|---|---|---|---|---|"]
    for scene in document["scenes"]:
        ours = by_engine(scene, 1e-3).get(OURS)
        peers = {n: r for n, r in by_engine(scene, 1e-4).items() if n != OURS}
        if scene["kind"] != "exact" or ours is None or not peers:
            continue
        for k, mine in enumerate(ours["metrics"]):
            if mine["name"].startswith("apex of the right end"):
                continue  # a choice of law
            known = {n: r["metrics"][k] for n, r in peers.items()
                     if r["metrics"][k]["error"] is not None}
            if not known or mine["error"] is None:
                continue
            best = min(known, key=lambda n: abs(known[n]["error"]))
            lines.append(f"| {scene['name']} | {mine['name']} | {mine['unit']} | "
                         f"{figure(mine['error'])} | {figure(known[best]['error'])} | {best} | "
                         f"{error_ratio(known[best], mine)} |")
    return lines


def heap_table(document):
    lines = ["| heap | engine | falling [us/step] | at rest [us/step] | contacts | at rest [us/contact] |"
             " worst overlap [mm] | kinetic energy [J] | lost |", "|---" * 9 + "|"]
    for scene in document["scenes"]:
        if scene["kind"] != "heap":
            continue
        for r in scene["results"]:
            late = None if r["stopped_by_budget"] else r["us_per_step_late"]
            note = f" (stopped at {r['steps'] * r['dt_s']:.2f} s)" if r["stopped_by_budget"] else ""
            errors = [figure(m["error"]) for m in r["metrics"]]
            each = figure(late / r["contacts"] if late and r["contacts"] else None)
            lines.append(f"| {scene['bodies']} | {r['engine']}{note} | {figure(r['us_per_step_early'])} | "
                         f"{figure(late)} | {r['contacts']} | {each} | " + " | ".join(errors) + " |")
    return lines


def markdown(document):
    versions = ", ".join(f"{name} {number}" for name, number in document["versions"].items())
    text = PREAMBLE.format(machine=machine_here(),
                           extent="--full " if document["extent"] == "full" else "",
                           compiler=document["compiler"].replace("GNU", "GCC"),
                           build=document["build_type"], versions=versions)
    lines = ["## Settings\n", "| engine | settings |", "|---|---|"]
    lines += [f"| {e['name']} | {e['settings']} |" for e in document["engines"]]
    lines += ["\n## Cost [us a step, at 1 ms]\n"] + cost_table(document)
    lines += ["\n## Accuracy: ours at 1 ms, the best of the others at 0.1 ms\n",
              "For each number the best of the other engines, whichever it is; an error below 1e-7 of the"
              " unit counts as that, and where both are below the two are called exact.\n"]
    lines += claim_table(document)
    lines += ["\n## Heaps",
              "\nBoxes of 0.1 m and 0.5 kg in columns with seeded offsets and tilts, dropped into a basin;"
              " e = 0.2, mu = 0.5, steps of 1 ms. Falling: the first quarter of the run; at rest: the"
              " last.\n"]
    lines += heap_table(document)
    lines += ["\n## Errors, scene by scene"] + error_tables(document)
    return text + "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("results", type=pathlib.Path)
    parser.add_argument("--against", type=pathlib.Path)
    parser.add_argument("--markdown", type=pathlib.Path)
    options = parser.parse_args()
    document = json.loads(options.results.read_text())
    print_ratios(document)
    if options.against:
        print_against(document, json.loads(options.against.read_text()))
    if options.markdown:
        options.markdown.write_text(markdown(document))


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Tables of a contact.json: ratios to the other engines, to an earlier file, and the document.

Usage: report.py RESULTS.json [--against EARLIER.json] [--markdown FILE]
"""
import argparse
import json
import pathlib

OURS = "hyoryu"
# Errors below this value, in the unit of the quantity (0.1 nm, 0.1 um/s), are raised to it in ratios.
EXACT = 1e-7

PREAMBLE = """# Contact benchmarks

Cost and accuracy of rigid contact: Hyoryu and the physics engines that are packaged by Debian, in
scenes with a known exact solution and in heaps of boxes. This page was written by

    scripts/bench {extent}--markdown docs/contact-benchmarks.md

which builds and runs `tools/bench/`. `scripts/bench --against FILE` compares the cost of Hyoryu with
that in an earlier `contact.json`. Without the other engines the command measures Hyoryu alone. The
engines are in the Debian packages `libbullet-dev`, `libode-dev` and `libmujoco-dev`.

Measured on {machine}, {compiler}, {build} build, one thread; {versions}.

## Conditions of the comparison

- Cost is the CPU time of one thread in the step function of the engine, without reading the states.
  All engines run one after the other, in at least three rounds of one program (fewer if a round of a
  large heap takes minutes). A run is divided into forty parts, and a run of a heap into its steps;
  of each part the shortest time of all rounds counts. Other work on the machine therefore does not
  favour any engine.
- Shapes, masses, poses, velocities, gravity, restitution and friction are the same for all engines,
  without damping and without sleeping. Errors are measured in a separate run, relative to exact
  solutions (closed forms, or an event-driven solver with errors below 1e-8 m), never to Hyoryu.
- Hyoryu uses steps of 1 ms and 10 ms, the other engines 1 ms and 0.1 ms. Costs are compared at 1 ms.
- The authors know Hyoryu better than the other engines. Each of these has one set of accurate
  settings, listed below, chosen for all scenes together; an expert could improve them for each
  scene. Bullet uses single precision, the default of its package, and a box as the floor, since a
  box tumbles on its plane. The friction of ODE is an axis-aligned pyramid, its only model. MuJoCo
  has no restitution coefficient: its contacts are springs and dashpots, chosen such that e results
  over ten steps; scenes without contacts use its fourth-order integrator. Its buffer is too small
  for 1,000 boxes.
- With soft or position-corrected contacts bodies rest slightly below the surface. "sink" and
  "overlap" count this as an error, although it is irrelevant to a game or a controller.
- The apex of the right end of the timber depends on the law for simultaneous impacts. Hyoryu solves
  them one after the other in rounds. For engines that solve all impacts together the exact apex is
  0; their error of 37 to 38 mm reflects the choice of the law and is not a defect.
- After the first impacts in a heap the motion is different in each engine. Cost per contact,
  overlap and energy at the end can still be compared. The number of contacts is the number of
  contact points, as each engine creates them.

"""


def machine_here():
    """The processor and its widest registers, from /proc/cpuinfo."""
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
    """Ratio of the error of another engine to ours; "both exact" if both are below EXACT."""
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
    """Our error at 1 ms and the smallest of the other engines at 0.1 ms, for each quantity of each scene."""
    lines = ["| scene | quantity | unit | Hyoryu at 1 ms | best other engine at 0.1 ms | engine | ratio |",
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
    lines += ["\n## Accuracy: Hyoryu at 1 ms, the best other engine at 0.1 ms\n",
              "For each quantity the smallest error of the other engines is listed. Errors below 1e-7 of the unit are"
              " raised to this value in the ratio; if both errors are below it, the table says \"both exact\".\n"]
    lines += claim_table(document)
    lines += ["\n## Heaps",
              "\nBoxes of 0.1 m and 0.5 kg in columns with seeded offsets and tilts, dropped into a basin;"
              " e = 0.2, mu = 0.5, steps of 1 ms. \"falling\" is the first quarter of the run, \"at rest\" the last"
              " quarter.\n"]
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

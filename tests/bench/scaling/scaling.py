#!/usr/bin/env python3
"""How cost grows with pixels, depth, threads, lights, spheres and triangles.

Usage: scaling.py LIGHTBENCH FOLDER [--rounds N] [--largest N]

Writes FOLDER/scaling.svg and prints its numbers as tables. Every point is the least of several rounds
that run through all points of a curve, so that what else the machine does touches all of them alike.
Installs matplotlib (pinned below) into a throw-away environment.
"""

import argparse
import json
import os
import pathlib
import random
import subprocess
import sys

sys.dont_write_bytecode = True  # nothing is left beside the sources
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import throw_away_environment  # noqa: E402

REQUIREMENTS = ["matplotlib==3.10.0", "numpy==2.2.1"]
HEADLINE = pathlib.Path(__file__).resolve().parents[3] / "scenes" / "cornell-three-lights.json"
VERTICES = 4e6  # of a run, about


def room(objects, materials, **more):
    """A white room of size 2 around the origin, seen from within."""
    sides = [((-1, -1, -1), (2, 0, 0), (0, 0, 2)), ((-1, 1, -1), (2, 0, 0), (0, 0, 2)),
             ((-1, -1, -1), (2, 0, 0), (0, 2, 0)), ((-1, -1, -1), (0, 2, 0), (0, 0, 2)),
             ((1, -1, -1), (0, 2, 0), (0, 0, 2)), ((-1, -1, 1), (2, 0, 0), (0, 2, 0))]
    walls = [{"name": f"wall {i}", "type": "rectangle", "corner": c, "edgeU": u, "edgeV": v,
              "material": "white"} for i, (c, u, v) in enumerate(sides)]
    return {"lightbench": 1, "camera": {"lookFrom": [0, 0, 0.95], "lookAt": [0, 0, 0], "vfov": 80},
            "materials": [{"name": "white", "type": "lambertian", "baseColor": [0.6, 0.6, 0.6]},
                          *materials],
            "objects": [*walls, *objects], **more}


def lamps(count):
    """Discs over the ceiling, of the same power in all."""
    rng = random.Random(1)
    radius = 0.4 / count ** 0.5
    lamp = {"name": "lamp", "type": "emissive", "emissive": [8, 8, 8]}
    discs = [{"name": f"lamp {i}", "type": "disc", "normal": [0, -1, 0], "radius": radius,
              "center": [rng.uniform(-0.95, 0.95), 0.99, rng.uniform(-0.95, 0.95)],
              "material": "lamp"} for i in range(count)]
    return room(discs, [lamp])


def balls(count):
    """Spheres in the room, filling a hundredth of it, and one lamp."""
    rng = random.Random(1)
    radius = (0.01 * 8 / count * 3 / 12.57) ** (1 / 3)
    lamp = {"name": "lamp", "type": "emissive", "emissive": [8, 8, 8]}
    spheres = [{"name": f"ball {i}", "type": "sphere", "radius": radius, "material": "white",
                "center": [rng.uniform(-0.9, 0.9) for _ in range(3)]} for i in range(count)]
    disc = {"name": "lamp", "type": "disc", "center": [0, 0.99, 0], "normal": [0, -1, 0],
            "radius": 0.4, "material": "lamp"}
    return room([disc, *spheres], [lamp])


def ground(count, folder):
    """A height field of about `count` triangles under a sky."""
    import numpy as np
    n = max(2, round((count / 2) ** 0.5) + 1)
    x, z = np.meshgrid(np.linspace(-1, 1, n), np.linspace(-1, 1, n))
    y = sum(0.3 / k * np.sin(3.1 * k * x + k) * np.cos(2.7 * k * z + 2 * k) for k in (1, 2, 5, 13, 31))
    corner = np.arange((n - 1) * n).reshape(n - 1, n)[:, :-1].ravel()
    faces = np.empty((2 * corner.size, 3), "<i4")
    faces[0::2] = np.stack([corner, corner + n, corner + 1], 1)
    faces[1::2] = np.stack([corner + 1, corner + n, corner + n + 1], 1)
    rows = np.empty(len(faces), [("n", "u1"), ("v", "<i4", 3)])
    rows["n"], rows["v"] = 3, faces
    file = folder / f"ground-{count}.ply"
    with open(file, "wb") as f:
        f.write(f"ply\nformat binary_little_endian 1.0\nelement vertex {n * n}\nproperty float x\n"
                f"property float y\nproperty float z\nelement face {len(faces)}\n"
                f"property list uchar int vertex_indices\nend_header\n".encode())
        f.write(np.stack([x, y, z], -1).astype("<f4").tobytes())
        f.write(rows.tobytes())
    return {"lightbench": 1, "camera": {"lookFrom": [0, 1.5, 2.2], "lookAt": [0, -0.2, 0], "vfov": 40},
            "environment": {"type": "constant", "color": [1, 1, 1]},
            "materials": [{"name": "white", "type": "lambertian", "baseColor": [0.6, 0.6, 0.6]}],
            "meshes": [{"name": "ground", "file": file.name}],
            "objects": [{"name": "ground", "type": "mesh", "mesh": "ground", "material": "white"}]}


def run(lightbench, folder, scene, *flags):
    stats = folder / "stats.json"
    subprocess.run([lightbench, "render", scene, "--progress", "none", "-o", folder / "picture.pfm",
                    "--stats-json", stats, *map(str, flags)], check=True, stdout=subprocess.DEVNULL)
    return json.loads(stats.read_text())


def curve(options, folder, points):
    """points: [(x, scene, flags)]; the figures of the fastest round of each."""
    best = {}
    for _ in range(options.rounds):
        for x, scene, flags in points:
            s = run(options.lightbench, folder, scene, *flags)
            if x not in best or s["renderSeconds"] < best[x]["renderSeconds"]:
                best[x] = s
    return [(x, best[x]) for x, _, _ in points]


def per_vertex(s):
    return 1e9 * s["renderSeconds"] * s["threads"] / s["rays"]


def table(title, head, rows):
    print(f"\n{title}\n\n| {' | '.join(head)} |\n|{'---|' * len(head)}")
    for row in rows:
        print("| " + " | ".join(row) + " |")
    sys.stdout.flush()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("lightbench")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--largest", type=int, default=10_000_000, help="triangles")
    options = parser.parse_args()
    folder = throw_away_environment.enter(REQUIREMENTS)

    def stored(name, scene):
        file = folder / f"{name}.json"
        file.write_text(json.dumps(scene))
        return file

    def decades(largest):
        n, all_of_them = 1, []
        while n <= largest:
            all_of_them.append(n)
            n *= 10
        return all_of_them

    small = ["--resolution", "200x200", "-t", 1]
    sides = [25, 50, 100, 200, 400, 800, 1600]
    pixels = curve(options, folder, [
        (n * n, HEADLINE, ["--resolution", f"{n}x{n}", "-t", 1,
                           "--spp", max(1, round(VERTICES / 3.2 / n / n))]) for n in sides])
    depths = curve(options, folder, [(d, HEADLINE, [*small, "--spp", 16, "--depth", d])
                                     for d in (1, 2, 3, 5, 10, 20, 50, 200)])
    threads = curve(options, folder, [(t, HEADLINE, ["--resolution", "400x400", "--spp", 16, "-t", t])
                                      for t in range(1, (os.cpu_count() or 1) + 1)])
    lights = curve(options, folder, [(n, stored(f"lamps-{n}", lamps(n)), [*small, "--spp", 16])
                                     for n in decades(100_000)])
    spheres = curve(options, folder, [(n, stored(f"balls-{n}", balls(n)), [*small, "--spp", 8])
                                      for n in decades(100_000)[1:]])
    triangles = curve(options, folder, [(n, stored(f"ground-{n}", ground(n, folder)),
                                         [*small, "--spp", 16])
                                        for n in decades(options.largest)[1:]])

    vertex = lambda points: [(f"{x:,}", f"{per_vertex(s):.0f}") for x, s in points]
    table("Headline scene, pixels", ["pixels", "ns per path vertex"], vertex(pixels))
    table("Headline scene, depth", ["depth", "ns per path", "segments per path", "ns per path vertex"],
          [(str(x), f"{per_vertex(s) * s['rays'] / s['samples']:.0f}",
            f"{s['rays'] / s['samples']:.2f}", f"{per_vertex(s):.0f}") for x, s in depths])
    table("Headline scene, threads", ["threads", "Mpaths/s"],
          [(str(x), f"{1e-6 * s['samplesPerSecond']:.2f}") for x, s in threads])
    table("Disc lights over a room", ["lights", "ns per path vertex"], vertex(lights))
    table("Spheres in a room", ["spheres", "ns per path vertex", "compiled in s"],
          [(*row, f"{s['compileSeconds']:.3g}") for row, (_, s) in zip(vertex(spheres), spheres)])
    table("Height field under a sky", ["triangles", "ns per path vertex", "compiled in s"],
          [(*row, f"{s['compileSeconds']:.3g}") for row, (_, s) in zip(vertex(triangles), triangles)])

    import matplotlib
    matplotlib.use("svg")
    matplotlib.rcParams["svg.hashsalt"] = "lightbench"  # the same file for the same numbers
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(2, 3, figsize=(12, 6.5), layout="constrained")
    plots = [("pixels", pixels, per_vertex, "ns per path vertex"),
             ("depth", depths, lambda s: per_vertex(s) * s["rays"] / s["samples"], "ns per path"),
             ("threads", threads, lambda s: 1e-6 * s["samplesPerSecond"], "Mpaths/s"),
             ("lights", lights, per_vertex, "ns per path vertex"),
             ("spheres", spheres, per_vertex, "ns per path vertex"),
             ("triangles", triangles, per_vertex, "ns per path vertex")]
    for ax, (name, points, figure_of, label) in zip(axes.flat, plots):
        ax.plot([x for x, _ in points], [figure_of(s) for _, s in points], "o-", color="#3366aa")
        if name == "threads":
            ax.set_xticks([x for x, _ in points])
        else:
            ax.set_xscale("log")
        ax.set_ylim(0, 1.08 * max(figure_of(s) for _, s in points))
        ax.set_xlabel(name)
        ax.set_ylabel(label)
        ax.grid(color="#dddddd")
        ax.spines[["top", "right"]].set_visible(False)
    figure.savefig(options.folder / "scaling.svg", metadata={"Date": None})


if __name__ == "__main__":
    main()

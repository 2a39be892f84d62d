#!/usr/bin/env python3
"""Lightbench beside Mitsuba 3, LuxCore and Cycles at equal time, scene by scene.

Usage: compare.py LIGHTBENCH [SCENE.json...] [--rivals mitsuba,luxcore,cycles] [--seconds 3] [--processor]

Installs the rivals (pinned below) into a throw-away environment; bpy, which holds Cycles, has wheels for
Python 3.11 only. Mitsuba's fast variant needs LLVM 16 or newer (Debian: apt-get install libllvm19, then
DRJIT_LIBLLVM_PATH=/usr/lib/x86_64-linux-gnu/libLLVM-19.so.1); without it the scalar one runs.

Pictures have 90,000 pixels; each renderer takes the power of two of samples per pixel that comes nearest to
--seconds, three times with seeds of its own: the least time counts (loading and compiling are not timed, or
are in the first alone) and the mean error. --processor counts processor seconds over the number of
processors instead, starting and writing included, for a machine with other work. Errors are relMSE,
mean((a - b)^2 / (b^2 + 0.01)), against 16 times as many samples of Lightbench, whose own error is subtracted.
A rival renders a scene only if it can say all of it (scene_file.py); the last column is how far the pictures'
means are apart, and two standard errors.
"""

import argparse
import concurrent.futures
import json
import math
import multiprocessing
import os
import pathlib
import resource
import subprocess
import sys

sys.dont_write_bytecode = True  # nothing is left beside the sources
HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]
import throw_away_environment  # noqa: E402

RIVALS = {"mitsuba": ("Mitsuba", "mitsuba==3.9.1"), "luxcore": ("LuxCore", "pyluxcore==2.11.2"),
          "cycles": ("Cycles", "bpy==5.0.1")}
SCENES = ["cornell-plain", "cornell-three-lights-static", "cornell-box", "cornell-smoke", "rest-of-life-final",
          "one-weekend-final", "quads", "earth", "features/many-lights"]
PIXELS = 90000
SEEDS = (1, 2, 3)
MEANS_AGREE = 0.003  # further apart it is not the same scene


def without_fuzz(scene):
    """The books' fuzz is nobody else's."""
    for material in scene["materials"]:
        material.pop("fuzz", None)


def lift_media(scene):
    """Mitsuba loses light where the boundary of a medium lies in the floor."""
    for o in scene["objects"]:
        if "medium" in o:
            o["transform"]["translation"][1] += 0.1


CHANGES = {"one-weekend-final": without_fuzz, "cornell-smoke": lift_media}


def prepare(path, folder):
    """The scene as all render it, its file's path and its size in pixels."""
    scene = json.loads(path.read_text())
    CHANGES.get(path.stem, lambda scene: None)(scene)
    for texture in scene.get("textures", []):
        if "file" in texture:
            texture["file"] = str((path.parent / texture["file"]).resolve())
    width, height = scene["render"]["resolution"]
    scale = math.sqrt(PIXELS / (width * height))
    changed = folder / path.name
    changed.write_text(json.dumps(scene))
    return changed, round(width * scale), round(height * scale)


def read_pfm(path):
    import numpy as np
    with open(path, "rb") as f:
        assert f.readline() == b"PF\n"
        width, height = map(int, f.readline().split())
        order = "<" if float(f.readline()) < 0 else ">"
        pixels = np.frombuffer(f.read(), order + "f4").reshape(height, width, 3)
    return pixels[::-1].astype(float)  # bottom row first


def lightbench(program, scene, width, height):
    picture, stats = scene.with_suffix(".pfm"), scene.with_suffix(".stats")

    def render(spp, seed):
        subprocess.run([program, "render", scene, "--resolution", f"{width}x{height}", "--spp", str(spp),
                        "--seed", str(seed), "--progress", "none", "-o", picture, "--stats-json", stats],
                       check=True, stdout=subprocess.DEVNULL)
        return read_pfm(picture), json.loads(stats.read_text())["renderSeconds"]

    return render


def processor_seconds():
    usage = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(u.ru_utime + u.ru_stime for u in usage)


def by_processor(render):
    """The same, timed by what it costs all processors, which other work hardly changes."""
    def timed(spp, seed):
        start = processor_seconds()
        picture, _ = render(spp, seed)
        return picture, (processor_seconds() - start) / os.cpu_count()

    return timed


def at_equal_time(render, seconds, processor):
    """spp, the least seconds, and pictures of three seeds."""
    if processor:
        render = by_processor(render)
    pilot, taken = 2, render(2, 100)[1]  # the first may compile
    while pilot == 2 or taken < seconds / 10:
        pilot *= 4
        taken = render(pilot, 101)[1]
    spp = 2 ** max(0, round(math.log2(pilot * seconds / taken)))
    pictures, times = zip(*(render(spp, seed) for seed in SEEDS))
    return spp, min(times), pictures


def rival(module, setting, scene, width, height, *timing):
    """In a process of its own: the rivals' libraries do not go together, and they print much."""
    silence = os.open(os.devnull, os.O_WRONLY)
    os.dup2(silence, 1)
    os.dup2(silence, 2)
    import scene_file
    renderer = __import__(module).renderer(scene_file.read(scene), width, height, setting)
    return at_equal_time(renderer, *timing)


class Reference:
    def __init__(self, render, spp):
        halves = [render(8 * spp, 1000)[0], render(8 * spp, 2000)[0]]
        self.picture = (halves[0] + halves[1]) / 2
        self.own = self.relative_square(halves[0] - halves[1]) / 4

    def relative_square(self, difference):
        return (difference ** 2 / (self.picture ** 2 + 0.01)).mean()

    def relmse(self, pictures):
        return sum(self.relative_square(p - self.picture) for p in pictures) / len(pictures) - self.own

    def mean_off(self, pictures):
        """Relative difference of the means, two standard errors."""
        off = (sum(pictures) / len(pictures) - self.picture).mean(axis=2)
        return off.mean() / self.picture.mean(), 2 * off.std() / math.sqrt(off.size) / self.picture.mean()


def compare(path, options, folder):
    """Prints the scene's table; efficiencies by renderer."""
    from scene_file import CannotTranslate
    scene, width, height = prepare(path, folder)
    timing = options.seconds, options.processor
    ours = lightbench(options.lightbench, scene, width, height)
    spp, seconds, pictures = at_equal_time(ours, *timing)
    reference = Reference(ours, spp)
    print(f"\n## {path.stem}\n\n{width}x{height}, reference of {16 * spp} spp, its relMSE {reference.own:.1e}\n\n"
          "| renderer | spp | s | relMSE | 1/(relMSE s) | mean |\n|---|---|---|---|---|---|")
    best = {}

    def report(renderer, setting, spp, seconds, pictures):
        error = reference.relmse(pictures)
        off, chance = reference.mean_off(pictures)
        wrong = " **another scene?**" if abs(off) > MEANS_AGREE + chance else ""
        print(f"| {renderer}{setting} | {spp} | {seconds:.2f} | {error:.3g} | {1 / (error * seconds):.3g} | "
              f"{100 * off:+.3f} ± {100 * chance:.3f} %{wrong} |", flush=True)
        best[renderer] = max(best.get(renderer, 0), 1 / (error * seconds))

    report("Lightbench", "", spp, seconds, pictures)
    for module in options.rivals.split(","):
        name, file = RIVALS[module][0], f"{module}_scene"
        for setting in __import__(file).SETTINGS:
            with concurrent.futures.ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
                job = pool.submit(rival, file, setting, scene, width, height, *timing)
                try:
                    report(name, f", {setting}", *job.result())
                except CannotTranslate as why:
                    print(f"| {name} | | | | | {why} |", flush=True)
                    break
    return best


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("lightbench", type=pathlib.Path)
    parser.add_argument("scenes", nargs="*", type=pathlib.Path,
                        default=[HERE.parents[2] / "scenes" / f"{name}.json" for name in SCENES])
    parser.add_argument("--rivals", default=",".join(RIVALS))
    parser.add_argument("--seconds", type=float, default=3)
    parser.add_argument("--processor", action="store_true")
    options = parser.parse_args()
    chosen = [RIVALS[name] for name in options.rivals.split(",")]
    folder = throw_away_environment.enter([*(requirement for _, requirement in chosen), "numpy", "pillow"])

    names = ["Lightbench", *(name for name, _ in chosen)]
    rows = []
    for path in options.scenes:
        best = compare(path, options, folder)
        rivals = [best[name] for name in names[1:] if name in best]
        ratio = f"{best['Lightbench'] / max(rivals):.1f}" if rivals else ""
        cells = [f"{best[name]:.3g}" if name in best else "" for name in names]
        rows.append(f"| {path.stem} | {' | '.join(cells)} | {ratio} |")
    print(f"\n## 1/(relMSE s)\n\n| scene | {' | '.join(names)} | ratio to the best rival |\n"
          f"|{'---|' * (len(names) + 2)}")
    print("\n".join(rows))


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Lightbench beside Mitsuba 3 on one scene, at equal samples and so by error and seconds.

Usage: compare.py LIGHTBENCH SCENE.json [--resolution WxH] [--spp 8,32,128] [--reference-spp N]

Installs Mitsuba (pinned below) into a throw-away environment. Its fast variant needs LLVM 16 or newer
(Debian: apt-get install libllvm19, then DRJIT_LIBLLVM_PATH=/usr/lib/x86_64-linux-gnu/libLLVM-19.so.1);
without it only the scalar variant runs. Errors are relMSE, mean((a - b)^2 / (b^2 + 0.01)), against a
long Lightbench render of another seed whose own expected error is subtracted; the bias column is the
ratio of the pictures' means.
"""

import argparse
import json
import os
import pathlib
import subprocess
import sys
import time

sys.dont_write_bytecode = True  # nothing is left beside the sources
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import throw_away_environment  # noqa: E402

REQUIREMENTS = ["mitsuba==3.9.1", "numpy"]


def read_pfm(path):
    import numpy as np
    with open(path, "rb") as f:
        assert f.readline() == b"PF\n"
        width, height = map(int, f.readline().split())
        order = "<" if float(f.readline()) < 0 else ">"
        pixels = np.frombuffer(f.read(), order + "f4").reshape(height, width, 3)
    return pixels[::-1].astype(float)  # bottom row first


def lightbench(options, spp, seed, folder, *more):
    picture, stats = folder / "picture.pfm", folder / "stats.json"
    subprocess.run([options.lightbench, "render", options.scene, "--resolution", options.resolution,
                    "--spp", str(spp), "--seed", str(seed), "--progress", "none", "-o", picture,
                    "--stats-json", stats, *more], check=True, stdout=subprocess.DEVNULL)
    return read_pfm(picture), json.loads(stats.read_text())["renderSeconds"]


def mitsuba(options, variant, sampler, spp):
    import mitsuba as mi
    import numpy as np
    from mitsuba_scene import convert
    mi.set_variant(variant)
    width, height = map(int, options.resolution.split("x"))
    scene = convert(mi, json.loads(pathlib.Path(options.scene).read_text()), width, height, sampler, spp)
    seconds = []
    for seed in (1, 2, 3):  # the first pays for compiling
        start = time.perf_counter()
        picture = np.array(mi.render(scene, spp=spp, seed=seed)).astype(float)
        seconds.append(time.perf_counter() - start)
    return picture, min(seconds)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("lightbench")
    parser.add_argument("scene")
    parser.add_argument("--resolution", default="300x300")
    parser.add_argument("--spp", default="8,32,128")
    parser.add_argument("--reference-spp", type=int, default=4096)
    options = parser.parse_args()
    folder = throw_away_environment.enter(REQUIREMENTS)
    sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

    reference, _ = lightbench(options, options.reference_spp, 1000, folder)
    half, _ = lightbench(options, options.reference_spp // 8, 2000, folder)

    def relmse(picture, own):
        return ((picture - reference) ** 2 / (reference ** 2 + 0.01)).mean() - own

    # The shorter render's error is the reference's and its own, 8 times that.
    own = relmse(half, 0) / 9
    print(f"reference: {options.reference_spp} spp, relMSE about {own:.2e}\n")
    print("| renderer | spp | s | relMSE | 1/(relMSE s) | mean |\n|---|---|---|---|---|---|")

    def report(name, spp, picture, seconds):
        error = relmse(picture, own)
        print(f"| {name} | {spp} | {seconds:.3f} | {error:.5f} | {1 / (error * seconds):.1f} | "
              f"{picture.mean() / reference.mean():.4f} |", flush=True)

    rivals = [("scalar_rgb", "multijitter")]
    if os.environ.get("DRJIT_LIBLLVM_PATH"):
        rivals += [("llvm_ad_rgb", "independent"), ("llvm_ad_rgb", "multijitter")]
    for spp in map(int, options.spp.split(",")):
        report("Lightbench", spp, *lightbench(options, spp, 1, folder))
        for variant, sampler in rivals:
            report(f"Mitsuba {variant}, {sampler}", spp, *mitsuba(options, variant, sampler, spp))


if __name__ == "__main__":
    main()

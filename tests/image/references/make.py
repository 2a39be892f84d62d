#!/usr/bin/env python3
"""Renders the missing references: make.py LIGHTBENCH_BINARY (see README.md)."""

import json
import pathlib
import re
import subprocess
import sys

SIDE, BLOCK, SPP, SEED = 48, 8, 2048, 1000


def size(resolution):
    """As pictures_test.cpp shrinks a scene."""
    scale = min(1.0, SIDE / max(resolution))
    return [max(1, int(n * scale / BLOCK + 0.5)) * BLOCK for n in resolution]


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    here = pathlib.Path(__file__).resolve().parent
    scenes = here.parents[2] / "scenes"
    for scene in sorted(scenes.rglob("*.json")):
        if scene.parent.name == "closed-form":
            continue
        name = re.sub("[^A-Za-z0-9]", "_", str(scene.relative_to(scenes).with_suffix("")))
        if (here / f"{name}.exr").exists():
            continue
        render = json.loads(scene.read_text(encoding="utf-8"))["render"]
        width, height = size(render["resolution"])
        print(name, flush=True)
        subprocess.run([sys.argv[1], "render", scene, "--kernel", "reference", "--spp", str(SPP),
                        "--seed", str(SEED), "--resolution", f"{width}x{height}", "--progress", "none",
                        "-o", here / f"{name}.exr"], check=True)


if __name__ == "__main__":
    main()

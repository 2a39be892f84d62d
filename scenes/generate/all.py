#!/usr/bin/env python3
"""Writes every generated scene, mesh and environment picture (all but earth.png, see earth.py).

    python3 scenes/generate/all.py [FOLDER]      default: the scenes folder this script lives in

A test runs it into an empty folder and compares the files with the committed ones, byte for byte.
"""

import pathlib
import sys

sys.dont_write_bytecode = True

import book_scenes  # noqa: E402
import features  # noqa: E402
import meshes  # noqa: E402
import sky  # noqa: E402


def main():
    if len(sys.argv) > 2:
        sys.exit("usage: all.py [FOLDER]")
    default = pathlib.Path(__file__).resolve().parent.parent
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) == 2 else default
    for part in (book_scenes, features, meshes, sky):
        part.write(folder)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Writes a large triangle mesh for timing builds and edits: rolling terrain as binary PLY.

    python3 heightfield.py OUT.ply [TRIANGLES]

About TRIANGLES triangles (default 300000), 10 x 10 units in x and z, heights within +-1, centre at the
origin, normals included. It is made, not stored: 300000 triangles are 7.5 MB.
"""

import argparse
import array
import math
import sys

WAVES = [(0.9, 0.31, 0.42, 0.40), (-0.5, 1.1, 1.3, 0.22), (2.3, -1.7, 0.2, 0.10), (-3.9, -4.6, 2.9, 0.05),
         (9.1, 6.3, 0.7, 0.022), (-17.0, 13.0, 1.9, 0.010)]  # wave number x, z, phase, height


def point(x, z):
    """Height and unit normal of a sum of sines."""
    height = slope_x = slope_z = 0.0
    for kx, kz, phase, amplitude in WAVES:
        angle = kx * x + kz * z + phase
        height += amplitude * math.sin(angle)
        slope_x += amplitude * kx * math.cos(angle)
        slope_z += amplitude * kz * math.cos(angle)
    length = math.sqrt(1 + slope_x * slope_x + slope_z * slope_z)
    return height, (-slope_x / length, 1 / length, -slope_z / length)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", metavar="OUT.ply")
    parser.add_argument("triangles", metavar="TRIANGLES", type=int, nargs="?", default=300000)
    arguments = parser.parse_args()
    cells = max(1, round(math.sqrt(arguments.triangles / 2)))
    vertices, faces = array.array("f"), bytearray()
    for i in range(cells + 1):
        for j in range(cells + 1):
            x, z = 10 * i / cells - 5, 10 * j / cells - 5
            height, normal = point(x, z)
            vertices.extend((x, height, z, *normal))
    for i in range(cells):
        for j in range(cells):
            a = i * (cells + 1) + j
            b, c, d = a + 1, a + cells + 1, a + cells + 2
            for triangle in ((a, b, d), (a, d, c)):
                faces += b"\x03" + array.array("i", triangle).tobytes()
    header = "\n".join([
        "ply", f"format binary_{sys.byteorder}_endian 1.0", f"element vertex {(cells + 1) ** 2}",
        *(f"property float {name}" for name in ("x", "y", "z", "nx", "ny", "nz")),
        f"element face {2 * cells * cells}", "property list uchar int vertex_indices", "end_header", ""])
    with open(arguments.out, "wb") as file:
        file.write(header.encode("ascii") + vertices.tobytes() + faces)


if __name__ == "__main__":
    main()

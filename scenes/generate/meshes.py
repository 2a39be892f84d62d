"""Triangle meshes as ASCII PLY files with normals."""

import math
import pathlib


def write_ply(path, positions, normals, triangles):
    lines = [
        "ply", "format ascii 1.0", f"element vertex {len(positions)}",
        *(f"property float {name}" for name in ("x", "y", "z", "nx", "ny", "nz")),
        f"element face {len(triangles)}", "property list uchar int vertex_indices", "end_header",
    ]
    for vertex in zip(positions, normals):
        lines.append(" ".join(f"{x + 0.0:.4f}" for part in vertex for x in part))
    lines += ("3 %d %d %d" % triangle for triangle in triangles)
    path = pathlib.Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join(lines) + "\n", encoding="ascii", newline="\n")


def add(a, b, scale=1.0):
    return tuple(x + scale * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    length = math.hypot(*a)
    return tuple(x / length for x in a)


def closed_grid(rows, columns):
    """Triangles of a torus-shaped grid, counter-clockwise seen from rows x columns."""
    triangles = []
    for i in range(rows):
        for j in range(columns):
            a, b = i * columns + j, i * columns + (j + 1) % columns
            c, d = (i + 1) % rows * columns + j, (i + 1) % rows * columns + (j + 1) % columns
            triangles += [(a, c, d), (a, d, b)]
    return triangles


def knot(p=2, q=3, rows=160, columns=14, tube=0.34):
    """A tube around the (p, q) torus knot, 3.4 wide and 1.8 high, about the y axis."""

    def spine(t):
        r = 1 + 0.45 * math.cos(q * t)
        return (r * math.cos(p * t), 0.45 * math.sin(q * t) * 1.2, r * math.sin(p * t))

    positions, normals = [], []
    for i in range(rows):
        t = 2 * math.pi * i / rows
        here, ahead = spine(t), spine(t + 1e-4)
        along = unit(add(ahead, here, -1))
        side = unit(cross(along, add(here, ahead)))
        up = cross(side, along)
        for j in range(columns):
            angle = 2 * math.pi * j / columns
            normal = add(tuple(math.cos(angle) * x for x in side), up, math.sin(angle))
            normals.append(normal)
            positions.append(add(here, normal, tube))
    return positions, normals, closed_grid(rows, columns)


def write(folder):
    write_ply(folder / "meshes" / "knot.ply", *knot())

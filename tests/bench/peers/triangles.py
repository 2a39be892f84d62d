"""Unit shapes as triangles, for renderers that have no others."""

import numpy as np

from scene_file import CannotTranslate

SEGMENTS = 256  # around a sphere, cylinder or disc: its area is short by 1e-4


def check_scene(scene):
    """Refuses what its users do not have, and balls so large that their facets would show."""
    if scene.lens_radius:
        raise CannotTranslate("camera: a lens is not translated")
    if (scene.zenith != scene.nadir).any():
        raise CannotTranslate("environment: a gradient is not translated")
    for surface in scene.surfaces:
        if surface.kind == "none" or surface.medium:
            raise CannotTranslate(f"{surface.name}: a medium is not translated")
        for part in (part for part in surface.parts if part.kind == "sphere"):
            if surface.radiance.any():
                raise CannotTranslate(f"{surface.name}: a ball of triangles is no light")
            if np.linalg.norm(part.matrix[:3, 0]) > np.linalg.norm(scene.look_from - scene.look_at):
                raise CannotTranslate(f"{surface.name}: the facets of so large a ball would show")


def grid(rows, columns):
    """Quads between rows * columns points as triangles."""
    i = np.arange((rows - 1) * columns).reshape(rows - 1, columns)[:, :-1].ravel()
    return np.concatenate([np.stack([i, i + 1, i + columns + 1], 1), np.stack([i, i + columns + 1, i + columns], 1)])


def sphere():
    rows = SEGMENTS // 2 + 1
    v, u = np.meshgrid(np.linspace(0, 1, rows), np.linspace(0, 1, SEGMENTS + 1), indexing="ij")
    theta, phi = np.pi * (1 - v), 2 * np.pi * u
    normals = np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], -1)
    normals = normals.reshape(-1, 3)
    return normals, grid(rows, SEGMENTS + 1), normals, np.stack([u, v], -1).reshape(-1, 2)


def cylinder():
    phi = np.linspace(0, 2 * np.pi, SEGMENTS + 1)
    round_ = np.stack([np.cos(phi), np.sin(phi), 0 * phi], 1)
    return np.concatenate([round_, round_ + [0, 0, 1]]), grid(2, SEGMENTS + 1), np.concatenate([round_, round_]), None


def disk():
    phi = np.linspace(0, 2 * np.pi, SEGMENTS, endpoint=False)
    rim = np.stack([np.cos(phi), np.sin(phi), 0 * phi], 1)
    i = np.arange(SEGMENTS)
    faces = np.stack([i, (i + 1) % SEGMENTS, np.full_like(i, SEGMENTS)], 1)
    return np.concatenate([rim, [[0, 0, 0]]]), faces, None, None


def rectangle():
    return np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0.0]]), np.array([[0, 1, 2], [0, 2, 3]]), None, None


def cube():
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    return corners, np.array([[q[0], *q[k:k + 2]] for q in quads for k in (1, 2)]), None, None


UNIT = {"sphere": sphere, "cylinder": cylinder, "disk": disk, "rectangle": rectangle, "cube": cube}


def triangles_of(part):
    """Positions, faces (counter-clockwise from the front), unit normals or None, uvs or None."""
    if part.kind == "triangles":
        return part.positions, part.faces, None, None
    positions, faces, normals, uvs = UNIT[part.kind]()
    linear = part.matrix[:3, :3]
    if normals is not None:  # the linear map keeps the angles around the round shapes
        normals = normals @ linear.T
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return positions @ linear.T + part.matrix[:3, 3], faces, normals, uvs

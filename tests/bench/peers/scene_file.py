"""A Lightbench scene (docs/scene-format.md) in words that other renderers share.

Raises CannotTranslate, which names the feature, for what they would not render alike: a rival that
renders another scene proves nothing.
"""

import json
import math
import pathlib
from dataclasses import dataclass, field

import numpy as np


class CannotTranslate(ValueError):
    pass


@dataclass
class Part:
    """A unit shape and its 4x4 matrix to the world, or triangles in the world."""
    kind: str  # sphere, disk, rectangle (-1..1)^2, cube (-1..1)^3, cylinder (z 0..1), triangles
    matrix: np.ndarray = field(default_factory=lambda: np.eye(4))
    positions: np.ndarray = None
    faces: np.ndarray = None


@dataclass
class Surface:
    name: str
    parts: list
    kind: str  # lambertian, metal (a mirror), dielectric, emissive, or none: only a medium's boundary
    color: np.ndarray
    texture: np.ndarray  # linear RGB, row 0 at v = 1; multiplies color
    ior: float
    radiance: np.ndarray  # from the front only
    medium: dict  # density, albedo


@dataclass
class Scene:
    look_from: np.ndarray
    look_at: np.ndarray
    up: np.ndarray
    vfov: float
    lens_radius: float
    focus_distance: float
    max_depth: int
    roulette_depth: int
    zenith: np.ndarray  # radiance from straight up; linear in y down to
    nadir: np.ndarray
    surfaces: list


def refuse_others(entry, where, known):
    for key, value in entry.items():
        if key not in known and value and np.any(value):
            raise CannotTranslate(f"{where}: {key} {json.dumps(value)[:40]} is not translated")


def placement(transform, where):
    """4x4 matrix: scale, then rotate, then translate."""
    matrix = np.eye(4)
    scale = transform.get("scale", 1)
    matrix[:3, :3] = np.diag(scale if isinstance(scale, list) else [scale] * 3)
    rotation = transform.get("rotation")
    if isinstance(rotation, list):
        raise CannotTranslate(f"{where}: a quaternion is not translated")
    if rotation:
        x, y, z = unit(rotation.get("axis", [0, 1, 0]))
        angle = math.radians(rotation["degrees"])
        cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        turn = np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross
        matrix[:3, :3] = turn @ matrix[:3, :3]
    matrix[:3, 3] = transform.get("translation", [0, 0, 0])
    return matrix


def unit(v):
    return np.array(v, float) / np.linalg.norm(v)


def affine(x, y, z, origin):
    matrix = np.eye(4)
    matrix[:3] = np.stack([x, y, z, origin], axis=1)
    return matrix


def along(axis, radius, origin):
    """Maps +z to `axis` with its length, x and y to lengths of `radius`."""
    z = unit(axis)
    x = unit(np.cross([0, 1, 0] if abs(z[1]) < 0.9 else [1, 0, 0], z))
    return affine(radius * x, radius * np.cross(z, x), axis, origin)


SHAPE_KEYS = {"sphere": {"center", "radius"}, "disc": {"center", "normal", "radius"},
              "rectangle": {"corner", "edgeU", "edgeV"}, "triangle": {"a", "b", "c"},
              "box": {"min", "max"}, "cylinder": {"p0", "p1", "radius"}, "pyramid": {"vertices"}}


def parts_of(o, where):
    """The object's parts before its own transform."""
    v = {key: np.array(value, float) for key, value in o.items() if key in SHAPE_KEYS[o["type"]]}
    kind, zero = o["type"], np.zeros(3)
    if kind == "sphere":  # its poles along y, u from -x by way of z: z is the pole of other renderers
        r = float(v.get("radius", 1))
        return [Part("sphere", affine([-r, 0, 0], [0, 0, r], [0, r, 0], v.get("center", zero)))]
    if kind == "disc":
        normal = unit(v.get("normal", [0, 1, 0])) * float(v.get("radius", 1))
        return [Part("disk", along(normal, float(v.get("radius", 1)), v.get("center", zero)))]
    if kind == "rectangle":
        half_u, half_v = v["edgeU"] / 2, v["edgeV"] / 2
        if abs(unit(half_u) @ unit(half_v)) > 1e-6:
            raise CannotTranslate(f"{where}: a parallelogram is not translated")
        return [Part("rectangle", affine(half_u, half_v, unit(np.cross(half_u, half_v)),
                                         v["corner"] + half_u + half_v))]
    if kind == "box":
        half = (v["max"] - v["min"]) / 2
        return [Part("cube", affine(*np.diag(half), v["min"] + half))]
    if kind == "cylinder":
        axis, radius = v["p1"] - v["p0"], float(v["radius"])
        cap = unit(axis) * radius
        return [Part("cylinder", along(axis, radius, v["p0"])),
                Part("disk", along(cap, radius, v["p1"])), Part("disk", along(-cap, radius, v["p0"]))]
    if kind == "triangle":
        return [Part("triangles", positions=np.stack([v["a"], v["b"], v["c"]]), faces=np.array([[0, 1, 2]]))]
    p, faces = v["vertices"], [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]]  # pyramid
    if np.linalg.det(p[1:] - p[0]) < 0:
        faces = [face[::-1] for face in faces]
    return [Part("triangles", positions=p, faces=np.array(faces))]


def placed(part, transform, where):
    linear = transform[:3, :3]
    scale = np.cbrt(abs(np.linalg.det(linear)))
    if not np.allclose(linear.T @ linear, scale ** 2 * np.eye(3), rtol=1e-9, atol=1e-9 * scale ** 2):
        raise CannotTranslate(f"{where}: uneven scale is not translated")
    if np.linalg.det(linear) < 0:
        raise CannotTranslate(f"{where}: a mirroring scale is not translated")
    if part.kind == "triangles":
        return Part("triangles", positions=part.positions @ linear.T + transform[:3, 3], faces=part.faces)
    return Part(part.kind, transform @ part.matrix)


def read_texture(texture, folder):
    from PIL import Image
    where = f"texture {texture['name']}"
    if texture["type"] != "image":
        raise CannotTranslate(f"{where}: {texture['type']} is not translated")
    refuse_others(texture, where, {"name", "type", "file"})
    codes = np.asarray(Image.open(folder / texture["file"]).convert("RGB")) / 255.0
    return np.where(codes <= 0.04045, codes / 12.92, ((codes + 0.055) / 1.055) ** 2.4).astype(np.float32)


def surface_of(o, materials, textures, media):
    where = f"object {o.get('name', o['type'])}"
    if o["type"] not in SHAPE_KEYS:
        raise CannotTranslate(f"{where}: {o['type']} is not translated")
    refuse_others(o, where, {"name", "type", "material", "medium", "transform", "visible", *SHAPE_KEYS[o["type"]]})
    material = materials.get(o.get("material"), {"type": "none"})
    kind = material["type"]
    named = f"material {material.get('name')}"
    refuse_others(material, named, {"name", "type", "baseColor", "baseColorTexture", "ior", "emissive",
                                    "emissiveStrength"})
    color = np.array(material.get("baseColor", [0.8] * 3), float)
    radiance = np.array(material.get("emissive", [0] * 3), float) * material.get("emissiveStrength", 1)
    if radiance.any() and (kind != "emissive" or o["type"] not in ("sphere", "disc", "rectangle")):
        raise CannotTranslate(f"{where}: lights are translated as black spheres, discs and rectangles only")
    texture = textures.get(material.get("baseColorTexture"))
    if texture is not None and (kind != "lambertian" or o["type"] != "sphere"):
        raise CannotTranslate(f"{where}: textures are translated on diffuse spheres only")
    if kind == "dielectric" and (color != 1).any():
        raise CannotTranslate(f"{named}: tinted glass is not translated")
    medium = media.get(o.get("medium"))
    if medium and kind != "none":
        raise CannotTranslate(f"{where}: a medium inside a material is not translated")
    transform = placement(o.get("transform", {}), where)
    parts = [placed(part, transform, where) for part in parts_of(o, where)]
    return Surface(where, parts, kind, color, texture, material.get("ior", 1.5), radiance, medium)


def read(path):
    """The Scene in a file; CannotTranslate if not all of it can be said."""
    path = pathlib.Path(path)
    scene = json.loads(path.read_text())
    camera, render, environment = (scene.get(key, {}) for key in ("camera", "render", "environment"))
    refuse_others(camera, "camera", {"lookFrom", "lookAt", "up", "vfov", "lensRadius", "focusDistance", "shutter"})
    # The size and count of samples are the comparison's; so are the choices that leave the mean alone.
    refuse_others(render, "render", {"resolution", "spp", "timeLimit", "maxDepth", "rouletteDepth", "strategy",
                                     "lightChoice", "sampler", "seed", "adaptive", "snapshots"})
    if environment.get("type") == "image":
        raise CannotTranslate("environment: an image is not translated")
    zenith = np.array(environment.get("color", [0] * 3), float) * environment.get("strength", 1)
    nadir = zenith
    if environment.get("type") == "gradient":
        nadir = np.array(environment.get("horizon", [1] * 3), float) * environment.get("strength", 1)
    materials, media = ({e["name"]: e for e in scene.get(key, [])} for key in ("materials", "media"))
    textures = {t["name"]: read_texture(t, path.parent) for t in scene.get("textures", [])}
    surfaces = [surface_of(o, materials, textures, media) for o in scene["objects"] if o.get("visible", True)]
    return Scene(np.array(camera["lookFrom"], float), np.array(camera["lookAt"], float),
                 np.array(camera.get("up", [0, 1, 0]), float), camera.get("vfov", 40),
                 camera.get("lensRadius", 0), camera.get("focusDistance", 10), render.get("maxDepth", 50),
                 render.get("rouletteDepth", 4), zenith, nadir, surfaces)

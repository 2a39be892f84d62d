"""features/*.json: small pictures that show one feature each, in one common little studio.

The studio: a pale floor, a dim sky and one large lamp to the left. Night scenes leave out sky and lamp.
"""

import colorsys
import math
import random

from meshes import add, cross, unit
from scene_file import rotation, write_scene

CORAL, TEAL, MUSTARD = [0.80, 0.25, 0.17], [0.05, 0.42, 0.42], [0.85, 0.57, 0.12]
NAVY, CREAM, FLOOR = [0.07, 0.13, 0.34], [0.82, 0.76, 0.64], [0.55, 0.52, 0.48]
PAINTS = {"coral": CORAL, "teal": TEAL, "mustard": MUSTARD, "navy": NAVY, "cream": CREAM}


def matte(name, color, **more):
    return {"name": name, "type": "lambertian", "baseColor": color} | more


def textured(name):
    return matte(name, [1, 1, 1], baseColorTexture=name)


def lamp(name, color, strength, **more):
    return {"name": name, "type": "emissive", "emissive": color, "emissiveStrength": strength} | more


def glass(name="glass", ior=1.5, color=(1, 1, 1)):
    return {"name": name, "type": "dielectric", "baseColor": list(color), "ior": ior}


def sphere(name, center, radius, material, **more):
    return {"name": name, "type": "sphere", "center": center, "radius": radius} | \
        ({"material": material} if material else {}) | more


def panel(name, center, target, width, height, material):
    """A rectangle around `center` whose front looks at `target`, upright."""
    normal = unit(add(target, center, -1))
    across = unit(cross((0, 1, 0), normal))
    up = cross(normal, across)
    corner = add(add(center, across, -width / 2), up, -height / 2)
    return {"name": name, "type": "rectangle", "corner": corner,
            "edgeU": [width * x for x in across], "edgeV": [height * x for x in up],
            "material": material}


def moved(x, y, z, axis=(0, 1, 0), degrees=0, scale=1):
    transform = {"translation": [x, y, z]}
    if degrees:
        transform["rotation"] = rotation(list(axis), degrees)
    if scale != 1:
        transform["scale"] = scale
    return transform


def studio(objects, materials=(), sky=0.75, key=14.0, camera=None, **lists):
    """A scene with the floor, the lamp (radiance `key`, 0 = none) and the sky (0 = night)."""
    scene = {
        "camera": {"lookFrom": [0, 2.6, 7.5], "lookAt": [0, 0.8, 0], "vfov": 30} | (camera or {}),
        "render": {"resolution": [400, 300], "spp": 500, "maxDepth": 50},
    }
    if sky:
        scene["environment"] = {"type": "gradient", "color": [0.5, 0.7, 1], "horizon": [1, 1, 1],
                                "strength": sky}
    used = {item.get("material") for item in objects}
    fittings = [{"name": "floor", "type": "disc", "center": [0, 0, 0], "normal": [0, 1, 0],
                 "radius": 40, "material": "floor"}]
    paints = [matte("floor", FLOOR)] + [matte(n, c) for n, c in PAINTS.items() if n in used]
    if key:
        paints.append(lamp("lamp", [1, 0.93, 0.82], key))
        fittings.append(panel("lamp", (-3.6, 5.2, 3.4), (0, 0.6, 0), 2.4, 2.4, "lamp"))
    scene |= {name: list(items) for name, items in lists.items()}
    scene["materials"] = paints + list(materials)
    scene["objects"] = fittings + list(objects)
    return scene


# ---- one scene per shape ---------------------------------------------------------------------------


def shape_sphere():
    return studio([
        sphere("large", [-1.1, 0.9, 0], 0.9, "coral"),
        sphere("small", [0.35, 0.4, 1.1], 0.4, "mustard"),
        sphere("egg", [0, 0, 0], 1, "teal", transform={
            "translation": [1.4, 0.7, -0.3], "rotation": rotation([0, 0, 1], 35),
            "scale": [1.1, 0.6, 0.6]}),
    ])


def shape_cylinder():
    def rod(name, p0, p1, radius, material):
        return {"name": name, "type": "cylinder", "p0": p0, "p1": p1, "radius": radius,
                "material": material}
    return studio([
        rod("drum", [-1.3, 0, -0.2], [-1.3, 1.1, -0.2], 0.7, "teal"),
        rod("leaning rod", [0.1, 0.12, -0.4], [1.5, 2.0, -0.4], 0.12, "coral"),
        rod("log", [0.5, 0.35, 0.9], [1.9, 0.35, 0.2], 0.35, "mustard"),
        rod("coin", [-0.3, 0, 1.3], [-0.3, 0.08, 1.3], 0.4, "cream"),
    ])


def shape_disc():
    return studio([
        {"name": f"disc {i + 1}", "type": "disc", "center": [-1.8 + 0.9 * i, 0.8, 0.35 * i - 0.7],
         "normal": [math.sin(0.35 * i - 0.9), 0.25, math.cos(0.35 * i - 0.9)], "radius": 0.48 - 0.02 * i,
         "material": material} for i, material in enumerate(PAINTS)
    ])


def shape_rectangle():
    return studio([
        {"name": f"card {i + 1}", "type": "rectangle", "corner": [-0.45, 0, 0], "edgeU": [0.9, 0, 0],
         "edgeV": [0, 1.3, -0.15], "transform": moved(-1.7 + 0.85 * i, 0.02, 0.5 - abs(i - 2) * 0.35,
                                                      degrees=55 - 27 * i + 0.5),
         "material": material} for i, material in enumerate(PAINTS)
    ])


def shape_triangle():
    paints = list(PAINTS)
    blades = []
    for i in range(10):
        a, b = 2 * math.pi * i / 10, 2 * math.pi * (i + 0.8) / 10
        blades.append({
            "name": f"blade {i + 1}", "type": "triangle", "a": [0, 1.3, 0],
            "b": [1.25 * math.cos(a), 1.3 + 1.25 * math.sin(a), 0.3],
            "c": [1.25 * math.cos(b), 1.3 + 1.25 * math.sin(b), -0.3], "material": paints[i % 5]})
    return studio(blades)


def shape_pyramid():
    def pyramid(name, transform, material):
        corner = [[0.94 * math.cos(a), 0, 0.94 * math.sin(a)] for a in (0.4, 2.49, 4.59)]
        return {"name": name, "type": "pyramid", "vertices": [[0, 1.33, 0]] + corner,
                "transform": transform, "material": material}
    return studio([
        pyramid("left", moved(-1.3, 0, 0), "teal"),
        pyramid("right", moved(1.2, 0, -0.4, degrees=50, scale=1.3), "coral"),
        pyramid("front", moved(0.1, 0, 1.2, degrees=20, scale=0.6), "mustard"),
    ])


def shape_box():
    def box(name, size, transform, material):
        w, h, d = (x / 2 for x in size)
        return {"name": name, "type": "box", "min": [-w, 0, -d], "max": [w, 2 * h, d],
                "transform": transform, "material": material}
    return studio([
        box("base", (1.8, 0.5, 1.8), moved(-0.5, 0, 0, degrees=20), "navy"),
        box("middle", (1.3, 0.5, 1.3), moved(-0.5, 0.5, 0, degrees=50), "teal"),
        box("top", (0.8, 0.8, 0.8), moved(-0.5, 1, 0, degrees=12), "mustard"),
        box("leaning", (1.2, 1.2, 0.15), moved(1.35, 0, 0.1, (1, 1, 0), -25), "coral"),
        box("die", (0.5, 0.5, 0.5), moved(0.7, 0, 1.4, degrees=35), "cream"),
    ])


KNOT = {"name": "knot", "file": "../meshes/knot.ply"}
OCTAHEDRON = {"name": "octahedron",
              "positions": [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]],
              "triangles": [[0, 2, 4], [4, 2, 1], [1, 2, 5], [5, 2, 0],
                            [4, 3, 0], [1, 3, 4], [5, 3, 1], [0, 3, 5]]}


def shape_mesh():
    return studio([
        {"name": "knot", "type": "mesh", "mesh": "knot",
         "transform": moved(-0.5, 1.35, -0.3, (1, 0, 0), 62, 0.82), "material": "coral"},
        {"name": "octahedron", "type": "mesh", "mesh": "octahedron",
         "transform": moved(1.5, 0.62, 0.8, (0, 1, 0), 25, 0.62), "material": "teal"},
    ], meshes=[KNOT, OCTAHEDRON])


# ---- materials, textures, media --------------------------------------------------------------------


def metal_fuzz_and_roughness():
    """Front row: the books' fuzz 0..0.8; back row: GGX roughness 0..0.8."""
    amounts = [0, 0.15, 0.3, 0.5, 0.8]
    gold, steel = [0.95, 0.72, 0.36], [0.80, 0.83, 0.86]
    materials, objects = [], []
    for i, amount in enumerate(amounts):
        x = -1.9 + 0.95 * i
        materials += [
            {"name": f"fuzz {amount}", "type": "metal", "baseColor": gold, "fuzz": amount},
            {"name": f"roughness {amount}", "type": "metal", "baseColor": steel, "roughness": amount}]
        objects += [sphere(f"fuzz {amount}", [x, 0.42, 0.9], 0.42, f"fuzz {amount}"),
                    sphere(f"roughness {amount}", [x, 1.1, -0.4], 0.42, f"roughness {amount}")]
    objects += [
        {"name": "shelf", "type": "box", "min": [-2.6, 0, -0.9], "max": [2.6, 0.68, 0.1], "material": "navy"},
        panel("backdrop", (0, 1.4, -2.6), (0, 1.4, 0), 6, 1.2, "coral"),
    ]
    return studio(objects, materials)


def glass_shapes():
    """Solid glass, a bubble (an inner sphere of the inverse index), a diamond-like index, a slab."""
    return studio([
        sphere("solid", [-1.5, 0.7, 0.2], 0.7, "glass"),
        sphere("bubble outside", [0.15, 0.7, 0.2], 0.7, "glass"),
        sphere("bubble inside", [0.15, 0.7, 0.2], 0.64, "air in glass"),
        {"name": "prism", "type": "pyramid", "vertices": [[0, 1.1, 0], [0.8, 0, 0.4], [-0.8, 0, 0.4], [0, 0, -0.8]],
         "transform": moved(1.8, 0.002, 0.3, degrees=25), "material": "dense glass"},
        {"name": "slab", "type": "box", "min": [-0.5, 0, -0.08], "max": [0.5, 0.7, 0.08],
         "transform": moved(0.95, 0.002, 1.5, degrees=-25), "material": "green glass"},
        sphere("behind left", [-1.1, 0.45, -1.8], 0.45, "coral"),
        sphere("behind middle", [0.2, 0.45, -2.0], 0.45, "teal"),
        sphere("behind right", [1.4, 0.45, -1.8], 0.45, "mustard"),
    ], [glass(), glass("air in glass", 1 / 1.5), glass("dense glass", 2.4),
        glass("green glass", 1.5, (0.6, 0.95, 0.75))])


def texture_gallery():
    textures = [
        {"name": "constant", "type": "constant", "colorA": CORAL},
        {"name": "image", "type": "image", "file": "../textures/earth.png"},
        {"name": "checker", "type": "checker", "colorA": CREAM, "colorB": TEAL, "scale": 5},
        {"name": "checker uv", "type": "checker", "colorA": CREAM, "colorB": CORAL, "scale": 16, "useUv": True},
        {"name": "noise", "type": "noise", "colorA": NAVY, "colorB": CREAM, "scale": 7},
        {"name": "turbulence", "type": "turbulence", "colorA": [0.9, 0.9, 0.9], "colorB": [0.30, 0.08, 0.02], "scale": 4},
        {"name": "marble", "type": "marble", "colorA": [0.04, 0.07, 0.06], "colorB": [0.85, 0.85, 0.8], "scale": 5},
    ]
    places = [(-1.2, 1.22, -0.7), (0, 1.22, -0.7), (1.2, 1.22, -0.7),
              (-1.8, 0.52, 0.7), (-0.6, 0.52, 0.7), (0.6, 0.52, 0.7), (1.8, 0.52, 0.7)]
    objects = [sphere(t["name"], list(p), 0.52, t["name"]) for t, p in zip(textures, places)]
    objects.append({"name": "shelf", "type": "box", "min": [-2.1, 0, -1.3], "max": [2.1, 0.7, -0.1], "material": "cream"})
    return studio(objects, [textured(t["name"]) for t in textures], textures=textures)


def media():
    return studio([
        {"name": "smoke", "type": "box", "min": [-0.6, 0, -0.6], "max": [0.6, 1.2, 0.6],
         "transform": moved(-1.5, 0.002, 0, degrees=30), "medium": "dark smoke"},
        {"name": "fog", "type": "cylinder", "p0": [0.2, 0.002, -0.6], "p1": [0.2, 1.5, -0.6], "radius": 0.55,
         "medium": "white fog"},
        sphere("jade", [1.5, 0.65, 0.2], 0.65, "glass", medium="green wax"),
        {"name": "tea", "type": "box", "min": [-0.35, 0, -0.35], "max": [0.35, 0.55, 0.35],
         "transform": moved(0.2, 0.002, 1.3, degrees=15), "medium": "amber", "material": "glass"},
        sphere("ball behind", [-0.8, 0.5, -1.6], 0.5, "coral"),
        sphere("ball in fog", [0.2, 0.6, -0.6], 0.25, "mustard"),
    ], [glass()], media=[
        {"name": "dark smoke", "density": 2, "albedo": [0.35, 0.35, 0.38]},
        {"name": "white fog", "density": 2.5, "albedo": [1, 1, 1]},
        {"name": "green wax", "density": 6, "albedo": [0.55, 0.93, 0.65]},
        {"name": "amber", "density": 2.5, "albedo": [0.8, 0.3, 0.05]},
    ])


# ---- camera, motion, instances ---------------------------------------------------------------------


def depth_of_field():
    paints = list(PAINTS)
    row = [sphere(f"ball {i + 1}", [0.42 * i - 1.9 + 0.02 * i * i, 0.35, 3.6 - 0.85 * i], 0.35, paints[i % 5])
           for i in range(10)]
    # Focused on ball 5: its distance along the view axis.
    eye, target = (0, 1.3, 7.5), (0, 0.5, 0)
    view = unit(add(target, eye, -1))
    focus = sum(a * b for a, b in zip(view, add(row[4]["center"], eye, -1)))
    return studio(row, camera={"lookFrom": list(eye), "lookAt": list(target), "vfov": 26,
                               "lensRadius": 0.16, "focusDistance": focus})


def motion_blur():
    return studio([
        sphere("rising", [-1.6, 0.45, 0], 0.45, "coral", motion=[0, 1.1, 0]),
        sphere("passing", [-0.5, 0.45, 0.6], 0.45, "mustard", motion=[1.1, 0, 0]),
        sphere("resting", [1.7, 0.6, -0.4], 0.6, "teal"),
        sphere("approaching", [0.5, 1.6, -2.5], 0.4, "cream", motion=[0.3, 0.2, 1.6]),
    ], camera={"shutter": [0, 1]})


def instances():
    """One mesh, forty-eight places."""
    draw = random.Random(7).random
    paints = list(PAINTS) + ["steel"]
    knots = []
    for i in range(8):
        for j in range(6):
            knots.append({
                "name": f"knot {i * 6 + j + 1}", "type": "mesh", "mesh": "knot",
                "transform": moved(-3.5 + i + 0.3 * draw(), 0.28 + 0.25 * draw(), 1.9 - j + 0.3 * draw(),
                                   (draw() - 0.5, draw() - 0.5, draw() - 0.5), 360 * draw(), 0.17 + 0.08 * draw()),
                "material": paints[int(len(paints) * draw())]})
    return studio(knots, [{"name": "steel", "type": "metal", "baseColor": [0.8, 0.83, 0.86], "roughness": 0.2}],
                  camera={"lookFrom": [0, 4, 8], "lookAt": [0, 0, -0.4], "vfov": 34}, meshes=[KNOT])


# ---- light -----------------------------------------------------------------------------------------


def three_balls():
    return [sphere("mirror", [-1.45, 0.7, 0], 0.7, "mirror"), sphere("glass", [0, 0.7, 0.3], 0.7, "glass"),
            sphere("matte", [1.45, 0.7, 0], 0.7, "cream")]


BALL_MATERIALS = [{"name": "mirror", "type": "metal", "baseColor": [0.95, 0.95, 0.95]}, glass()]


def environment_image():
    scene = studio(three_balls(), BALL_MATERIALS, sky=0, key=0)
    sky = {"type": "image", "file": "../textures/sky.hdr", "color": [1, 1, 1], "strength": 1, "rotation": 40}
    return {"camera": scene.pop("camera"), "render": scene.pop("render"), "environment": sky} | scene


def environment_gradient():
    return studio(three_balls(), BALL_MATERIALS, sky=1, key=0)


def emissive_textured():
    textures = [
        {"name": "earth", "type": "image", "file": "../textures/earth.png"},
        {"name": "windows", "type": "checker", "colorA": [1, 0.55, 0.18], "colorB": [0.02, 0.03, 0.06],
         "scale": 8, "useUv": True},
    ]
    materials = [
        lamp("globe", [1, 1, 1], 3, emissiveTexture="earth"),
        lamp("windows", [1, 1, 1], 2.5, emissiveTexture="windows"),
    ]
    return studio([
        sphere("globe", [0.85, 1.0, 0.2], 0.8, "globe"),
        panel("panel", (-1.3, 0.95, -0.6), (-0.6, 0.9, 2), 1.6, 1.6, "windows"),
        sphere("ball", [-0.35, 0.3, 1.3], 0.3, "cream"),
    ], materials, sky=0, key=0, textures=textures)


def many_lights():
    """A hundred small lamps of all hues; choosing among them well is the renderer's business."""
    draw = random.Random(3).random
    materials, objects = [], []
    for i in range(10):
        for j in range(10):
            name = f"bulb {10 * i + j + 1}"
            hue = list(colorsys.hsv_to_rgb(0.1 * i + 0.02 * j, 0.75, 1))
            materials.append(lamp(name, hue, 25))
            objects.append(sphere(name, [-3.6 + 0.8 * i + 0.3 * draw(), 0.1 + 0.9 * draw() ** 2,
                                         2.2 - 0.8 * j + 0.3 * draw()], 0.05, name))
    objects += [sphere("ball", [-1.1, 0.6, -0.2], 0.6, "cream"), sphere("mirror", [0.9, 0.75, -0.8], 0.75, "mirror"),
                {"name": "box", "type": "box", "min": [-0.4, 0, -0.4], "max": [0.4, 0.8, 0.4],
                 "transform": moved(0.4, 0, 1.1, degrees=30), "material": "cream"}]
    return studio(objects, BALL_MATERIALS[:1] + materials, sky=0, key=0,
                  camera={"lookFrom": [0, 3.2, 8], "lookAt": [0, 0.3, -0.3], "vfov": 32})


def shape_lights():
    """Every shape as a light, each before its own piece of wall."""
    hues = [0.02, 0.09, 0.15, 0.32, 0.47, 0.57, 0.66, 0.85]
    shapes = [
        ("sphere", {"type": "sphere", "center": [0, 0, 0], "radius": 0.28}),
        ("cylinder", {"type": "cylinder", "p0": [-0.3, -0.2, 0], "p1": [0.3, 0.2, 0], "radius": 0.12}),
        ("disc", {"type": "disc", "center": [0, 0, 0], "normal": [0.5, 0.3, 1], "radius": 0.34}),
        ("rectangle", {"type": "rectangle", "corner": [-0.3, -0.2, 0], "edgeU": [0.6, 0.1, 0.2], "edgeV": [0, 0.45, 0]}),
        ("triangle", {"type": "triangle", "a": [-0.35, -0.25, 0], "b": [0.35, -0.25, 0.1], "c": [0, 0.4, 0]}),
        ("pyramid", {"type": "pyramid", "vertices": [[0, 0.35, 0], [-0.35, -0.25, 0.2], [0.35, -0.25, 0.2], [0, -0.25, -0.35]]}),
        ("box", {"type": "box", "min": [-0.2, -0.2, -0.2], "max": [0.2, 0.2, 0.2]}),
        ("mesh", {"type": "mesh", "mesh": "octahedron"}),
    ]
    materials, objects = [], []
    for i, (name, shape) in enumerate(shapes):
        x, y = -1.65 + 1.1 * (i % 4), 1.95 if i < 4 else 0.75
        materials.append(lamp(name, list(colorsys.hsv_to_rgb(hues[i], 0.7, 1)), 3, twoSided=name in ("disc", "rectangle", "triangle")))
        turn = moved(x, y, 0.35, (0.3, 1, 0), 25, 0.3 if name == "mesh" else 1)
        objects.append({"name": name} | shape | {"transform": turn, "material": name})
    objects += [
        panel("wall", (0, 1.35, -0.35), (0, 1.35, 5), 4.9, 2.7, "cream"),
        *({"name": f"divider {i + 1}", "type": "box", "min": [-0.02, 0, -0.35], "max": [0.02, 2.7, 0.35],
           "transform": moved(-2.2 + 1.1 * i, 0, 0), "material": "cream"} for i in range(5)),
        *({"name": f"shelf {i + 1}", "type": "box", "min": [-2.22, -0.02, -0.35], "max": [2.22, 0.02, 0.35],
           "transform": moved(0, 0.15 + 1.2 * i, 0), "material": "cream"} for i in range(3)),
    ]
    return studio(objects, materials, sky=0, key=0, meshes=[OCTAHEDRON],
                  camera={"lookFrom": [0, 1.9, 7.5], "lookAt": [0, 1.25, 0], "vfov": 28})


SCENES = {
    "shape-sphere": shape_sphere, "shape-cylinder": shape_cylinder, "shape-disc": shape_disc,
    "shape-rectangle": shape_rectangle, "shape-triangle": shape_triangle,
    "shape-pyramid": shape_pyramid, "shape-box": shape_box, "shape-mesh": shape_mesh,
    "metal-fuzz-and-roughness": metal_fuzz_and_roughness, "glass": glass_shapes,
    "textures": texture_gallery, "media": media, "depth-of-field": depth_of_field,
    "motion-blur": motion_blur, "instances": instances, "environment-image": environment_image,
    "environment-gradient": environment_gradient, "emissive-textured": emissive_textured,
    "many-lights": many_lights, "shape-lights": shape_lights,
}


def write(folder):
    for name, build in SCENES.items():
        write_scene(folder / "features" / f"{name}.json", build())

"""The trilogy's scenes with random placements: one-weekend-final, bouncing-spheres, next-week-final.

Everything not random has the books' values. random.Random(seed).random() gives the same numbers in
every version of Python, so the files can be written again bit for bit.
"""

import math
import random

from scene_file import rotation, write_scene

ONE_WEEKEND_SEED = 2   # gives 485 spheres: three places are taken by the big metal sphere
NEXT_WEEK_SEED = 2
FOCUS_DISTANCE = 10
DEFOCUS_ANGLE = 0.6    # degrees, the books' cone angle of the lens seen from the focus

BIG_SPHERES = [
    ("glass", [0, 1, 0], {"type": "dielectric", "baseColor": [1, 1, 1], "ior": 1.5}),
    ("brown", [-4, 1, 0], {"type": "lambertian", "baseColor": [0.4, 0.2, 0.1]}),
    ("polished", [4, 1, 0], {"type": "metal", "baseColor": [0.7, 0.6, 0.5]}),
]


def lens():
    return {
        "lookFrom": [13, 2, 3], "lookAt": [0, 0, 0], "vfov": 20,
        "lensRadius": FOCUS_DISTANCE * math.tan(math.radians(DEFOCUS_ANGLE / 2)),
        "focusDistance": FOCUS_DISTANCE,
    }


def small_spheres(draw, bouncing):
    """22 x 22 cells, one sphere each, except beside the big metal sphere. Returns materials, objects."""
    materials, objects = [], []
    for a in range(-11, 11):
        for b in range(-11, 11):
            choice = draw()
            center = [a + 0.9 * draw(), 0.2, b + 0.9 * draw()]
            if math.dist(center, [4, 0.2, 0]) <= 0.9:
                continue
            number = len(objects) + 1
            sphere = {"name": f"sphere {number}", "type": "sphere", "center": center, "radius": 0.2}
            if choice < 0.8:
                material = f"matte {number}"
                albedo = [draw() * draw() for _ in range(3)]
                materials.append({"name": material, "type": "lambertian", "baseColor": albedo})
                if bouncing:
                    sphere["motion"] = [0, 0.5 * draw(), 0]
            elif choice < 0.95:
                material = f"metal {number}"
                materials.append({"name": material, "type": "metal",
                                  "baseColor": [0.5 + 0.5 * draw() for _ in range(3)],
                                  "fuzz": 0.5 * draw()})
            else:
                material = "glass"
            objects.append(sphere | {"material": material})
    return materials, objects


def sphere_field(draw, ground, textures, sky, resolution, bouncing):
    materials, objects = small_spheres(draw, bouncing)
    roulette = {} if bouncing else {"rouletteDepth": 8}  # docs/performance.md
    scene = {
        "camera": lens(),
        "render": {"resolution": resolution, "spp": 500, "maxDepth": 50} | roulette,
        "environment": sky,
        "textures": textures,
        "materials": [ground] + [{"name": name} | look for name, _, look in BIG_SPHERES] + materials,
        "objects": [{"name": "ground", "type": "sphere", "center": [0, -1000, 0], "radius": 1000,
                     "material": ground["name"]}]
                   + [{"name": f"big {name} sphere", "type": "sphere", "center": center, "radius": 1,
                       "material": name} for name, center, _ in BIG_SPHERES] + objects,
    }
    if not textures:
        del scene["textures"]
    return scene


def one_weekend_final():
    ground = {"name": "ground", "type": "lambertian", "baseColor": [0.5, 0.5, 0.5]}
    sky = {"type": "gradient", "color": [0.5, 0.7, 1], "horizon": [1, 1, 1]}
    return sphere_field(random.Random(ONE_WEEKEND_SEED).random, ground, [], sky, [1200, 675], False)


def bouncing_spheres():
    checker = {"name": "checker", "type": "checker", "colorA": [0.2, 0.3, 0.1],
               "colorB": [0.9, 0.9, 0.9], "scale": 1 / 0.32}
    ground = {"name": "ground", "type": "lambertian", "baseColor": [1, 1, 1],
              "baseColorTexture": "checker"}
    sky = {"type": "constant", "color": [0.7, 0.8, 1]}
    return sphere_field(random.Random(ONE_WEEKEND_SEED).random, ground, [checker], sky, [800, 450], True)


def next_week_final():
    draw = random.Random(NEXT_WEEK_SEED).random
    ground = [{"name": f"ground {i * 20 + j + 1}", "type": "box",
               "min": [-1000 + 100 * i, 0, -1000 + 100 * j],
               "max": [-900 + 100 * i, 1 + 100 * draw(), -900 + 100 * j], "material": "ground"}
              for i in range(20) for j in range(20)]
    cluster = {"translation": [-100, 270, 395], "rotation": rotation([0, 1, 0], 15)}
    crowd = [{"name": f"crowd {i + 1}", "type": "sphere", "center": [165 * draw() for _ in range(3)],
              "radius": 10, "transform": cluster, "material": "white"} for i in range(1000)]
    things = [
        {"name": "light", "type": "rectangle", "corner": [123, 554, 147], "edgeU": [300, 0, 0],
         "edgeV": [0, 0, 265], "material": "light"},
        {"name": "moving sphere", "type": "sphere", "center": [400, 400, 200], "radius": 50,
         "motion": [30, 0, 0], "material": "orange"},
        {"name": "glass sphere", "type": "sphere", "center": [260, 150, 45], "radius": 50,
         "material": "glass"},
        {"name": "fuzzy sphere", "type": "sphere", "center": [0, 150, 145], "radius": 50,
         "material": "fuzzy metal"},
        {"name": "blue sphere", "type": "sphere", "center": [360, 150, 145], "radius": 70,
         "material": "glass", "medium": "blue"},
        {"name": "mist", "type": "sphere", "center": [0, 0, 0], "radius": 5000, "medium": "mist"},
        {"name": "earth", "type": "sphere", "center": [400, 200, 400], "radius": 100,
         "material": "earth"},
        {"name": "marble sphere", "type": "sphere", "center": [220, 280, 300], "radius": 80,
         "material": "marble"},
    ]
    return {
        "camera": {"lookFrom": [478, 278, -600], "lookAt": [278, 278, 0], "vfov": 40},
        "render": {"resolution": [800, 800], "spp": 1000, "maxDepth": 50},
        "textures": [
            {"name": "earth", "type": "image", "file": "textures/earth.png"},
            {"name": "marble", "type": "marble", "colorA": [0, 0, 0], "colorB": [1, 1, 1], "scale": 0.1},
        ],
        "materials": [
            {"name": "ground", "type": "lambertian", "baseColor": [0.48, 0.83, 0.53]},
            {"name": "light", "type": "emissive", "emissive": [7, 7, 7], "twoSided": True},
            {"name": "orange", "type": "lambertian", "baseColor": [0.7, 0.3, 0.1]},
            {"name": "glass", "type": "dielectric", "baseColor": [1, 1, 1], "ior": 1.5},
            {"name": "fuzzy metal", "type": "metal", "baseColor": [0.8, 0.8, 0.9], "fuzz": 1},
            {"name": "earth", "type": "lambertian", "baseColor": [1, 1, 1], "baseColorTexture": "earth"},
            {"name": "marble", "type": "lambertian", "baseColor": [1, 1, 1], "baseColorTexture": "marble"},
            {"name": "white", "type": "lambertian", "baseColor": [0.73, 0.73, 0.73]},
        ],
        "media": [
            {"name": "blue", "density": 0.2, "albedo": [0.2, 0.4, 0.9]},
            {"name": "mist", "density": 0.0001, "albedo": [1, 1, 1]},
        ],
        "objects": things + ground + crowd,
    }


def write(folder):
    write_scene(folder / "one-weekend-final.json", one_weekend_final())
    write_scene(folder / "bouncing-spheres.json", bouncing_spheres())
    write_scene(folder / "next-week-final.json", next_week_final())

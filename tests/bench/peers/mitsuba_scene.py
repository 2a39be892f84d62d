"""A scene rendered by Mitsuba 3: its analytic shapes, path tracing with MIS (volpath where there are media),
box filter. multijitter takes up to 4 % more samples than asked for."""

import os
import time

import numpy as np

from scene_file import CannotTranslate

VARIANT = "llvm_ad_rgb" if os.environ.get("DRJIT_LIBLLVM_PATH") else "scalar_rgb"
SETTINGS = [f"{VARIANT}, {sampler}" for sampler in ("independent", "multijitter")]


def rgb(values):
    return {"type": "rgb", "value": [float(v) for v in values]}


def bsdf_of(surface):
    if surface.kind == "lambertian":
        color = rgb(surface.color)
        if surface.texture is not None:
            image = np.ascontiguousarray(surface.texture * surface.color, np.float32)
            color = {"type": "bitmap", "bitmap": mi.Bitmap(image), "raw": True, "format": "variant"}
        return {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": color}}
    if surface.kind == "metal":
        mirror = {"type": "conductor", "material": "none", "specular_reflectance": rgb(surface.color)}
        return {"type": "twosided", "bsdf": mirror}
    if surface.kind == "dielectric":
        return {"type": "dielectric", "int_ior": surface.ior, "ext_ior": 1.0}
    return {"type": "null"} if surface.kind == "none" else {"type": "diffuse", "reflectance": rgb([0, 0, 0])}


def triangles(part, bsdf):
    properties = mi.Properties()
    properties["bsdf"] = mi.load_dict(bsdf)
    mesh = mi.Mesh("triangles", len(part.positions), len(part.faces), props=properties)
    parameters = mi.traverse(mesh)
    parameters["vertex_positions"] = part.positions.ravel().astype(np.float32)
    parameters["faces"] = part.faces.ravel().astype(np.uint32)
    parameters.update()
    return mesh


def shapes_of(surface):
    extra = {"bsdf": bsdf_of(surface)}
    if surface.radiance.any():
        extra["emitter"] = {"type": "area", "radiance": rgb(surface.radiance)}
    if surface.medium:
        extra["interior"] = {"type": "homogeneous", "sigma_t": float(surface.medium.get("density", 1)),
                             "albedo": rgb(surface.medium.get("albedo", [1] * 3)),
                             "phase": {"type": "isotropic"}}
    for part in surface.parts:
        if part.kind == "triangles":
            if surface.medium:
                raise CannotTranslate(f"{surface.name}: a medium in triangles is not translated")
            yield triangles(part, extra["bsdf"])
        else:
            yield {"type": part.kind, "to_world": mi.ScalarTransform4f(part.matrix), **extra}


def sky(scene):
    if (scene.nadir == scene.zenith).all():
        return {"type": "constant", "radiance": rgb(scene.zenith)}
    height = 1025  # rows from straight up to straight down, both included
    up = np.cos(np.linspace(0, np.pi, height))[:, None, None] * np.ones((1, 2, 1))
    image = scene.nadir + (scene.zenith - scene.nadir) * (up + 1) / 2
    return {"type": "envmap", "bitmap": mi.Bitmap(image.astype(np.float32))}


def load(scene, width, height, sampler):
    media = any(surface.medium for surface in scene.surfaces)
    sensor = {
        "type": "perspective",
        "to_world": mi.ScalarTransform4f().look_at(origin=scene.look_from, target=scene.look_at, up=scene.up),
        "fov": scene.vfov, "fov_axis": "y",
        "film": {"type": "hdrfilm", "width": width, "height": height, "rfilter": {"type": "box"},
                 "pixel_format": "rgb", "component_format": "float32"},
        "sampler": {"type": sampler},
    }
    if scene.lens_radius:
        sensor |= {"type": "thinlens", "aperture_radius": scene.lens_radius,
                   "focus_distance": scene.focus_distance}
    out = {"type": "scene", "sensor": sensor,
           "integrator": {"type": "volpath" if media else "path", "max_depth": scene.max_depth,
                          "rr_depth": scene.roulette_depth + 1}}
    if scene.zenith.any() or scene.nadir.any():
        out["sky"] = sky(scene)
    for index, surface in enumerate(scene.surfaces):
        for part, shape in enumerate(shapes_of(surface)):
            out[f"shape{index}_{part}"] = shape
    return mi.load_dict(out)


def renderer(scene, width, height, setting):
    """A function of spp and seed that gives a picture, row 0 on top, and seconds."""
    global mi
    import mitsuba as mi
    mi.set_variant(VARIANT)
    loaded = load(scene, width, height, setting.split(", ")[1])

    def render(spp, seed):
        start = time.perf_counter()
        picture = np.array(mi.render(loaded, spp=spp, seed=seed)).astype(float)
        return picture, time.perf_counter() - start

    return render

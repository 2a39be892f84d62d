"""A scene rendered by LuxCore: PATHCPU, shapes as triangles with smooth normals, no filter, samples not
adaptive; caustics traced from the lights are its hybrid back/forward mode."""

import time

import numpy as np

from triangles import check_scene, triangles_of

SETTINGS = ["Sobol", "Sobol, caustics from the lights"]


def tuples(array, kind):
    return None if array is None else [tuple(kind(v) for v in row) for row in array]


def materials_of(surface, name):
    """Properties of a material, without their prefix."""
    if surface.kind == "lambertian":
        return {"type": "matte", "kd": f"{name}_image" if surface.texture is not None else list(surface.color)}
    if surface.kind == "metal":
        return {"type": "mirror", "kr": list(surface.color)}
    if surface.kind == "dielectric":
        return {"type": "glass", "kr": [1.0] * 3, "kt": [1.0] * 3, "interiorior": surface.ior, "exteriorior": 1.0}
    return {"type": "matte", "kd": [0.0] * 3, "emission": list(surface.radiance)}


def load(scene, width, height):
    # LuxCore's rows lie one row lower than the window says.
    wide, tall, row = max(1, width / height), max(1, height / width), 2 / min(width, height)
    values = {"scene.camera.type": "perspective", "scene.camera.lookat.orig": list(scene.look_from),
              "scene.camera.lookat.target": list(scene.look_at), "scene.camera.up": list(scene.up),
              "scene.camera.fieldofview": scene.vfov, "scene.camera.cliphither": 1e-3,
              "scene.camera.screenwindow": [-wide, wide, -tall - row, tall - row]}
    if scene.zenith.any():
        values |= {"scene.lights.sky.type": "constantinfinite", "scene.lights.sky.color": list(scene.zenith)}
    loaded = lux.Scene()
    for index, surface in enumerate(scene.surfaces):
        name = f"surface{index}"
        for key, value in materials_of(surface, name).items():
            values[f"scene.materials.{name}.{key}"] = value
        if surface.texture is not None:
            image = np.ascontiguousarray((surface.texture * surface.color)[::-1], np.float32)
            loaded.DefineImageMap(f"{name}_file", image, 1.0, 3, image.shape[1], image.shape[0])
            values |= {f"scene.textures.{name}_image.type": "imagemap",
                       f"scene.textures.{name}_image.file": f"{name}_file",
                       f"scene.textures.{name}_image.gamma": 1.0}
        for part_index, part in enumerate(surface.parts):
            positions, faces, normals, uvs = triangles_of(part)
            shape = f"{name}_{part_index}"
            loaded.DefineMesh(f"{shape}_mesh", tuples(positions, float), tuples(faces, int),
                              tuples(normals, float), tuples(uvs, float), None, None)
            values |= {f"scene.objects.{shape}.shape": f"{shape}_mesh", f"scene.objects.{shape}.material": name}
    loaded.Parse(properties(values))
    return loaded


def properties(values):
    out = lux.Properties()
    for key, value in values.items():
        out.Set(lux.Property(key, [float(v) for v in value] if isinstance(value, list) else value))
    return out


def renderer(scene, width, height, setting):
    """A function of spp and seed that gives a picture, row 0 on top, and seconds."""
    global lux
    import pyluxcore as lux
    check_scene(scene)
    lux.Init()
    lux.SetLogHandler(lambda line: None)
    loaded = load(scene, width, height)

    def render(spp, seed):
        depth = {f"path.pathdepth.{kind}": scene.max_depth for kind in ("total", "diffuse", "glossy", "specular")}
        session = lux.RenderSession(lux.RenderConfig(properties({
            "renderengine.type": "PATHCPU", "renderengine.seed": seed, "sampler.type": "SOBOL",
            "sampler.sobol.adaptive.strength": 0.0, "path.hybridbackforward.enable": "caustics" in setting,
            "path.russianroulette.depth": scene.roulette_depth, "lightstrategy.type": "LOG_POWER",
            "film.width": width, "film.height": height, "film.filter.type": "NONE",
            "film.outputs.0.type": "RGB", "film.outputs.0.filename": "unused.exr",
            "batch.haltspp": spp, **depth}), loaded))
        session.Start()
        while not session.HasDone():
            time.sleep(0.005)
            session.UpdateStats()
        seconds = session.GetStats().Get("stats.renderengine.time").GetFloat()
        picture = np.zeros((height, width, 3), np.float32)
        session.GetFilm().GetOutputFloat(lux.FilmOutputType.RGB, picture, 0)
        session.Stop()
        return picture[::-1].astype(float), seconds

    return render

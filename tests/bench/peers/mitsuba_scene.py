"""A Lightbench scene as a Mitsuba 3 scene, for the shapes and materials of the Cornell boxes.

Raises ValueError for what it does not know: a rival that renders another scene proves nothing.
"""

import math

import numpy as np

Z = np.array([0.0, 0.0, 1.0])


def placement(transform):
    """4x4 matrix: scale, then rotate, then translate, as docs/scene-format.md has it."""
    matrix = np.eye(4)
    scale = transform.get("scale", 1)
    matrix[:3, :3] = np.diag(scale if isinstance(scale, list) else [scale] * 3)
    rotation = transform.get("rotation")
    if rotation:
        axis = np.array(rotation["axis"], float)
        x, y, z = axis / np.linalg.norm(axis)
        c, s = math.cos(math.radians(rotation["degrees"])), math.sin(math.radians(rotation["degrees"]))
        cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        unit = np.array([x, y, z])
        turn = c * np.eye(3) + s * cross + (1 - c) * np.outer(unit, unit)
        matrix[:3, :3] = turn @ matrix[:3, :3]
    matrix[:3, 3] = transform.get("translation", [0, 0, 0])
    return matrix


def frame(z, scale, origin):
    """Maps +z to z, lengths times `scale`, 0 to origin."""
    z = np.array(z, float) / np.linalg.norm(z)
    x = np.cross([0, 1, 0] if abs(z[1]) < 0.9 else [1, 0, 0], z)
    x /= np.linalg.norm(x)
    matrix = np.eye(4)
    matrix[:3, :3] = np.stack([x, np.cross(z, x), z], axis=1) * np.array(scale)
    matrix[:3, 3] = origin
    return matrix


def bsdf_of(material):
    kind = material["type"]
    color = {"type": "rgb", "value": material.get("baseColor", [0.8] * 3)}
    if "baseColorTexture" in material:
        raise ValueError(f"material {material['name']}: textures are not converted")
    if kind == "lambertian":
        return {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": color}}
    if kind == "metal" and not material.get("fuzz") and not material.get("roughness"):
        mirror = {"type": "conductor", "material": "none", "specular_reflectance": color}
        return {"type": "twosided", "bsdf": mirror}
    if kind == "dielectric":
        return {"type": "dielectric", "int_ior": material["ior"], "ext_ior": 1.0}
    if kind == "emissive":
        return {"type": "diffuse", "reflectance": {"type": "rgb", "value": [0, 0, 0]}}
    raise ValueError(f"material {material['name']}: {kind} is not converted")


def shapes_of(o):
    """Mitsuba shapes (type, matrix, extra) of an object, before its own transform."""
    kind = o["type"]
    if kind == "sphere":
        if any(o.get("motion", [0])):
            raise ValueError(f"object {o['name']}: motion is not converted")
        matrix = np.diag([o["radius"]] * 3 + [1.0])
        matrix[:3, 3] = o["center"]
        return [("sphere", matrix, {})]
    if kind == "disc":
        return [("disk", frame(o["normal"], [o["radius"]] * 3, o["center"]), {})]
    if kind == "rectangle":
        u, v = np.array(o["edgeU"], float) / 2, np.array(o["edgeV"], float) / 2
        n = np.cross(u, v)
        matrix = np.eye(4)
        matrix[:3, :3] = np.stack([u, v, n / np.linalg.norm(n)], axis=1)
        matrix[:3, 3] = np.array(o["corner"]) + u + v
        return [("rectangle", matrix, {})]
    if kind == "box":
        low, high = np.array(o["min"], float), np.array(o["max"], float)
        matrix = np.diag([*((high - low) / 2), 1.0])
        matrix[:3, 3] = (low + high) / 2
        return [("cube", matrix, {})]
    if kind == "cylinder":
        p0, p1 = np.array(o["p0"], float), np.array(o["p1"], float)
        axis, radius = p1 - p0, o["radius"]
        side = frame(axis, [radius, radius, np.linalg.norm(axis)], p0)
        return [("cylinder", side, {}), ("disk", frame(axis, [radius] * 3, p1), {}),
                ("disk", frame(-axis, [radius] * 3, p0), {})]
    if kind == "pyramid":
        return [("mesh", np.eye(4), {"vertices": np.array(o["vertices"], float)})]
    raise ValueError(f"object {o['name']}: {kind} is not converted")


def tetrahedron(mi, matrix, vertices, bsdf):
    points = (matrix[:3, :3] @ vertices.T).T + matrix[:3, 3]
    faces = []
    for i in range(4):
        a, b, c = [k for k in range(4) if k != i]
        outward = np.cross(points[b] - points[a], points[c] - points[a])
        if outward @ (points[i] - points[a]) > 0:
            b, c = c, b
        faces.append([a, b, c])
    properties = mi.Properties()
    properties["bsdf"] = mi.load_dict(bsdf)
    mesh = mi.Mesh("pyramid", 4, 4, props=properties)
    parameters = mi.traverse(mesh)
    parameters["vertex_positions"] = points.ravel().astype(np.float32)
    parameters["faces"] = np.array(faces, np.uint32).ravel()
    parameters.update()
    return mesh


def convert(mi, scene, width, height, sampler, spp):
    """The scene as Mitsuba loads it: path tracing to the scene's depth, box filter."""
    materials = {m["name"]: m for m in scene["materials"]}
    camera, render = scene["camera"], scene.get("render", {})
    if camera.get("lensRadius") or scene.get("environment", {}).get("color", [0] * 3) != [0] * 3:
        raise ValueError("a lens or an environment is not converted")
    out = {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": render.get("maxDepth", 50),
                       "rr_depth": render.get("rouletteDepth", 4) + 1},
        "sensor": {
            "type": "perspective",
            # Lightbench's picture has +x of the camera on its right, Mitsuba's on its left.
            "to_world": mi.ScalarTransform4f().look_at(
                origin=camera["lookFrom"], target=camera["lookAt"], up=camera.get("up", [0, 1, 0])),
            "fov": camera["vfov"], "fov_axis": "y",
            "film": {"type": "hdrfilm", "width": width, "height": height,
                     "rfilter": {"type": "box"}, "pixel_format": "rgb",
                     "component_format": "float32"},
            "sampler": {"type": sampler, "sample_count": spp},
        },
    }
    for index, o in enumerate(scene["objects"]):
        material = materials[o["material"]]
        bsdf = bsdf_of(material)
        own = placement(o.get("transform", {}))
        for part, (kind, matrix, extra) in enumerate(shapes_of(o)):
            name = f"object{index}_{part}"
            if kind == "mesh":
                out[name] = tetrahedron(mi, own @ matrix, extra["vertices"], bsdf)
                continue
            shape = {"type": kind, "to_world": mi.ScalarTransform4f(own @ matrix), "bsdf": bsdf}
            if any(material.get("emissive", [0])):
                if kind not in ("disk", "rectangle") or material.get("twoSided"):
                    raise ValueError(f"object {o['name']}: only one-sided flat lights are converted")
                radiance = np.array(material["emissive"]) * material.get("emissiveStrength", 1)
                shape["emitter"] = {"type": "area",
                                    "radiance": {"type": "rgb", "value": radiance.tolist()}}
            out[name] = shape
    return mi.load_dict(out)

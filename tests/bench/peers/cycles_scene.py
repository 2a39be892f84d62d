"""A scene rendered by Cycles, Blender's path tracer: shapes as triangles with smooth normals, flat lights as
area lights, box filter, nothing clamped or denoised; path guiding is trained all along."""

import pathlib
import tempfile
import time

import numpy as np

from scene_file import Part
from triangles import check_scene, triangles_of

SETTINGS = ["tabulated Sobol", "tabulated Sobol, path guiding"]

# Blender's z is up, ours y; its cameras and lights look along their -z.
TO_BLENDER = np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]], float)


def blender_matrix(matrix):
    from mathutils import Matrix
    out = np.eye(4)
    out[:3] = TO_BLENDER @ matrix[:3]
    return Matrix(out.tolist())


def material_of(surface, name):
    material = bpy.data.materials.new(name)
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    kinds = {"lambertian": "ShaderNodeBsdfDiffuse", "metal": "ShaderNodeBsdfAnisotropic",
             "dielectric": "ShaderNodeBsdfGlass", "emissive": "ShaderNodeBsdfDiffuse"}
    bsdf = nodes.new(kinds[surface.kind])
    color = {"emissive": [0] * 3, "dielectric": [1] * 3}.get(surface.kind, surface.color)
    bsdf.inputs["Color"].default_value = [*map(float, color), 1]
    bsdf.inputs["Roughness"].default_value = 0
    if surface.kind == "dielectric":
        bsdf.inputs["IOR"].default_value = surface.ior
    if surface.texture is not None:
        height, width, _ = surface.texture.shape
        image = bpy.data.images.new(name, width, height, float_buffer=True)
        image.colorspace_settings.name = "Linear Rec.709"
        rgba = np.ones((height, width, 4), np.float32)
        rgba[..., :3] = (surface.texture * surface.color)[::-1]
        image.pixels.foreach_set(rgba.ravel())
        image.pack()
        node = nodes.new("ShaderNodeTexImage")
        node.image = image
        links.new(node.outputs["Color"], bsdf.inputs["Color"])
    links.new(bsdf.outputs["BSDF"], nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    return material


def add(name, data, matrix=None):
    made = bpy.data.objects.new(name, data)
    if matrix is not None:
        made.matrix_world = blender_matrix(matrix)
    bpy.context.scene.collection.objects.link(made)
    return made


def add_mesh(name, part, material):
    positions, faces, normals, uvs = triangles_of(part)
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata((positions @ TO_BLENDER.T).tolist(), [], faces.tolist())
    if normals is not None:
        mesh.normals_split_custom_set_from_vertices((normals @ TO_BLENDER.T).tolist())
    if uvs is not None:
        layer = mesh.uv_layers.new()
        layer.data.foreach_set("uv", uvs[faces.ravel()].ravel().astype(np.float32))
    mesh.materials.append(material)
    add(name, mesh)


def add_light(name, part, surface, material):
    """An area light, which Cycles samples better than a mesh, and a black back a little behind it."""
    x, y, z, origin = part.matrix[:3].T
    lengths = np.linalg.norm([x, y], axis=1)
    z = z / np.linalg.norm(z)
    light = bpy.data.lights.new(name, "AREA")
    light.shape = "DISK" if part.kind == "disk" else "RECTANGLE"
    light.size, light.size_y = 2 * lengths
    area = lengths[0] * lengths[1] * (np.pi if part.kind == "disk" else 4)
    strength = surface.radiance.max()
    light.color = (surface.radiance / strength).tolist()
    light.energy = float(strength * np.pi * area)
    frame = np.eye(4)
    frame[:3] = np.stack([-x / lengths[0], y / lengths[1], -z, origin], axis=1)
    add(name, light, frame).visible_camera = True
    behind = part.matrix.copy()
    behind[:3, 3] -= 1e-4 * lengths.max() * z
    add_mesh(name + " back", Part(part.kind, behind), material)


def load(scene):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    world = bpy.data.worlds.new("sky")
    bpy.context.scene.world = world
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = [*map(float, scene.zenith), 1]
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit, camera.angle = "VERTICAL", np.radians(scene.vfov)
    back = scene.look_from - scene.look_at
    back /= np.linalg.norm(back)
    right = np.cross(scene.up, back)
    right /= np.linalg.norm(right)
    camera.clip_start, camera.clip_end = 1e-3, 1e6
    frame = np.eye(4)
    frame[:3] = np.stack([right, np.cross(back, right), back, scene.look_from], axis=1)
    bpy.context.scene.camera = add("camera", camera, frame)
    for index, surface in enumerate(scene.surfaces):
        material = material_of(surface, f"material {index}")
        for part_index, part in enumerate(surface.parts):
            name = f"part {index} {part_index}"
            if surface.radiance.any():
                add_light(name, part, surface, material)
            else:
                add_mesh(name, part, material)


def set_up(scene, width, height, guiding):
    blender = bpy.context.scene
    render, cycles = blender.render, blender.cycles
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100
    render.use_persistent_data = True  # what is loaded stays for the next render
    render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
    blender.view_settings.view_transform = "Raw"
    blender.view_settings.look = "None"
    cycles.device = "CPU"
    cycles.sampling_pattern = "TABULATED_SOBOL"
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = 0
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 1
    cycles.caustics_reflective = cycles.caustics_refractive = True
    for kind in ("max", "diffuse", "glossy", "transmission"):
        setattr(cycles, f"{kind}_bounces", scene.max_depth - 1)
    cycles.use_light_tree = False  # a little better with three lights
    cycles.use_guiding = guiding


def renderer(scene, width, height, setting):
    """A function of spp and seed that gives a picture, row 0 on top, and seconds."""
    global bpy
    import bpy
    check_scene(scene)
    load(scene)
    set_up(scene, width, height, "guiding" in setting)
    folder = tempfile.TemporaryDirectory()

    def render(spp, seed):
        blender = bpy.context.scene
        blender.cycles.samples, blender.cycles.seed = spp, seed
        blender.cycles.guiding_training_samples = spp
        blender.render.filepath = str(pathlib.Path(folder.name, "picture.exr"))
        start = time.perf_counter()
        bpy.ops.render.render(write_still=True)
        seconds = time.perf_counter() - start
        image = bpy.data.images.load(blender.render.filepath)
        pixels = np.empty(width * height * 4, np.float32)
        image.pixels.foreach_get(pixels)
        bpy.data.images.remove(image)
        return pixels.reshape(height, width, 4)[::-1, :, :3].astype(float), seconds

    return render

#pragma once
// Adding, copying, renaming and removing items of a Scene: references stay right and names unique.
// Pure functions on the scene; none of them touches the renderer or the screen.

#include <string>
#include <string_view>
#include <vector>

#include "core/scene/scene.h"
#include "ui/selection.h"

namespace lightbench::ui {

/// Names of the shapes in the order of the Shape variant.
const std::vector<const char*>& shape_names();

/// Number of items of a kind, and the name of one. `selection` must be valid.
int item_count(const Scene& scene, ItemKind kind);
const std::string& item_name(const Scene& scene, Selection selection);
/// True if the selection points at an existing item.
bool is_valid(const Scene& scene, Selection selection);

/// `wanted`, or `wanted 2`, `wanted 3`... if that name is taken in the list.
std::string unique_name(const Scene& scene, ItemKind kind, std::string_view wanted);

/// What "New" starts from: a sphere on a floor under the sky.
Scene new_scene();

/// A shape (index into shape_names()) of about a tenth of the view, at the point the camera looks
/// at, with the first non-emitting material (made if there is none).
Selection add_object(Scene& scene, std::size_t shape);
/// A disc with an emissive material of its own, above the camera's target and facing down.
Selection add_light(Scene& scene);
Selection add_material(Scene& scene, MaterialKind kind);
Selection add_texture(Scene& scene, TextureKind kind);
Selection add_medium(Scene& scene);
/// An object that shows `mesh`, placed where the mesh says.
Selection add_mesh(Scene& scene, std::string_view name, const std::string& file,
                   std::shared_ptr<const Mesh> mesh);

/// A copy under a new name, right after the original. A copied object is moved aside by its size.
Selection duplicate(Scene& scene, Selection selection);

/// Sets the name, made unique. An empty name changes nothing.
void rename(Scene& scene, Selection selection, std::string_view name);

/// Removes the item. What referred to it loses a texture or a medium; a material is replaced by its
/// neighbour in the list (made if there is none), since an object needs a surface or a medium.
/// Returns what to select next.
Selection remove(Scene& scene, Selection selection);

/// Gives the object a copy of its material, so that editing it changes no other object.
void make_material_unique(Scene& scene, int object);

/// Objects that use the item (of kind Material or Medium), or materials that use it (Texture).
int use_count(const Scene& scene, Selection selection);

}  // namespace lightbench::ui

#include <imgui.h>

#include <variant>

#include "core/format.h"
#include "ui/fields.h"
#include "ui/properties.h"

namespace lightbench::ui {
namespace {

/// One overload per shape.
struct ShapeFields {
  Workbench& bench;
  double step;

  [[nodiscard]] NumberStyle length() const { return {.speed = step, .min = 1e-9}; }
  [[nodiscard]] NumberStyle point() const { return {.speed = step}; }

  void operator()(SphereShape& s) const {
    vector_field("Centre", s.center, point());
    number_field("Radius", s.radius, length());
    vector_field("Motion", s.motion,
                 {.speed = step, .tip = "How far the centre moves from time 0 to time 1"});
  }
  void operator()(CylinderShape& s) const {
    vector_field("Bottom", s.p0, point());
    vector_field("Top", s.p1, point());
    number_field("Radius", s.radius, length());
  }
  void operator()(DiscShape& s) const {
    vector_field("Centre", s.center, point());
    vector_field("Normal", s.normal, {.speed = 0.01, .tip = "Points to the front"});
    number_field("Radius", s.radius, length());
  }
  void operator()(RectangleShape& s) const {
    vector_field("Corner", s.corner, point());
    vector_field("Edge u", s.edge_u, point());
    vector_field("Edge v", s.edge_v,
                 {.speed = step, .tip = "The front is where u, v and it make a right hand"});
  }
  void operator()(TriangleShape& s) const {
    vector_field("A", s.a, point());
    vector_field("B", s.b, point());
    vector_field("C", s.c, point());
  }
  void operator()(PyramidShape& s) const {
    vector_field("Vertex 1", s.vertices[0], point());
    vector_field("Vertex 2", s.vertices[1], point());
    vector_field("Vertex 3", s.vertices[2], point());
    vector_field("Vertex 4", s.vertices[3], point());
  }
  void operator()(BoxShape& s) const {
    vector_field("Min", s.min, point());
    vector_field("Max", s.max, point());
  }
  void operator()(MeshShape& s) const {
    const Scene& scene = bench.editor.scene;
    reference_field("Mesh", s.mesh, names_of(scene.meshes));
    const MeshAsset& asset = scene.meshes[static_cast<std::size_t>(s.mesh)];
    if (!asset.file.empty()) value_row("File", asset.file);
    if (!asset.data) return;
    value_row("Triangles", format_integer(static_cast<std::int64_t>(asset.data->triangles.size())));
    value_row("Vertices", format_integer(static_cast<std::int64_t>(asset.data->positions.size())));
  }
};

}  // namespace

void draw_shape_fields(Workbench& bench, Shape& shape, double step) {
  std::visit(ShapeFields{bench, step}, shape);
}

}  // namespace lightbench::ui

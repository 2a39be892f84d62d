#pragma once
// Which surfaces of a tiny scene the camera rays of a Work can meet. They are three in ten of the
// headline scene's rays for closest hits and see, tile by tile, a few surfaces; all others are
// tested against all.

#include "core/accel/surfaces.h"
#include "core/compile/render_scene.h"
#include "core/kernel/uses.h"

LIGHTBENCH_KERNEL_BEGIN

/// What rounds a ray and the tests of it, relative to coordinates: beyond the four planes by less
/// counts as within. 16 roundings of a float.
inline constexpr double kInViewSlack = 1e-6;

/// Those whose box is not wholly beyond one of the four planes through the eye and the sides of the
/// work's rectangle. All of them where rays start from a lens, and where there is a tree.
inline Surfaces surfaces_in_view(const SceneView<T>& scene, const Work& work) {
  Surfaces seen = kAllSurfaces;
  if (scene.boxes == nullptr || uses(scene, Feature::Lens)) return seen;
  const CameraView<T>& c = scene.camera;
  // Samples reach as far as the filter; one pixel more costs little.
  const double margin = static_cast<double>(c.filter_radius) + 1;
  const auto side = [&](int pixel, int crop, double beyond, int size) {
    return 2 * (pixel * work.stride + crop + beyond) / size - 1;
  };
  const double left = side(work.x0, c.crop_x, -margin, c.width);
  const double right = side(work.x1, c.crop_x, margin, c.width);
  const double top = -side(work.y0, c.crop_y, -margin, c.height);
  const double bottom = -side(work.y1, c.crop_y, margin, c.height);
  // The camera's axes are orthogonal, so what a point has of each is its product with that axis
  // over the axis' square; along a ray the three are as its picture coordinates and 1.
  double across = 0, up = 0, forward = 0;
  for (int k = 0; k < 3; ++k) {
    across += static_cast<double>(c.right[k]) * static_cast<double>(c.right[k]);
    up += static_cast<double>(c.up[k]) * static_cast<double>(c.up[k]);
    forward += static_cast<double>(c.forward[k]) * static_cast<double>(c.forward[k]);
  }
  double normals[4][3];  // into the view
  for (int k = 0; k < 3; ++k) {
    const double x = static_cast<double>(c.right[k]) / across;
    const double y = static_cast<double>(c.up[k]) / up;
    const double z = static_cast<double>(c.forward[k]) / forward;
    normals[0][k] = x - left * z;
    normals[1][k] = right * z - x;
    normals[2][k] = y - bottom * z;
    normals[3][k] = top * z - y;
  }
  for (std::uint32_t i = 0; i < scene.surface_count; ++i) {
    const BvhBox& box = scene.boxes[i];
    for (const auto& n : normals) {
      double farthest = 0, size = 0;  // of the box's corners along n
      for (int k = 0; k < 3; ++k) {
        const double corner = static_cast<double>(n[k] > 0 ? box.hi[k] : box.lo[k]);
        const double along = n[k] * (corner - static_cast<double>(c.origin[k]));
        farthest += along;
        size += along < 0 ? -along : along;
      }
      if (farthest < -kInViewSlack * size) seen.among[i] = 0;
    }
  }
  return seen;
}

LIGHTBENCH_KERNEL_END

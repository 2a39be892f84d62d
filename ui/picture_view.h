#pragma once
// Where the picture lies in the viewport: fitted, or zoomed and panned. Pure geometry; screen
// coordinates are ImGui's, picture coordinates are pixels with (0, 0) the top left corner.

#include <glm/vec2.hpp>

namespace lightbench::ui {

/// Screen rectangle in which the picture is looked at.
struct ViewRegion {
  glm::dvec2 min{0};
  glm::dvec2 size{1};
};

struct PictureView {
  double zoom = 0;         ///< screen pixels per picture pixel; 0 = as large as fits
  glm::dvec2 center{0.5};  ///< picture point in the middle of the region, 0..1; unused when fitted
  bool operator==(const PictureView&) const = default;
};

/// Screen pixels per picture pixel; always the same in x and y.
double effective_zoom(const PictureView& view, const ViewRegion& region, const glm::dvec2& picture);
/// Screen position of the picture's top left corner, on whole screen pixels.
glm::dvec2 picture_origin(const PictureView& view, const ViewRegion& region,
                          const glm::dvec2& picture);

glm::dvec2 to_picture(const PictureView& view, const ViewRegion& region, const glm::dvec2& picture,
                      const glm::dvec2& screen);
glm::dvec2 to_screen(const PictureView& view, const ViewRegion& region, const glm::dvec2& picture,
                     const glm::dvec2& pixel);

/// Multiplies the zoom, keeping the picture point under `screen` in place; within 1/16 .. 64.
PictureView zoom_at(const PictureView& view, const ViewRegion& region, const glm::dvec2& picture,
                    const glm::dvec2& screen, double factor);
/// Shifts the picture by `delta` screen pixels; the centre stays on the picture.
PictureView pan_by(const PictureView& view, const ViewRegion& region, const glm::dvec2& picture,
                   const glm::dvec2& delta);

}  // namespace lightbench::ui

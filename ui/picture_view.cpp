#include "ui/picture_view.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace lightbench::ui {

double effective_zoom(const PictureView& view, const ViewRegion& region,
                      const glm::dvec2& picture) {
  if (view.zoom > 0) return view.zoom;
  return std::max(1e-3, std::min(region.size.x / picture.x, region.size.y / picture.y));
}

glm::dvec2 picture_origin(const PictureView& view, const ViewRegion& region,
                          const glm::dvec2& picture) {
  const double zoom = effective_zoom(view, region, picture);
  const glm::dvec2 center = view.zoom > 0 ? view.center : glm::dvec2(0.5);
  return glm::round(region.min + 0.5 * region.size - zoom * center * picture);
}

glm::dvec2 to_picture(const PictureView& view, const ViewRegion& region, const glm::dvec2& picture,
                      const glm::dvec2& screen) {
  return (screen - picture_origin(view, region, picture)) / effective_zoom(view, region, picture);
}

glm::dvec2 to_screen(const PictureView& view, const ViewRegion& region, const glm::dvec2& picture,
                     const glm::dvec2& pixel) {
  return picture_origin(view, region, picture) + effective_zoom(view, region, picture) * pixel;
}

PictureView zoom_at(const PictureView& view, const ViewRegion& region, const glm::dvec2& picture,
                    const glm::dvec2& screen, double factor) {
  const glm::dvec2 fixed = to_picture(view, region, picture, screen);
  PictureView result;
  result.zoom = std::clamp(effective_zoom(view, region, picture) * factor, 1.0 / 16, 64.0);
  result.center = (fixed + (region.min + 0.5 * region.size - screen) / result.zoom) / picture;
  return result;
}

PictureView pan_by(const PictureView& view, const ViewRegion& region, const glm::dvec2& picture,
                   const glm::dvec2& delta) {
  PictureView result = view;
  result.zoom = effective_zoom(view, region, picture);
  if (view.zoom <= 0) result.center = glm::dvec2(0.5);
  result.center =
      glm::clamp(result.center - delta / (result.zoom * picture), glm::dvec2(0), glm::dvec2(1));
  return result;
}

}  // namespace lightbench::ui

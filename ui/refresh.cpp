#include "ui/refresh.h"

#include <algorithm>

namespace lightbench::ui {

double refresh_interval(std::uint32_t spp, double age, double frame_seconds) {
  double interval = 2.0;
  if (spp < 4 || age < 1) {
    interval = 0.1;
  } else if (spp < 8 || age < 2) {
    interval = 0.25;
  } else if (spp < 16 || age < 4) {
    interval = 0.5;
  } else if (spp < 32 || age < 8) {
    interval = 1.0;
  }
  return std::max(interval, frame_seconds / kDisplayShare);
}

}  // namespace lightbench::ui

#pragma once
// Small tables column by column: the kernel holds a column in a register and picks from it.

#include <cstddef>
#include <vector>

#include "core/kernel/scene_view.h"

namespace lightbench {

/// Appends `count` rows of `stride` numbers each as `stride` columns of kColumnRows entries, the
/// rest of which repeat row 0. Returns whether it did: of one row, which all lanes share anyway,
/// and of more than kColumnRows there are no columns.
template <class T>
bool append_columns(const T* rows, std::size_t count, std::size_t stride, std::vector<T>& columns) {
  if (count < 2 || count > kColumnRows) return false;
  for (std::size_t k = 0; k < stride; ++k) {
    for (std::size_t i = 0; i < kColumnRows; ++i) {
      columns.push_back(rows[(i < count ? i : 0) * stride + k]);
    }
  }
  return true;
}

}  // namespace lightbench

#pragma once
// Queries arrive and leave as arrays of structs of double; lanes want a register for each field.

#include <algorithm>
#include <cstddef>
#include <span>

#include "core/kernel/vec.h"

LIGHTBENCH_KERNEL_BEGIN

/// Up to kLanes consecutive queries. The lanes left over repeat the last one, so that nothing
/// unusual happens in them.
class Batch {
 public:
  Batch(std::size_t begin, std::size_t end)
      : begin_(begin), count_(std::min<std::size_t>(end - begin, kLanes)) {}
  [[nodiscard]] Mask active() const { return mask_from_bits((1U << count_) - 1U); }

  /// Lane k takes get(index of its query), a double.
  template <class F>
  [[nodiscard]] Real real(F get) const {
    alignas(64) T lanes[kLanes];
    for (std::size_t k = 0; k < kLanes; ++k) lanes[k] = static_cast<T>(get(index(k)));
    return load(lanes);
  }
  template <class F>
  [[nodiscard]] Int integer(F get) const {
    alignas(64) std::uint32_t lanes[kLanes];
    for (std::size_t k = 0; k < kLanes; ++k) lanes[k] = get(index(k));
    return load(lanes);
  }
  template <class F>
  [[nodiscard]] Mask mask(F get) const {
    std::uint32_t lanes = 0;
    for (std::size_t k = 0; k < kLanes; ++k) lanes |= (get(index(k)) ? 1U : 0U) << k;
    return mask_from_bits(lanes);
  }
  /// get(index) is a double[3].
  template <class F>
  [[nodiscard]] Vec vec(F get) const {
    return {real([&](std::size_t i) { return get(i)[0]; }),
            real([&](std::size_t i) { return get(i)[1]; }),
            real([&](std::size_t i) { return get(i)[2]; })};
  }
  /// A number in [0,1) that stays below 1 when rounded to T.
  template <class F>
  [[nodiscard]] Real unit(F get) const {
    return min(real(get), Real(T(1) - kEpsilon));
  }

  // And back: put(index) is where the lane's number goes.
  template <class F>
  void each(Real value, F put) const {
    alignas(64) T lanes[kLanes];
    store(lanes, value);
    for (std::size_t k = 0; k < count_; ++k) put(begin_ + k) = static_cast<double>(lanes[k]);
  }
  template <class F>
  void each(Int value, F put) const {
    alignas(64) std::uint32_t lanes[kLanes];
    store(lanes, value);
    for (std::size_t k = 0; k < count_; ++k) put(begin_ + k) = lanes[k];
  }
  template <class F>
  void each(Vec value, F put) const {
    each(value.x, [&](std::size_t i) -> double& { return put(i)[0]; });
    each(value.y, [&](std::size_t i) -> double& { return put(i)[1]; });
    each(value.z, [&](std::size_t i) -> double& { return put(i)[2]; });
  }
  template <class F>
  void each_mask(Mask value, F put) const {
    const std::uint32_t lanes = bits(value);
    for (std::size_t k = 0; k < count_; ++k) put(begin_ + k) = ((lanes >> k) & 1U) != 0;
  }

 private:
  [[nodiscard]] std::size_t index(std::size_t lane) const {
    return begin_ + std::min(lane, count_ - 1);
  }
  std::size_t begin_, count_;
};

/// Calls f for all queries of [0, count), kLanes at a time.
template <class F>
void for_each_batch(std::size_t count, F f) {
  for (std::size_t begin = 0; begin < count; begin += kLanes) f(Batch(begin, count));
}

LIGHTBENCH_KERNEL_END

#pragma once
// One lane's ray as plain numbers, for walking a tree.

#include "core/shapes/shape.h"

LIGHTBENCH_KERNEL_BEGIN

/// One ray as plain numbers, for walking a tree.
struct SingleRay {
  T o[3], d[3], inverse[3];
  T time;
  std::uint32_t from, from_slot, skip, skip_slot;
  bool inside, skip_back;
};

/// All lanes' rays as plain numbers.
struct RayTable {
  alignas(64) T o[3][kLanes], d[3][kLanes], inverse[3][kLanes], time[kLanes];
  alignas(64) std::uint32_t from[kLanes], from_slot[kLanes], skip[kLanes], skip_slot[kLanes];
  std::uint32_t inside, skip_back;
  explicit RayTable(const Ray& r) : inside(bits(r.inside)), skip_back(bits(r.skip_back)) {
    store(o[0], r.o.x);
    store(o[1], r.o.y);
    store(o[2], r.o.z);
    store(d[0], r.d.x);
    store(d[1], r.d.y);
    store(d[2], r.d.z);
    store(inverse[0], Real(1) / r.d.x);
    store(inverse[1], Real(1) / r.d.y);
    store(inverse[2], Real(1) / r.d.z);
    store(time, r.time);
    store(from, r.from);
    store(from_slot, r.from_slot);
    store(skip, r.skip);
    store(skip_slot, r.skip_slot);
  }
  [[nodiscard]] SingleRay single(unsigned lane) const {
    SingleRay s;
    for (unsigned a = 0; a < 3; ++a) {
      s.o[a] = o[a][lane];
      s.d[a] = d[a][lane];
      s.inverse[a] = inverse[a][lane];
    }
    s.time = time[lane];
    s.from = from[lane];
    s.from_slot = from_slot[lane];
    s.skip = skip[lane];
    s.skip_slot = skip_slot[lane];
    s.inside = ((inside >> lane) & 1U) != 0;
    s.skip_back = ((skip_back >> lane) & 1U) != 0;
    return s;
  }
};

/// The same ray in every lane.
inline Ray broadcast_ray(const SingleRay& s) {
  return {{Real(s.o[0]), Real(s.o[1]), Real(s.o[2])},
          {Real(s.d[0]), Real(s.d[1]), Real(s.d[2])},
          Real(s.time),
          Int(s.from),
          Int(s.from_slot),
          Mask(s.inside),
          Int(s.skip),
          Int(s.skip_slot),
          Mask(s.skip_back)};
}

LIGHTBENCH_KERNEL_END

#pragma once
// Three-vectors of lanes, frames, affine maps and the table rows they are read from.

#include "core/kernel/lanes.h"
#include "core/kernel/scene_view.h"

LIGHTBENCH_KERNEL_BEGIN

inline constexpr T kPi = T(3.14159265358979323846);
inline constexpr T kTwoPi = 2 * kPi;
inline constexpr T kInvPi = 1 / kPi;
inline constexpr T kInfinity = __builtin_huge_val();
inline constexpr T kEpsilon = sizeof(T) == 8 ? T(0x1p-53) : T(0x1p-24);  ///< half an ulp of 1

struct Vec {
  Real x, y, z;
  Vec() = default;
  Vec(Real a, Real b, Real c) : x(a), y(b), z(c) {}
  explicit Vec(Real a) : x(a), y(a), z(a) {}
};

inline Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator-(Vec a) { return {-a.x, -a.y, -a.z}; }
inline Vec operator*(Vec a, Vec b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline Vec operator*(Vec a, Real s) { return {a.x * s, a.y * s, a.z * s}; }
inline Vec operator*(Real s, Vec a) { return a * s; }
inline Vec select(Mask m, Vec a, Vec b) {
  return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
}
inline Real dot(Vec a, Vec b) { return fma(a.z, b.z, fma(a.y, b.y, a.x * b.x)); }
/// b + s a
inline Vec madd(Vec a, Real s, Vec b) {
  return {fma(a.x, s, b.x), fma(a.y, s, b.y), fma(a.z, s, b.z)};
}
/// The rounding error of a - b, exactly (Knuth's two-sum).
inline Real difference_error(Real a, Real b, Real difference) {
  const Real part = a - difference;
  return (a - (difference + part)) + (part - b);
}
inline Vec difference_error(Vec a, Vec b, Vec difference) {
  return {difference_error(a.x, b.x, difference.x), difference_error(a.y, b.y, difference.y),
          difference_error(a.z, b.z, difference.z)};
}
/// Plain products on purpose: antisymmetric, cross(a, a) = 0 exactly.
inline Vec cross(Vec a, Vec b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Real length_squared(Vec a) { return dot(a, a); }
inline Real length(Vec a) { return sqrt(dot(a, a)); }
inline Vec normalize(Vec a) { return a * (Real(1) / length(a)); }
inline Real max_component(Vec a) { return max(a.x, max(a.y, a.z)); }
inline Real square(Real a) { return a * a; }
inline Real clamp(Real a, Real lo, Real hi) { return min(max(a, lo), hi); }
/// sqrt(max(a, 0))
inline Real safe_sqrt(Real a) { return sqrt(max(a, Real(0))); }
/// Rec. 709
inline Real luminance(Vec c) { return fma(c.z, T(0.0722), fma(c.y, T(0.7152), c.x * T(0.2126))); }

/// Orthonormal basis around unit z (Duff et al., JCGT 6:1, 2017).
struct Frame {
  Vec x, y, z;
  explicit Frame(Vec n) : z(n) {
    const Real s = copysign(Real(1), n.z);
    const Real a = Real(-1) / (s + n.z);
    const Real b = n.x * n.y * a;
    x = {Real(1) + s * n.x * n.x * a, s * b, -(s * n.x)};
    y = {b, s + n.y * n.y * a, -n.y};
  }
  [[nodiscard]] Vec to_world(Vec v) const { return madd(x, v.x, madd(y, v.y, z * v.z)); }
  [[nodiscard]] Vec to_local(Vec v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
};

/// A row of a table of T, the same for all lanes.
struct Row {
  const T* base;
  Real operator[](unsigned i) const { return Real(base[i]); }
  [[nodiscard]] Vec vec(unsigned i) const { return {(*this)[i], (*this)[i + 1], (*this)[i + 2]}; }
  /// Whether number i is less than x; one test for all lanes here.
  [[nodiscard]] Mask below(unsigned i, T x) const { return Mask(base[i] < x); }
};

/// The lanes' own rows of a table of T, gathered number by number: for many different rows of which
/// few numbers are read, which merged_rows() would go through one by one.
struct GatheredRow {
  const T* rows;
  Int offset;
  Real operator[](unsigned i) const { return gather(rows + i, offset); }
  [[nodiscard]] Vec vec(unsigned i) const { return {(*this)[i], (*this)[i + 1], (*this)[i + 2]}; }
  [[nodiscard]] Mask below(unsigned i, T x) const { return (*this)[i] < Real(x); }
};

/// Calls f(value, lanes) once for each distinct value of `id` among the active lanes: what follows
/// then reads tables with plain loads and branches on plain numbers. Gathering a row per lane
/// instead was slower (docs/performance.md).
template <class F>
void for_each_distinct(Int id, Mask active, F f) {
  alignas(64) std::uint32_t ids[kLanes];
  store(ids, id);
  for (std::uint32_t rest = bits(active); rest != 0;) {
    const std::uint32_t value = ids[__builtin_ctz(rest)];
    const Mask lanes = active && id == Int(value);
    rest &= ~bits(lanes);
    f(value, lanes);
  }
}

/// A row of each lane's own: the rows of up to kLanes table entries, merged. Shapes and materials
/// read it as they read a Row. Inactive lanes hold the first active one's numbers.
template <unsigned kSize>
struct LaneRow {
  Real numbers[kSize];
  Real operator[](unsigned i) const { return numbers[i]; }
  [[nodiscard]] Vec vec(unsigned i) const { return {numbers[i], numbers[i + 1], numbers[i + 2]}; }
  [[nodiscard]] Mask below(unsigned i, T x) const { return numbers[i] < Real(x); }
};

/// The rows that `row(id)` points to; some lane is active. Masked loads of each distinct row cost
/// less than gathers of all, and what follows runs once however many rows there are.
template <unsigned kSize, class F>
LaneRow<kSize> merged_rows(Int id, Mask active, F row) {
  LaneRow<kSize> merged;
  bool first = true;
  for_each_distinct(id, active, [&](std::uint32_t i, Mask m) {
    const T* numbers = row(i);
#pragma GCC unroll 64
    for (unsigned k = 0; k < kSize; ++k) {
      merged.numbers[k] = first ? Real(numbers[k]) : select(m, Real(numbers[k]), merged.numbers[k]);
    }
    first = false;
  });
  return merged;
}

/// The lanes' own entries; of a column in one permutation, where a gather takes as many loads as
/// there are lanes.
template <class U>
auto pick(const Entries<U>& of, Int index) {
  return of.column != nullptr ? look_up(of.column, index) : gather(of.table, index);
}

/// Row `index` of a small table that is stored column by column (core/compile/columns.h): with all
/// of a column in a register, each lane picks its own number at once.
template <unsigned kSize>
LaneRow<kSize> row_of_columns(const T* columns, Int index) {
  LaneRow<kSize> row;
#pragma GCC unroll 64
  for (unsigned k = 0; k < kSize; ++k) {
    row.numbers[k] = look_up(columns + std::size_t{kColumnRows} * k, index);
  }
  return row;
}

/// 3x4 matrix, row major, 12 entries.
struct Affine {
  Vec r0, r1, r2, t;
  [[nodiscard]] Vec point(Vec p) const {
    return {dot(r0, p) + t.x, dot(r1, p) + t.y, dot(r2, p) + t.z};
  }
  [[nodiscard]] Vec vector(Vec v) const { return {dot(r0, v), dot(r1, v), dot(r2, v)}; }
  /// Transpose of the linear part: normals go to world by the inverse map's transpose.
  [[nodiscard]] Vec transposed(Vec n) const { return madd(r0, n.x, madd(r1, n.y, r2 * n.z)); }
};
inline Affine affine_at(const auto& row, unsigned i) {
  return {row.vec(i), row.vec(i + 4), row.vec(i + 8), {row[i + 3], row[i + 7], row[i + 11]}};
}

LIGHTBENCH_KERNEL_END

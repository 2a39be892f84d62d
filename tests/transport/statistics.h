#pragma once
// How these tests decide: every measured mean carries its standard error, and a family of
// comparisons fails if the largest deviation would occur by chance in less than kFamilyLevel of all
// families (Sidak's correction over its members). Seeds are fixed, so a verdict never changes by
// itself.

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "core/compile/render_scene.h"

namespace lightbench {

/// A mean per colour channel, the standard error of that mean, and its degrees of freedom.
struct Estimate {
  glm::dvec3 mean{0};
  glm::dvec3 error{0};
  double freedom = 0;
};

/// Mean and standard error of independent estimates of the same number.
Estimate summarize(const std::vector<glm::dvec3>& replicates);

/// The normal deviate that is as unlikely as Student's t at `freedom` (Wallace 1959, within 0.02
/// for 8 degrees and more).
double equivalent_z(double t, double freedom);

/// Two-sided limit on |z| for each of `members` comparisons so that all stay within it in a share
/// 1 - level of all families.
double sidak_limit(double level, std::size_t members);

inline constexpr double kFamilyLevel = 1e-3;

/// A family of comparisons of estimates with exact values.
class Family {
 public:
  /// `precision`: largest relative standard error that still makes a comparison worth its name.
  /// `rounding`: relative systematic error allowed for the arithmetic of the kernel.
  /// `dark`: below this value the precision asked for is absolute, precision * dark: a block a
  /// hundred times darker than the picture need not be known to the same number of digits.
  Family(double precision, double rounding, double dark = 0)
      : precision_(precision), rounding_(rounding), dark_(dark) {}

  void add(const std::string& name, const glm::dvec3& expected, const Estimate& measured);
  void add(const std::string& name, double expected, const Estimate& measured);

  /// Members beyond the limit, one line each.
  [[nodiscard]] std::vector<std::string> disagreements() const;
  /// Members whose standard error is above the precision, one line each.
  [[nodiscard]] std::vector<std::string> imprecise() const;
  /// Fails the running test for each line of either list, and prints every member.
  void expect_agreement() const;

 private:
  struct Member {
    std::string name;
    double expected, mean, error, z;
  };
  [[nodiscard]] static std::string describe(const Member& m);
  void add(const std::string& name, double expected, double mean, double error, double freedom);

  double precision_, rounding_, dark_;
  std::vector<Member> members_;
};

}  // namespace lightbench

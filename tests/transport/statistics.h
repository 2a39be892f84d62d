#pragma once
// How these tests decide: every measured mean carries its standard error, and a family of
// comparisons fails if the largest deviation would occur by chance in less than kFamilyLevel of all
// families (Sidak's correction over its members). Seeds are fixed, so a verdict never changes by
// itself.

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "app/proof/statistics.h"

namespace lightbench {

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

  void add(const std::string& name, const glm::dvec3& expected, const proof::Estimate& measured);
  void add(const std::string& name, double expected, const proof::Estimate& measured);

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

#include "tests/transport/statistics.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lightbench {
using namespace proof;
void Family::add(const std::string& name, double expected, double mean, double error,
                 double freedom) {
  // What rounding may explain is taken off before the rest is judged as chance.
  const double excess = std::max(0.0, std::abs(mean - expected) - rounding_ * std::abs(expected));
  double z = 0;
  if (excess > 0) {
    z = error > 0 ? std::abs(equivalent_z(excess / error, freedom))
                  : std::numeric_limits<double>::infinity();
  }
  members_.push_back({name, expected, mean, error, mean < expected ? -z : z});
}

void Family::add(const std::string& name, const glm::dvec3& expected, const Estimate& measured) {
  const char* channels[] = {" red", " green", " blue"};
  for (int k = 0; k < 3; ++k) {
    add(name + channels[k], expected[k], measured.mean[k], measured.error[k], measured.freedom);
  }
}

void Family::add(const std::string& name, double expected, const Estimate& measured) {
  add(name, expected, measured.mean.y, measured.error.y, measured.freedom);
}

std::string Family::describe(const Member& m) {
  return fmt::format("{:<52} expected {:<12.7g} measured {:<12.7g} +- {:<9.2g} z {:+.2f}", m.name,
                     m.expected, m.mean, m.error, m.z);
}

std::vector<std::string> Family::disagreements() const {
  const double limit = sidak_limit(kFamilyLevel, members_.size());
  std::vector<std::string> lines;
  for (const Member& m : members_) {
    // Written so that a mean that is not a number disagrees too.
    if (!(std::abs(m.z) <= limit) || !std::isfinite(m.mean)) lines.push_back(describe(m));
  }
  return lines;
}

std::vector<std::string> Family::imprecise() const {
  std::vector<std::string> lines;
  for (const Member& m : members_) {
    if (!(m.error <= precision_ * std::max(std::abs(m.expected), dark_)))
      lines.push_back(describe(m));
  }
  return lines;
}

void Family::expect_agreement() const {
  ASSERT_FALSE(members_.empty());
  fmt::print("|z| limit {:.2f} over {} comparisons\n", sidak_limit(kFamilyLevel, members_.size()),
             members_.size());
  for (const Member& m : members_) fmt::print("{}\n", describe(m));
  for (const std::string& line : disagreements()) ADD_FAILURE() << "disagrees: " << line;
  for (const std::string& line : imprecise()) ADD_FAILURE() << "too noisy to judge: " << line;
}

}  // namespace lightbench

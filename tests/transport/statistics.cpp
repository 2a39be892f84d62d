#include "tests/transport/statistics.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lightbench {
namespace {

/// Share of a normal distribution beyond +-z.
double two_sided_tail(double z) { return std::erfc(z / std::numbers::sqrt2); }

}  // namespace

Estimate summarize(const std::vector<glm::dvec3>& replicates) {
  const auto n = static_cast<double>(replicates.size());
  Estimate e;
  for (const glm::dvec3& r : replicates) e.mean += r / n;
  glm::dvec3 squares(0);
  for (const glm::dvec3& r : replicates) squares += (r - e.mean) * (r - e.mean);
  for (int k = 0; k < 3; ++k) e.error[k] = std::sqrt(squares[k] / (n - 1) / n);
  e.freedom = n - 1;
  return e;
}

double equivalent_z(double t, double freedom) {
  const double z =
      std::sqrt(freedom * std::log1p(t * t / freedom)) * (8 * freedom + 1) / (8 * freedom + 3);
  return std::copysign(z, t);
}

double sidak_limit(double level, std::size_t members) {
  const double each = -std::expm1(std::log1p(-level) / static_cast<double>(members));
  double low = 0, high = 40;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (two_sided_tail(middle) > each ? low : high) = middle;
  }
  return high;
}

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

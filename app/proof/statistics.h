#pragma once
// Means with their standard errors, and the chance of a difference between them.

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace lightbench::proof {

/// A mean per colour channel, the standard error of that mean, and its degrees of freedom.
struct Estimate {
  glm::dvec3 mean{0};
  glm::dvec3 error{0};
  double freedom = 0;
};

/// Mean and standard error of independent estimates of the same number.
Estimate summarize(const std::vector<glm::dvec3>& replicates);

/// The same of one number.
struct Mean {
  double value = 0, error = 0, freedom = 0;
};
Mean mean_of(std::span<const double> replicates);

/// The normal deviate that is as unlikely as Student's t at `freedom` (Wallace 1959, within 0.02
/// for 8 degrees and more).
double equivalent_z(double t, double freedom);

/// Two-sided limit on |z| for each of `members` comparisons so that all stay within it in a share
/// 1 - level of all families (Sidak's correction).
double sidak_limit(double level, std::size_t members);

/// Probability of a Student's t beyond +-t.
double student_tail(double t, double freedom);
/// The t for which student_tail() is `tail`.
double student_quantile(double tail, double freedom);

/// Welch's test of the difference a - b of two means that need not have the same variance.
struct Welch {
  double t = 0, freedom = 0;
  double p = 1;  ///< two-sided; uniform over [0,1] where the means are the same
};
Welch welch(const Mean& a, const Mean& b);

/// p-value of the Kolmogorov-Smirnov test that `p` is uniform over [0,1] (Stephens 1970's form of
/// the asymptotic tail).
double uniformity(std::vector<double> p);

}  // namespace lightbench::proof

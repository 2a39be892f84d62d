#pragma once
// Whole pictures that show one radiance known by a formula.

#include <functional>
#include <string>
#include <vector>

#include "app/stress/suite.h"
#include "core/scene/scene.h"

namespace lightbench::stress {

/// A picture and the radiance that all of it shows.
struct KnownPicture {
  std::string what;  ///< the case, for the report of a failure
  Scene scene;
  /// The exact radiance; an interval where what rounding the scene to the kernel's numbers may do
  /// shows.
  double low = 0, high = 0;
  /// What precision is relative to; 0: the radiance.
  double unit = 0;
  bool certain = false;  ///< every sample shows it
  /// Of samples that show either this radiance or none; 0: samples of any radiance.
  double event = 0;
};

/// A case at random; `precision` is that of the kernel it is for.
using DrawPicture = std::function<KnownPicture(Random& random, Precision precision)>;

/// Half the distance to the next number after 1.
double rounding_of(Precision precision);

/// Appends a test of two lines, which ask whether chance explains the deviation from the formula,
/// and whether it is below 0.1 %. Each picture takes samples until its standard error is 0.03 % of
/// the radiance, of `unit`, or of kDark, whichever is largest.
void add_known_pictures(std::vector<Test>& tests, const std::string& name,
                        const std::string& distribution, std::uint64_t short_trials,
                        std::uint64_t long_trials, const DrawPicture& draw);

/// Below this radiance precision is absolute: its share of this one.
inline constexpr double kDark = 0.02;

/// Largest deviation in standard errors that is taken for chance: 6e-7 of all comparisons are
/// beyond it, so that one run in a hundred of the long form fails by chance.
inline constexpr double kLargestDeviate = 5;

}  // namespace lightbench::stress

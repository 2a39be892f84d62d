#include "core/film/counters.h"

#include <tuple>

namespace lightbench {
namespace {

bool before(const SampleName& a, const SampleName& b) {
  return std::tie(a.sample, a.y, a.x) < std::tie(b.sample, b.y, b.x);
}

}  // namespace

const char* fault_name(Fault fault) {
  switch (fault) {
    case Fault::NotANumber:
      return "NaN";
    case Fault::Infinite:
      return "infinite";
    case Fault::Negative:
      return "negative";
    case Fault::BeyondFilm:
      return "beyond the film's range";
  }
  return "";
}

Counters& Counters::operator+=(const Counters& other) {
  if (other.non_finite > 0 && (non_finite == 0 || before(other.bad, bad))) {
    bad = other.bad;
    bad_fault = other.bad_fault;
  }
  paths += other.paths;
  rays += other.rays;
  shadow_rays += other.shadow_rays;
  non_finite += other.non_finite;
  for (int k = 0; k < kFaults; ++k) faults[k] += other.faults[k];
  return *this;
}

void Counters::drop(const SampleName& name, Fault fault) {
  if (non_finite == 0 || before(name, bad)) {
    bad = name;
    bad_fault = fault;
  }
  ++non_finite;
  ++faults[static_cast<int>(fault)];
}

}  // namespace lightbench

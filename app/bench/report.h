#pragma once
// A benchmark's figures as text, JSON and a web page.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/bench/measurement.h"

namespace lightbench::bench {

/// The lines of one scene.
std::string table(const Measurement& measurement);

/// Everything but the maps.
nlohmann::ordered_json to_json(const std::vector<Measurement>& measurements);

/// One file that needs no other: tables, error against time in log-log, maps of error, bias and
/// cost.
std::string page(const std::vector<Measurement>& measurements);

}  // namespace lightbench::bench

#include "app/bench/report.h"

#include <bench_page.h>
#include <chart_js.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>

#include "app/version.h"
#include "core/format.h"

namespace lightbench::bench {
namespace {

using Json = nlohmann::ordered_json;

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }
Json to_json(const Interval& i) { return {number(i.value), number(i.low), number(i.high)}; }

std::string text(const Interval& i, double scale = 1) {
  return fmt::format("{:.3g} [{:.3g}, {:.3g}]", scale * i.value, scale * i.low, scale * i.high);
}

/// A time to an error: below the first rung nothing is known but that, beyond the last it is
/// extrapolated.
std::string time_text(const Interval& i, const std::vector<CurvePoint>& curve) {
  if (i.value <= 0) return fmt::format("< {}", format_duration(curve.front().seconds));
  return fmt::format("{}{} [{}, {}]", i.value > curve.back().seconds ? "~" : "",
                     format_duration(i.value), format_duration(i.low), format_duration(i.high));
}

Json to_json(const CurvePoint& p) {
  return {{"spp", p.spp},
          {"seconds", p.seconds},
          {"mse", p.mse},
          {"relMSE", p.relmse},
          {"relMSEDeviation", p.relmse_deviation},
          {"relMSEWithoutWorstThousandth", p.trimmed_relmse}};
}

Json to_json(const SubjectResult& r, bool first) {
  const Figures& f = r.figures;
  Json curve = Json::array();
  for (const CurvePoint& p : f.curve) curve.push_back(to_json(p));
  Json json = {{"name", r.subject.name},
               {"kernel", kernel_name(r.stats.kernel)},
               {"threads", r.subject.threads},
               {"runs", f.runs},
               {"samplesPerSecond", f.samples_per_second},
               {"raysPerSecond", f.rays_per_second},
               {"nanosecondsPerVertex", f.vertex_nanoseconds},
               {"nonFiniteSamples", f.non_finite},
               {"relMSE", to_json(f.relmse)},
               {"efficiency", to_json(f.efficiency)},
               {"relativeBias", to_json(f.bias)},
               {"secondsToRelMSE0.01", to_json(f.seconds_to_1e2)},
               {"secondsToRelMSE0.001", to_json(f.seconds_to_1e3)},
               {"curve", curve}};
  if (!first) {
    json["againstFirst"] = {{"seconds", r.ratio.seconds},
                            {"efficiencyRatio", to_json(r.ratio.efficiency)},
                            {"speedRatio", to_json(r.ratio.sample_time)}};
  }
  return json;
}

std::string name_of(const Measurement& m) {
  return std::filesystem::path(m.scene_file).stem().string();
}

/// A map as one byte per pixel and what 0 and 255 stand for, for the page to draw.
Json image_of(const std::vector<float>& map, bool is_signed) {
  std::vector<float> sorted(map);
  for (float& v : sorted) v = std::abs(v);
  const auto top = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() * 995 / 1000);
  std::nth_element(sorted.begin(), top, sorted.end());
  const double most = std::max(1e-30, static_cast<double>(*top));
  static constexpr std::string_view kDigits = "0123456789abcdef";
  std::string bytes;
  for (const float v : map) {
    const double share = is_signed ? 0.5 + 0.5 * v / most : v / most;
    const long byte = std::lround(255 * std::clamp(share, 0.0, 1.0));
    bytes += {kDigits[static_cast<std::size_t>(byte / 16)],
              kDigits[static_cast<std::size_t>(byte % 16)]};
  }
  return {{"low", is_signed ? -most : 0.0}, {"high", most}, {"bytes", bytes}};
}

std::string_view bytes_of(const unsigned char* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace

std::string table(const Measurement& m) {
  std::string out = fmt::format("\n{}, {}x{}, reference of {} spp with relMSE {:.2g}\n", name_of(m),
                                m.reference.image.width, m.reference.image.height, m.reference.spp,
                                m.reference.relmse);
  for (std::size_t k = 0; k < m.subjects.size(); ++k) {
    const SubjectResult& r = m.subjects[k];
    const Figures& f = r.figures;
    const CurvePoint& last = f.curve.back();
    out += fmt::format("  {}: {}, {} threads, {} runs of {} spp in {}\n", r.subject.name,
                       kernel_name(r.stats.kernel), r.subject.threads, f.runs, last.spp,
                       format_duration(last.seconds));
    out += fmt::format("    speed        {}, {}, {:.1f} ns per path vertex\n",
                       format_count(f.samples_per_second, "samples/s"),
                       format_count(f.rays_per_second, "rays/s"), f.vertex_nanoseconds);
    out += fmt::format("    relMSE       {}, without the worst thousandth {:.3g}; MSE {:.3g}\n",
                       text(f.relmse), last.trimmed_relmse, last.mse);
    out += fmt::format("    efficiency   {} / s\n", text(f.efficiency));
    out += fmt::format("    to 0.01      {}\n    to 0.001     {}\n",
                       time_text(f.seconds_to_1e2, f.curve), time_text(f.seconds_to_1e3, f.curve));
    out += fmt::format("    bias         {} %\n", text(f.bias, 100));
    if (f.non_finite > 0) out += fmt::format("    dropped      {} samples\n", f.non_finite);
    if (k > 0) {
      out += fmt::format(
          "    against {}: {} times as efficient ({} of rendering each), {} times as fast\n",
          m.subjects[0].subject.name, text(r.ratio.efficiency), format_duration(r.ratio.seconds),
          text(r.ratio.sample_time));
    }
  }
  return out;
}

Json to_json(const std::vector<Measurement>& measurements) {
  Json scenes = Json::array();
  for (const Measurement& m : measurements) {
    Json subjects = Json::array();
    for (const SubjectResult& r : m.subjects) {
      subjects.push_back(to_json(r, &r == &m.subjects.front()));
    }
    scenes.push_back({{"scene", m.scene_file},
                      {"resolution", {m.reference.image.width, m.reference.image.height}},
                      {"reference",
                       {{"spp", m.reference.spp},
                        {"mse", m.reference.mse},
                        {"relMSE", m.reference.relmse},
                        {"pictureHash", fmt::format("{:016x}", m.reference.hash)}}},
                      {"subjects", subjects}});
  }
  return {{"version", version_text()}, {"scenes", scenes}};
}

std::string page(const std::vector<Measurement>& measurements) {
  Json data = to_json(measurements);
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    data["scenes"][i]["name"] = name_of(measurements[i]);
    for (std::size_t k = 0; k < measurements[i].subjects.size(); ++k) {
      const SubjectResult& r = measurements[i].subjects[k];
      data["scenes"][i]["subjects"][k]["maps"] = {{"error", image_of(r.error_map, false)},
                                                  {"bias", image_of(r.bias_map, true)},
                                                  {"cost", image_of(r.cost_map, false)}};
    }
  }
  std::string html(bytes_of(bench_page, bench_page_size));
  const auto fill = [&html](std::string_view mark, std::string_view content) {
    html.replace(html.find(mark), mark.size(), content);
  };
  // "<" is escaped so that no name in the data can end the script.
  std::string text = data.dump();
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) {
    text.replace(at, 1, "\\u003c");
  }
  fill("/*DATA*/", text);
  fill("/*CHART_JS*/", bytes_of(chart_js, chart_js_size));
  return html;
}

}  // namespace lightbench::bench

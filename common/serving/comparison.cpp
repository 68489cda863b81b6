#include "serving/comparison.hpp"

#include <initializer_list>
#include <nlohmann/json.hpp>

namespace demecal::inline serving {
namespace {

using Json = nlohmann::ordered_json;

/// What is there of these keys, or null.
Json members(const Json& from, std::initializer_list<const char*> keys) {
  Json found = Json::object();
  for (const char* const key : keys) found[key] = from.is_object() && from.contains(key) ? from[key] : Json();
  return found;
}

Json row(const std::string& job, const std::string& text) {
  const Json report = Json::parse(text, nullptr, false);
  if (!report.is_object() || !report.contains("error_mm")) return {{"job", job}, {"readable", false}};
  Json made{{"job", job}, {"readable", true}};
  made.update(members(report, {"robot", "method", "seed", "data_sha256", "version"}));
  const Json& errors = report["error_mm"];
  for (const char* const stage : {"registered", "before", "after"}) {
    const Json sets = members(errors, {stage})[stage];
    for (const char* const set : {"calibration", "validation", "accept"})
      made["error_mm"][stage][set] = members(members(sets, {set})[set], {"mean", "rms", "p95", "max"});
  }
  return made;
}

}  // namespace

std::string comparison_text(const std::vector<std::pair<std::string, std::string>>& reports) {
  Json rows = Json::array();
  for (const auto& [job, text] : reports) rows.push_back(row(job, text));
  return Json{{"demecal_jobs_comparison", 1}, {"jobs", std::move(rows)}}.dump() + '\n';
}

}  // namespace demecal::inline serving

#include <fmt/format.h>

#include "report/html_text.hpp"
#include "report/sections.hpp"

namespace demecal {
namespace {

std::string fact(const std::string& what, const std::string& markup, const char* css_class = "") {
  if (markup.empty()) return {};
  return fmt::format("<div class=\"{}\"><dt>{}</dt><dd>{}</dd></div>\n", css_class, what, markup);
}

std::string count_text(const JsonValue& value) {
  const std::optional<std::uint64_t> count = value.count();
  return count ? grouped(*count) : "";
}

std::string rate(const JsonValue& runtime) {
  const auto evaluations = runtime["evaluations"].count();
  const auto wall_s = runtime["wall_s"].number();
  if (!evaluations || !wall_s || *wall_s <= 0.0) return {};
  const double per_s = static_cast<double>(*evaluations) / *wall_s;
  return per_s < 1e15 ? grouped(static_cast<std::uint64_t>(per_s)) : "";
}

std::string code(const std::string& text) {
  return text.empty() ? text : "<code>" + escaped(text) + "</code>";
}

/// The mean over the workers.
std::string waiting(const JsonValue& runtime) {
  double sum = 0.0;
  int workers = 0;
  for (const JsonValue& worker : runtime["waited_share"].elements()) {
    const auto share = worker["share"].number();
    if (!share) continue;
    sum += *share;
    ++workers;
  }
  return workers == 0 ? "" : fixed(100.0 * sum / workers, 1) + " %";
}

std::string schedule(const JsonValue& runtime) {
  if (!runtime["asynchronous"].truth().value_or(false)) return {};
  return "asynchronous: another run of this job gives another result";
}

std::string runtime_facts(const JsonValue& runtime) {
  const auto wall_s = runtime["wall_s"].number();
  return fact("wall time", wall_s ? duration(*wall_s) : "") + fact("workers", count_text(runtime["workers"])) +
         fact("islands", count_text(runtime["islands"])) + fact("generations", count_text(runtime["generations"])) +
         fact("evaluations", count_text(runtime["evaluations"])) + fact("evaluations per second", rate(runtime)) +
         fact("migrations", count_text(runtime["migrations"])) + fact("workers' time spent waiting", waiting(runtime)) +
         fact("schedule", schedule(runtime));
}

std::string provenance(const JsonValue& report) {
  const auto seed = report["seed"].count();
  return fact("seed", seed ? std::to_string(*seed) : "") + fact("method", escaped(report["method"].text())) +
         fact("demecal", escaped(report["version"].text())) +
         fact("SHA-256 of the data", code(report["data_sha256"].text()), "wide");
}

}  // namespace

std::string run_section(const JsonValue& report) {
  const std::string facts = runtime_facts(report["runtime"]) + provenance(report);
  return section("run", "The run", facts.empty() ? "" : "<div class=\"panel\"><dl>\n" + facts + "</dl></div>\n");
}

}  // namespace demecal

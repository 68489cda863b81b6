#include "report/data_check_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "report/json_number.hpp"
#include "report/terminal_text.hpp"

namespace demecal {
namespace {

constexpr std::size_t kMostShown = 10;

}  // namespace

std::string data_check_to_terminal(const DataCheck& check) {
  std::vector<const Finding*> findings;
  for (const Finding& finding : check.findings) findings.push_back(&finding);
  std::ranges::stable_sort(findings, [](const Finding* one, const Finding* other) {
    return contradicts(one->kind) && !contradicts(other->kind);
  });
  std::string text;
  for (std::size_t i = 0; i < std::min(findings.size(), kMostShown); ++i)
    text += wrapped("  -", findings[i]->sentence, 4);
  if (findings.size() > kMostShown) text += fmt::format("  - {} more in report.json\n", findings.size() - kMostShown);
  return text;
}

nlohmann::ordered_json data_check_to_json(const DataCheck& check) {
  nlohmann::ordered_json findings = nlohmann::ordered_json::array();
  for (const Finding& finding : check.findings) {
    findings.push_back(
        {{"kind", to_string(finding.kind)},
         {"joint", finding.joint + 1},
         {"poses", finding.poses},
         {"error_mm",
          {{"as_given", number_or_null(finding.as_given_mm)}, {"if_changed", number_or_null(finding.if_changed_mm)}}},
         {"sentence", finding.sentence}});
  }
  return {{"verdict", to_string(check.verdict())}, {"findings", findings}};
}

}  // namespace demecal

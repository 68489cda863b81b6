#include "next_measurement/effect_words.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "effects/law_terms.hpp"
#include "effects/weight_parts.hpp"
#include "kinematics/units.hpp"
#include "next_measurement/next_measurement.hpp"

namespace demecal::inline next_measurement {
namespace {

/// Numbered by their values where these say which, as "gravity_turn_2".
std::vector<std::string> settings_in_use(const Effect& effect) {
  std::vector<std::string> names;
  for (const auto& [name, value] : effect.settings)
    if (value != 0.0) names.push_back(name == "gravity_turn" ? name + '_' + rounded_text(value) : name);
  return names;
}

}  // namespace

std::string masses_words(const std::vector<std::string>& settings) {
  std::vector<WeightPart> parts;
  std::string words, added;
  for (const std::string& name : settings) {
    const auto part = name.starts_with(kKeep) ? weight_part(std::string_view(name).substr(kKeep.size())) : std::nullopt;
    if (part) parts.push_back(*part);
    if (name == "with_payload") added += " and of the payload";
    if (name.starts_with("gravity_turn_"))
      added += name.ends_with('1') ? ", by a mount that leans one way" : ", by a mount that leans the other way";
  }
  if (parts.empty()) return {};
  std::set<int> links;
  for (const WeightPart& part : parts) links.insert(part.link + 1);
  const int first = *links.begin(), last = *links.rbegin();
  if (parts.size() == 1) {
    constexpr std::array<const char*, 4> kDirections{" along x", " along y", " along z", ""};
    words = "of link " + std::to_string(first) + kDirections.at(static_cast<std::size_t>(parts.front().axis));
  } else if (first == last) {
    words = "of link " + std::to_string(first);
  } else if (last - first + 1 == std::ssize(links)) {
    words = "of links " + std::to_string(first) + " to " + std::to_string(last);
  } else {
    for (const int link : links)
      words += (words.empty() ? "of links " : link == last ? " and " : ", ") + std::to_string(link);
  }
  return words + added;
}

std::string to_string(const Effect& effect) {
  std::string text = effect.kind;
  std::ranges::replace(text, '_', ' ');
  if (effect.joint >= 0) text += " of joint " + std::to_string(effect.joint + 1);
  std::vector<std::string> details;
  const std::vector<std::string> forms = law_of(effect).forms();
  if (!effect.form.empty() && effect.form != forms.front()) details.push_back(effect.form);
  for (const auto& [name, value] : effect.settings) {
    if (name == "from") details.push_back("from joint " + rounded_text(value));
    if (name == "per_turn") details.push_back(rounded_text(value) + " per turn");
    if (name == "at_rad") details.push_back("at " + significant_text(degrees(value), 4) + " deg");
    if (name == "ratio" || name == "order") details.push_back(name + ' ' + rounded_text(value));
  }
  if (const std::string masses = masses_words(settings_in_use(effect)); !masses.empty()) {
    if (details.empty()) details.emplace_back();
    details.front() += (details.front().empty() ? "" : " ") + masses;
  }
  for (std::size_t i = 0; i < details.size(); ++i) text += (i == 0 ? " (" : ", ") + details[i];
  return details.empty() ? text : text + ')';
}

}  // namespace demecal::inline next_measurement

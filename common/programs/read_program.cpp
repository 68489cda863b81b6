#include "programs/read_program.hpp"

#include <array>
#include <numbers>
#include <utility>

#include "data/lower_case.hpp"

namespace demecal {
namespace {

constexpr std::array<std::pair<std::string_view, Language>, 5> kWords{{{"val2", Language::val2},
                                                                       {"csv", Language::csv},
                                                                       {"krl", Language::krl},
                                                                       {"rapid", Language::rapid},
                                                                       {"urscript", Language::urscript}}};

constexpr std::array<std::pair<std::string_view, Language>, 15> kEndings{{{"csv", Language::csv},
                                                                          {"v2", Language::val2},
                                                                          {"val", Language::val2},
                                                                          {"val2", Language::val2},
                                                                          {"pg", Language::val2},
                                                                          {"lc", Language::val2},
                                                                          {"src", Language::krl},
                                                                          {"krl", Language::krl},
                                                                          {"mod", Language::rapid},
                                                                          {"modx", Language::rapid},
                                                                          {"sys", Language::rapid},
                                                                          {"sysx", Language::rapid},
                                                                          {"rapid", Language::rapid},
                                                                          {"script", Language::urscript},
                                                                          {"urscript", Language::urscript}}};

/// Words that only one of the languages has.
constexpr std::array<std::pair<std::string_view, Language>, 16> kSigns{{{".locations", Language::val2},
                                                                        {".program", Language::val2},
                                                                        {"robtarget", Language::rapid},
                                                                        {"jointtarget", Language::rapid},
                                                                        {"endmodule", Language::rapid},
                                                                        {"e6pos", Language::krl},
                                                                        {"e6axis", Language::krl},
                                                                        {"defdat", Language::krl},
                                                                        {"&access", Language::krl},
                                                                        {"ptp {", Language::krl},
                                                                        {"lin {", Language::krl},
                                                                        {"movej", Language::urscript},
                                                                        {"movel(", Language::urscript},
                                                                        {"movep(", Language::urscript},
                                                                        {"q1_", Language::csv},
                                                                        {"x_mm", Language::csv}}};

}  // namespace

CellUnit degrees_or_mm(const Joint& joint) {
  if (!is_revolute(joint)) return kMillimetres;
  return {std::numbers::pi / 180.0, kDecimalsDeg};
}

Program read_program(Language language, std::string_view text, const std::string& file, const Chain& arm) {
  switch (language) {
    case Language::val2:
      return read_val2(text, file, arm);
    case Language::csv:
      return read_csv_targets(text, file, arm);
    case Language::krl:
      return read_krl(text, file, arm);
    case Language::rapid:
      return read_rapid(text, file, arm);
    case Language::urscript:
      return read_urscript(text, file, arm);
  }
  return {};
}

std::optional<Language> language_named(std::string_view word) {
  for (const auto& [name, language] : kWords) {
    if (name == lower_case(word)) return language;
  }
  return std::nullopt;
}

std::string_view word_of(Language language) {
  for (const auto& [name, named] : kWords) {
    if (named == language) return name;
  }
  return "";
}

std::optional<Language> language_of(std::string_view text, const std::string& file) {
  const std::size_t point = file.rfind('.');
  const std::string ending = point == std::string::npos ? "" : lower_case(file.substr(point + 1));
  for (const auto& [name, language] : kEndings) {
    if (name == ending) return language;
  }
  const std::string words = lower_case(text);
  for (const auto& [sign, language] : kSigns) {
    if (words.find(sign) != std::string::npos) return language;
  }
  return std::nullopt;
}

}  // namespace demecal

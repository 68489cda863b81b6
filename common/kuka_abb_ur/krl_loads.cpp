#include "kuka_abb_ur/krl_loads.hpp"

#include <algorithm>
#include <string>

#include "data/text.hpp"
#include "parsed_programs/payload_values.hpp"

namespace demecal::inline kuka_abb_ur {

std::optional<double> stated_load_kg(std::string_view code, std::size_t at) {
  constexpr std::string_view kMass = "{m ";
  const std::size_t begin = std::min(code.find_first_not_of(" \t", at), code.size());
  if (code.substr(begin).starts_with(kMass)) return number_argument(code, begin + kMass.size());
  return declared_load_kg(code, load_name(code, at), "=", kMass);
}

std::optional<double> changed_load_kg(std::string_view code, std::size_t at) {
  if (load_name(code, at) != "m") return std::nullopt;
  const std::size_t sign = code.find_first_not_of(" \t", code.find('m', at) + 1);
  return sign < code.size() && code[sign] == '=' ? number_argument(code, sign + 1) : std::nullopt;
}

namespace {

std::optional<double> load_of_tool(std::string_view code, const std::optional<double>& number) {
  constexpr std::string_view kMass = "{m ";
  if (!number || *number < 1.0) return std::nullopt;
  return declared_load_kg(code, "load_data[" + number_text(*number) + "]", "=", kMass);
}

}  // namespace

std::optional<double> selected_load_kg(std::string_view code, std::size_t at) {
  return load_of_tool(code, number_argument(code, at));
}

std::optional<double> inline_load_kg(std::string_view code, std::size_t at) {
  return load_of_tool(code, declared_load_kg(code, load_name(code, at), "=", "{tool_no "));
}

std::optional<double> with_load_kg(std::string_view code, std::size_t at) {
  constexpr std::string_view kOfTool = "sload";
  const std::size_t sign = std::min(code.find_first_not_of(" \t", at), code.size());
  if (sign == code.size()) return std::nullopt;
  if (code[sign] == '.') return changed_load_kg(code, sign + 1);
  if (code[sign] != '=') return std::nullopt;
  if (load_name(code, sign + 1) != kOfTool) return stated_load_kg(code, sign + 1);
  const std::size_t open = code.find_first_not_of(" \t", code.find(kOfTool, sign) + kOfTool.size());
  return open < code.size() && code[open] == '(' ? load_of_tool(code, number_argument(code, open + 1)) : std::nullopt;
}

}  // namespace demecal::inline kuka_abb_ur

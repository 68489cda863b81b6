#include "manual/manual.hpp"

#include <algorithm>
#include <sstream>

namespace demecal::inline manual {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::istringstream stream(text);
  std::vector<std::string> parts;
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

/// The first colon outside of brackets.
std::size_t first_colon(const std::string& type) {
  int depth = 0;
  for (std::size_t i = 0; i < type.size(); ++i) {
    if (type[i] == '[') ++depth;
    if (type[i] == ']') --depth;
    if (type[i] == ':' && depth == 0) return i;
  }
  return std::string::npos;
}

/// Validators describe themselves behind the type, as "TEXT:{a,b}", "INT:INT in [0 - 256]" or "FLOAT:POSITIVE".
void describe_value(const std::string& type, DescribedOption& option) {
  const std::size_t colon = first_colon(type);
  option.value = type.substr(0, colon);
  if (colon == std::string::npos) return;
  const std::string rule = type.substr(colon + 1);
  const std::size_t open = rule.find_first_of("{["), close = rule.find_last_of("}]");
  if (rule == "POSITIVE") {
    option.rule = "more than 0";
  } else if (rule == "NONNEGATIVE") {
    option.rule = "0 or more";
  } else if (open != std::string::npos && close != std::string::npos && rule[open] == '{') {
    option.choices = split(rule.substr(open + 1, close - open - 1), ',');
  } else if (open != std::string::npos && close != std::string::npos) {
    option.rule = rule.substr(open + 1, close - open - 1);
    const std::size_t dash = option.rule.find(" - ");
    if (dash != std::string::npos) option.rule.replace(dash, 3, " to ");
  }
}

DescribedOption describe_option(const CLI::Option& option) {
  DescribedOption described;
  described.positional = !option.nonpositional();
  described.required = option.get_required();
  described.description = option.get_description();
  described.environment = option.get_envname();
  if (described.positional) {
    described.names = {option.get_name(true)};
  } else {
    for (const std::string& name : option.get_snames()) described.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) described.names.push_back("--" + name);
  }
  if (option.get_items_expected_max() > 0) {
    describe_value(option.get_type_name(), described);
    described.standard = option.get_default_str();
  }
  for (const CLI::Option* other : option.get_excludes()) described.excluded.push_back(other->get_name());
  std::ranges::sort(described.excluded);
  return described;
}

}  // namespace

std::vector<DescribedOption> described_options(const CLI::App& command) {
  std::vector<DescribedOption> options;
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_group().empty()) options.push_back(describe_option(*option));
  }
  std::stable_partition(options.begin(), options.end(), [](const DescribedOption& one) { return one.positional; });
  return options;
}

}  // namespace demecal::inline manual

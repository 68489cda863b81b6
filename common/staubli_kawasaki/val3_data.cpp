#include "data/text.hpp"
#include "parsed_programs/program_text.hpp"
#include "staubli_kawasaki/val3_program.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace demecal::inline staubli_kawasaki {
namespace {

constexpr std::string_view kXmlSpaces = " \t\r\n";

struct Tag {
  std::string_view name{};
  std::size_t end = 0;  ///< past its '>'
  std::map<std::string, BracketItem> attributes{};
};

class TagReader {
 public:
  explicit TagReader(const ProgramText& text) : text_(text), bytes_(text.text()) {}

  /// The tag that opens at `begin`.
  Tag tag(std::size_t begin) const {
    Tag made;
    std::size_t at = std::min(bytes_.find_first_of(" \t\r\n/>", begin + 2), bytes_.size());
    made.name = bytes_.substr(begin + 1, at - begin - 1);
    while ((at = bytes_.find_first_not_of(" \t\r\n/?", at)) < bytes_.size() && bytes_[at] != '>')
      at = attribute(begin, at, made);
    if (at >= bytes_.size()) text_.fail(begin, 1, "opens a tag that is never closed");
    made.end = at + 1;
    return made;
  }

  /// Past what begins with `opening` at `begin` and ends with `closing`; `begin` where something else stands there.
  std::size_t past(std::size_t begin, std::string_view opening, std::string_view closing) const {
    if (!bytes_.substr(begin).starts_with(opening)) return begin;
    const std::size_t end = bytes_.find(closing, begin + opening.size());
    return end == std::string_view::npos ? bytes_.size() : end + closing.size();
  }

 private:
  /// Reads name="value" at `at` into the tag; returns where to go on.
  std::size_t attribute(std::size_t begin, std::size_t at, Tag& made) const {
    const std::size_t end = std::min(bytes_.find_first_of("= \t\r\n/>", at), bytes_.size());
    const std::string name(bytes_.substr(at, end - at));
    const std::size_t sign = std::min(bytes_.find_first_not_of(kXmlSpaces, end), bytes_.size());
    if (sign >= bytes_.size() || bytes_[sign] != '=') return std::max(end, at + 1);
    const std::size_t quote = std::min(bytes_.find_first_not_of(kXmlSpaces, sign + 1), bytes_.size());
    if (quote >= bytes_.size() || (bytes_[quote] != '"' && bytes_[quote] != '\''))
      text_.fail(at, name.size(), "must have a value in quotes");
    const std::size_t close = bytes_.find(bytes_[quote], quote + 1);
    if (close == std::string_view::npos) text_.fail(begin, 1, "opens a tag with a quote that is never closed");
    made.attributes.try_emplace(name, BracketItem{quote + 1, close - quote - 1, false, {}});
    return close + 1;
  }

  const ProgramText& text_;
  std::string_view bytes_;
};

/// Where the code that begins at `begin` ends: before </Code>, and behind what stands in a CDATA section.
std::size_t end_of_code(std::string_view bytes, std::size_t begin) {
  const std::size_t section = bytes.find_first_not_of(kXmlSpaces, begin);
  if (section < bytes.size() && bytes.substr(section).starts_with("<![CDATA[")) begin = bytes.find("]]>", section);
  return std::min(bytes.find("</Code>", std::min(begin, bytes.size())), bytes.size());
}

std::string attribute_value(const ProgramText& text, const Tag& tag, const std::string& attribute) {
  const auto found = tag.attributes.find(attribute);
  if (found == tag.attributes.end()) return "";
  return std::string(text.text().substr(found->second.begin, found->second.size));
}

/// Calls visit(tag, begin) with every tag that is neither in a comment nor in code.
template <typename Visit>
void for_each_tag(const ProgramText& text, const Visit& visit) {
  const std::string_view bytes = text.text();
  const TagReader reader(text);
  for (std::size_t at = bytes.find('<'); at < bytes.size(); at = bytes.find('<', at)) {
    const std::size_t passed = std::max(reader.past(at, "<!--", "-->"), reader.past(at, "<![CDATA[", "]]>"));
    if (passed > at) {
      at = passed;
      continue;
    }
    const Tag tag = reader.tag(at);
    visit(tag, at);
    at = tag.name == "Code" ? end_of_code(bytes, tag.end) : tag.end;
  }
}

}  // namespace

std::vector<Val3Value> val3_values(const ProgramText& text) {
  std::vector<Val3Value> values;
  std::string name, type;
  for_each_tag(text, [&](const Tag& tag, std::size_t at) {
    if (tag.name == "Data") {
      name = attribute_value(text, tag, "name");
      type = attribute_value(text, tag, "type");
    } else if (tag.name == "/Data") {
      type.clear();
    } else if (tag.name == "Value" && !type.empty()) {
      const std::string key = attribute_value(text, tag, "key");
      values.push_back({name + '[' + (key.empty() ? "0" : key) + ']', type, at, tag.attributes});
    }
  });
  return values;
}

std::vector<Val3Code> val3_programs(const ProgramText& text) {
  std::vector<Val3Code> programs;
  std::set<std::string> locals;
  std::string name;
  for_each_tag(text, [&](const Tag& tag, std::size_t) {
    if (tag.name == "Program") {
      locals.clear();
      name = attribute_value(text, tag, "name");
    }
    if (tag.name == "Parameter" || tag.name == "Local") locals.insert(attribute_value(text, tag, "name"));
    if (tag.name == "Code") programs.push_back({name, tag.end, end_of_code(text.text(), tag.end), locals});
  });
  return programs;
}

std::string val3_inches(const ProgramText& text, const ControllerData& controller) {
  const auto says = [](const ProgramText& application) {
    bool inches = false;
    for_each_tag(application, [&](const Tag& tag, std::size_t) {
      inches = inches || lower_case(attribute_value(application, tag, "millimeterUnit")) == "false";
    });
    return inches;
  };
  const auto is_of = [&](const std::string& application) {
    return std::ranges::any_of(text.source().files(), [&](const ProgramFile& file) {
      const std::size_t folder = file.name.find_last_of("/\\");
      return application.find(file.name.substr(folder + 1)) != std::string::npos;  // npos + 1: there is no folder
    });
  };
  std::string by = says(text) ? "millimeterUnit=\"false\"" : "";
  for (const ProgramFile& file : controller.applications) {
    const ProgramSource alone(file.text, file.name);
    if (by.empty() && is_of(file.text) && says(ProgramText(alone, {}))) by = "millimeterUnit=\"false\" in " + file.name;
  }
  if (by.empty()) return "";
  return "the application counts in inches (" + by + "), and only millimetres are read: convert it to millimetres";
}

}  // namespace demecal::inline staubli_kawasaki

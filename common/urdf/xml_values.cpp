#include "urdf/xml_values.hpp"

#include <algorithm>
#include <optional>

#include "data/text.hpp"
#include "errors/input_error.hpp"

namespace demecal::inline urdf {
namespace {

constexpr std::string_view kXmlBlanks = " \t\r\n";

/// As many numbers with blanks between; nothing where they are more, fewer or no numbers.
std::optional<std::vector<double>> parsed_numbers(std::string_view text, std::size_t count) {
  std::vector<double> numbers;
  for (std::string_view rest = without_blanks(text); !rest.empty(); rest = without_blanks(rest)) {
    const std::size_t end = std::min(rest.find_first_of(kXmlBlanks), rest.size());
    const auto parsed = parse_number(rest.substr(0, end));
    if (!parsed || numbers.size() == count) return std::nullopt;
    numbers.push_back(*parsed);
    rest.remove_prefix(end);
  }
  return numbers.size() == count ? std::optional(numbers) : std::nullopt;
}

}  // namespace

std::string_view without_blanks(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kXmlBlanks);
  return begin == std::string_view::npos ? "" : text.substr(begin, text.find_last_not_of(kXmlBlanks) - begin + 1);
}

void XmlValues::fail(const XmlElement& element, const std::string& value, const std::string& rule) const {
  throw InputError({file_, element.line}, value, rule);
}

const std::string& XmlValues::text(const XmlElement& element, std::string_view key) const {
  const XmlAttribute* found = element.attribute(key);
  if (found == nullptr || found->value.empty())
    fail(element, "<" + element.name + ">", "must state its " + std::string(key));
  return found->value;
}

double XmlValues::number_or(const XmlElement* element, std::string_view key, double otherwise) const {
  const XmlAttribute* found = element == nullptr ? nullptr : element->attribute(key);
  if (found == nullptr) return otherwise;
  const auto parsed = parse_number(without_blanks(found->value));
  if (!parsed) fail(*element, found->value, "must be a number: " + found->name + " of <" + element->name + ">");
  return *parsed;
}

Eigen::Vector3d XmlValues::vector_or(const XmlElement* element, std::string_view key,
                                     const Eigen::Vector3d& otherwise) const {
  const XmlAttribute* found = element == nullptr ? nullptr : element->attribute(key);
  if (found == nullptr) return otherwise;
  const auto parsed = parsed_numbers(found->value, 3);
  if (!parsed) fail(*element, found->value, "must be 3 numbers: " + std::string(key) + " of <" + element->name + ">");
  return Eigen::Vector3d(parsed->data());
}

Origin XmlValues::origin(const XmlElement* element) const {
  if (element != nullptr && element->attribute("quat_xyzw") != nullptr)
    fail(*element, "quat_xyzw", "is not read here: state the same orientation as rpy");
  return {vector_or(element, "xyz", Eigen::Vector3d::Zero()), vector_or(element, "rpy", Eigen::Vector3d::Zero())};
}

std::string XmlValues::content(const XmlElement& element) const {
  const std::string_view found = without_blanks(element.text);
  if (found.empty()) fail(element, "<" + element.name + ">", "must not be empty");
  return std::string(found);
}

std::vector<double> XmlValues::numbers(const XmlElement& element, std::size_t count) const {
  const auto parsed = parsed_numbers(element.text, count);
  const std::string rule = count == 1 ? "must be a number: <" : "must be " + std::to_string(count) + " numbers: <";
  if (!parsed) fail(element, std::string(without_blanks(element.text)), rule + element.name + ">");
  return *parsed;
}

void XmlValues::refuse_xacro(const XmlElement& element, bool stated) const {
  const auto refuse = [&](const std::string& value) {
    fail(element, value, "is xacro that is not expanded; run `xacro FILE.xacro > FILE.urdf` and import that");
  };
  if (element.name.starts_with("xacro:")) refuse("<" + element.name + ">");
  for (const XmlAttribute& attribute : element.attributes) {
    if (!stated) break;
    if (attribute.value.find("${") != std::string::npos || attribute.value.find("$(") != std::string::npos)
      refuse(attribute.value);
  }
  for (const XmlElement& child : element.children)
    refuse_xacro(child, stated || child.name == "link" || child.name == "joint");
}

}  // namespace demecal::inline urdf

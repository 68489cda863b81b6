// Names and numbers of XML elements, read strictly.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinematics/drawn_arm.hpp"
#include "urdf/xml.hpp"

namespace demecal::inline urdf {

/// Every function throws InputError with file, line, value and rule where what it reads is not there or is wrong.
class XmlValues {
 public:
  explicit XmlValues(std::string file) : file_(std::move(file)) {}

  const std::string& file() const { return file_; }
  [[noreturn]] void fail(const XmlElement& element, const std::string& value, const std::string& rule) const;

  const std::string& text(const XmlElement& element, std::string_view key) const;
  double number_or(const XmlElement* element, std::string_view key, double otherwise) const;
  Origin origin(const XmlElement* element) const;
  Eigen::Vector3d vector_or(const XmlElement* element, std::string_view key, const Eigen::Vector3d& otherwise) const;

  /// What stands between the element's tags, which must not be empty.
  std::string content(const XmlElement& element) const;
  /// As many numbers between the element's tags.
  std::vector<double> numbers(const XmlElement& element, std::size_t count) const;

  /// Xacro has to be expanded before. Attributes count where links and joints are stated: plugins may hold anything.
  void refuse_xacro(const XmlElement& element, bool stated = false) const;

 private:
  std::string file_;
};

/// Without what is blank before and behind it.
std::string_view without_blanks(std::string_view text);

}  // namespace demecal::inline urdf

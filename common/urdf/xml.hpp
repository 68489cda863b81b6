// XML as elements that know the bytes they stand in, so that a value can be replaced and everything else left alone.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace demecal::inline urdf {

struct XmlAttribute {
  std::string name;
  std::string value;      ///< entities resolved
  std::size_t begin = 0;  ///< of the value's bytes, within the quotes
  std::size_t end = 0;
};

struct XmlElement {
  std::string name;
  std::size_t line = 0;        ///< from 1
  std::size_t begin = 0;       ///< of its start tag
  std::size_t tag_end = 0;     ///< behind its start tag
  bool stands_closed = false;  ///< "<name/>"
  std::vector<XmlAttribute> attributes;
  std::vector<XmlElement> children;
  std::string text;  ///< directly in it, without comments; known entities resolved, others as they stand

  const XmlAttribute* attribute(std::string_view key) const;
  /// The first child of that name.
  const XmlElement* child(std::string_view key) const;
};

/// The root element of a document. Throws InputError with file and line where it is no well-formed XML in UTF-8.
XmlElement parse_xml(const std::string& text, const std::string& file);

}  // namespace demecal::inline urdf

// XML documents, element by element; the only file that knows libxml2.
#pragma once

#include <memory>
#include <string>
#include <utility>

namespace demecal::inline certificate {

/// Writes one document in UTF-8. Texts may hold any bytes: what XML does not allow is replaced.
class XmlDocument {
 public:
  XmlDocument();
  ~XmlDocument();
  XmlDocument(const XmlDocument&) = delete;
  XmlDocument& operator=(const XmlDocument&) = delete;

  void open(const std::string& name);
  void attribute(const std::string& name, const std::string& value);
  void close();
  /// An element with nothing but text.
  void leaf(const std::string& name, const std::string& text);
  /// An element with what `content` writes.
  template <typename Content>
  void element(const std::string& name, const Content& content) {
    open(name);
    content();
    close();
  }
  /// The finished document; nothing may be written after.
  std::string text();

 private:
  struct Writer;
  std::unique_ptr<Writer> writer_;
};

/// `text` in UTF-8 without control characters, no white space at its ends and one blank for any within.
std::string xml_text(const std::string& text);

}  // namespace demecal::inline certificate

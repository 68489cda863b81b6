#include "certificate/xml.hpp"

#include <libxml/tree.h>
#include <libxml/xmlstring.h>
#include <libxml/xmlwriter.h>
#include <cstddef>

#include "errors/check.hpp"

namespace demecal::inline certificate {
namespace {

const xmlChar* xml_bytes(const std::string& text) {
  return reinterpret_cast<const xmlChar*>(text.c_str());
}

/// A letter of `length` bytes that XML does not allow: U+FFFE and U+FFFF are none.
bool is_noncharacter(const std::string& letter) {
  return letter == "\xEF\xBF\xBE" || letter == "\xEF\xBF\xBF";
}

}  // namespace

struct XmlDocument::Writer {
  xmlBufferPtr buffer = xmlBufferCreate();
  xmlTextWriterPtr writer = xmlNewTextWriterMemory(buffer, 0);
};

XmlDocument::XmlDocument() : writer_(std::make_unique<Writer>()) {
  DEMECAL_CHECK(writer_->writer != nullptr, "no memory for a document");
  xmlTextWriterSetIndent(writer_->writer, 1);
  xmlTextWriterStartDocument(writer_->writer, nullptr, "UTF-8", nullptr);
}

XmlDocument::~XmlDocument() {
  xmlFreeTextWriter(writer_->writer);
  xmlBufferFree(writer_->buffer);
}

void XmlDocument::open(const std::string& name) {
  xmlTextWriterStartElement(writer_->writer, xml_bytes(name));
}

void XmlDocument::attribute(const std::string& name, const std::string& value) {
  xmlTextWriterWriteAttribute(writer_->writer, xml_bytes(name), xml_bytes(xml_text(value)));
}

void XmlDocument::close() {
  xmlTextWriterEndElement(writer_->writer);
}

void XmlDocument::leaf(const std::string& name, const std::string& text) {
  xmlTextWriterWriteElement(writer_->writer, xml_bytes(name), xml_bytes(xml_text(text)));
}

std::string XmlDocument::text() {
  xmlTextWriterEndDocument(writer_->writer);
  xmlTextWriterFlush(writer_->writer);
  return {reinterpret_cast<const char*>(xmlBufferContent(writer_->buffer)),
          static_cast<std::size_t>(xmlBufferLength(writer_->buffer))};
}

std::string xml_text(const std::string& text) {
  std::string clean;
  bool blank = false;
  for (std::size_t at = 0; at < text.size();) {
    int length = static_cast<int>(text.size() - at);
    const int letter = xmlGetUTF8Char(xml_bytes(text) + at, &length);
    std::string bytes = letter < 0 ? std::string("?") : text.substr(at, static_cast<std::size_t>(length));
    at += letter < 0 ? 1 : static_cast<std::size_t>(length);
    if (letter >= 0 && (letter < 0x20 || letter == ' ')) {
      blank = !clean.empty();
      continue;
    }
    if (is_noncharacter(bytes) || letter == 0x7F) bytes = "?";
    if (blank) clean += ' ';
    blank = false;
    clean += bytes;
  }
  return clean;
}

}  // namespace demecal::inline certificate

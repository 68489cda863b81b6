#include "urdf/xml.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <system_error>
#include <utility>

#include "errors/input_error.hpp"

namespace demecal::inline urdf {
namespace {

constexpr std::size_t kDeepestElement = 200;

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

bool is_name(char c) {
  const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  return letter || c == '_' || c == ':' || c == '-' || c == '.' || static_cast<unsigned char>(c) >= 0x80;
}

/// A code point as UTF-8; nothing where it is none.
std::string utf8(std::uint32_t code) {
  std::string bytes;
  const auto add = [&](std::uint32_t byte) { bytes += static_cast<char>(static_cast<unsigned char>(byte)); };
  if (code == 0 || code > 0x10ffff) return {};
  if (code < 0x80) {
    add(code);
  } else if (code < 0x800) {
    add(0xc0 | code >> 6), add(0x80 | (code & 0x3f));
  } else if (code < 0x10000) {
    add(0xe0 | code >> 12), add(0x80 | (code >> 6 & 0x3f)), add(0x80 | (code & 0x3f));
  } else {
    add(0xf0 | code >> 18), add(0x80 | (code >> 12 & 0x3f)), add(0x80 | (code >> 6 & 0x3f)), add(0x80 | (code & 0x3f));
  }
  return bytes;
}

/// What "&...;" stands for; empty where nothing is known of it.
std::string entity(std::string_view name) {
  constexpr std::pair<std::string_view, const char*> kKnown[] = {
      {"amp", "&"}, {"lt", "<"}, {"gt", ">"}, {"quot", "\""}, {"apos", "'"}};
  for (const auto& [word, text] : kKnown) {
    if (name == word) return text;
  }
  if (!name.starts_with('#')) return {};
  const bool hexadecimal = name.size() > 1 && name[1] == 'x';
  const char* const begin = name.data() + (hexadecimal ? 2 : 1);
  const char* const end = name.data() + name.size();
  std::uint32_t code = 0;
  const auto read = std::from_chars(begin, end, code, hexadecimal ? 16 : 10);
  return read.ec == std::errc{} && read.ptr == end ? utf8(code) : std::string();
}

class Parser {
 public:
  Parser(const std::string& text, const std::string& file) : text_(text), file_(file) {}

  XmlElement document() {
    if (text_.starts_with("\xff\xfe") || text_.starts_with("\xfe\xff")) fail("", "is UTF-16; save it as UTF-8");
    if (text_.starts_with("\xef\xbb\xbf")) at_ = 3;
    if (text_.find('\0') != std::string::npos) fail("", "holds a zero byte and is no text");
    while (!root_) {
      if (!to_next_tag()) fail("", "holds no XML element");
      tag();
    }
    while (to_next_tag()) {
      if (text_[at_ + 1] != '?' && text_[at_ + 1] != '!') fail("", "has a second element beside its first");
      tag();
    }
    return std::move(*root_);
  }

 private:
  [[noreturn]] void fail(const std::string& value, const std::string& rule) const {
    const auto line =
        1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(std::min(at_, text_.size())), '\n');
    throw InputError({file_, static_cast<std::size_t>(line)}, value, rule);
  }

  bool to_next_tag() {
    const std::size_t found = text_.find('<', at_);
    if (found == std::string::npos || found + 1 >= text_.size()) {
      if (found != std::string::npos) fail("<", "is where the file ends: an element is cut off");
      if (!open_.empty()) end_of_file();
      return false;
    }
    count_lines(found);
    if (!open_.empty()) open_.back().text += resolved(std::string_view(text_).substr(at_, found - at_), false);
    at_ = found;
    return true;
  }

  [[noreturn]] void end_of_file() {
    at_ = text_.size();
    fail(open_.back().name, "is an element that does not end; the file seems to be cut off");
  }

  void count_lines(std::size_t until) {
    line_ += static_cast<std::size_t>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(counted_),
                                                 text_.begin() + static_cast<std::ptrdiff_t>(until), '\n'));
    counted_ = until;
  }

  /// Moves behind `end`, which must come.
  void pass(std::string_view begin, std::string_view end, const char* what) {
    const std::size_t found = text_.find(end, at_ + begin.size());
    if (found == std::string::npos) fail(what, "does not end");
    at_ = found + end.size();
  }

  bool here(std::string_view word) const { return text_.compare(at_, word.size(), word) == 0; }

  void tag() {
    if (here("<!--")) return pass("<!--", "-->", "a comment");
    if (here("<![CDATA[")) return character_data();
    if (here("<?")) return pass("<?", "?>", "a processing instruction");
    if (here("<!")) return doctype();
    if (here("</")) return end_tag();
    start_tag();
  }

  void character_data() {
    constexpr std::string_view kBegin = "<![CDATA[", kEnd = "]]>";
    const std::size_t begin = at_ + kBegin.size();
    pass(kBegin, kEnd, "a CDATA section");
    if (!open_.empty()) open_.back().text += text_.substr(begin, at_ - kEnd.size() - begin);
  }

  void doctype() {
    int depth = 0;
    for (; at_ < text_.size(); ++at_) {
      depth += text_[at_] == '[' ? 1 : text_[at_] == ']' ? -1 : 0;
      if (text_[at_] == '>' && depth <= 0) {
        ++at_;
        return;
      }
    }
    fail("<!", "does not end");
  }

  void spaces() {
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
  }

  std::string name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_name(text_[at_])) ++at_;
    if (begin == at_) fail(text_.substr(begin, 1), "stands where the name of an element or attribute should");
    return text_.substr(begin, at_ - begin);
  }

  void end_tag() {
    at_ += 2;
    const std::string ended = name();
    spaces();
    if (at_ >= text_.size() || text_[at_] != '>') fail(ended, "is an end tag without >");
    if (open_.empty() || open_.back().name != ended)
      fail("</" + ended + ">", open_.empty() ? "ends nothing" : "stands where </" + open_.back().name + "> should");
    ++at_;
    close();
  }

  void close() {
    XmlElement done = std::move(open_.back());
    open_.pop_back();
    if (open_.empty()) {
      root_ = std::move(done);
    } else {
      open_.back().children.push_back(std::move(done));
    }
  }

  void start_tag() {
    XmlElement element;
    element.line = line_;
    element.begin = at_++;
    element.name = name();
    while (true) {
      spaces();
      if (at_ >= text_.size()) fail(element.name, "is an element that is cut off");
      if (text_[at_] == '>' || here("/>")) break;
      element.attributes.push_back(attribute(element));
    }
    element.stands_closed = text_[at_] == '/';
    at_ += element.stands_closed ? 2 : 1;
    element.tag_end = at_;
    if (open_.size() >= kDeepestElement) fail(element.name, "is nested too deep");
    const bool closed = element.stands_closed;
    open_.push_back(std::move(element));
    if (closed) close();
  }

  XmlAttribute attribute(const XmlElement& element) {
    XmlAttribute one;
    one.name = name();
    if (element.attribute(one.name) != nullptr) fail(one.name, "is given twice in <" + element.name + ">");
    spaces();
    if (at_ >= text_.size() || text_[at_] != '=') fail(one.name, "is an attribute without a value");
    ++at_;
    spaces();
    const char quote = at_ < text_.size() ? text_[at_] : '\0';
    if (quote != '"' && quote != '\'') fail(one.name, "is an attribute whose value is not in quotes");
    one.begin = ++at_;
    one.end = text_.find(quote, at_);
    if (one.end == std::string::npos) fail(one.name, "is an attribute whose quotes do not end");
    const std::string_view raw = std::string_view(text_).substr(one.begin, one.end - one.begin);
    if (raw.find('<') != std::string_view::npos) fail(one.name, "holds <; its quotes seem not to end");
    one.value = resolved(raw, true);
    at_ = one.end + 1;
    return one;
  }

  /// With known entities resolved; others are refused where it is `strict`.
  std::string resolved(std::string_view raw, bool strict) const {
    std::string value;
    for (std::size_t i = 0; i < raw.size(); ++i) {
      if (raw[i] != '&') {
        value += raw[i];
        continue;
      }
      const std::size_t end = raw.find(';', i);
      const std::string meant = end == std::string_view::npos ? "" : entity(raw.substr(i + 1, end - i - 1));
      if (meant.empty() && strict) fail(std::string(raw), "holds & that begins no known entity; write &amp;");
      if (meant.empty()) {
        value += raw[i];
        continue;
      }
      value += meant;
      i = end;
    }
    return value;
  }

  const std::string& text_;
  const std::string& file_;
  std::size_t at_ = 0, line_ = 1, counted_ = 0;
  std::vector<XmlElement> open_;
  std::optional<XmlElement> root_;
};

}  // namespace

const XmlAttribute* XmlElement::attribute(std::string_view key) const {
  const auto found = std::ranges::find(attributes, key, &XmlAttribute::name);
  return found == attributes.end() ? nullptr : &*found;
}

const XmlElement* XmlElement::child(std::string_view key) const {
  const auto found = std::ranges::find(children, key, &XmlElement::name);
  return found == children.end() ? nullptr : &*found;
}

XmlElement parse_xml(const std::string& text, const std::string& file) {
  return Parser(text, file).document();
}

}  // namespace demecal::inline urdf

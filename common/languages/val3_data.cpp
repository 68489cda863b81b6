#include "languages/val3_data.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

namespace demecal::inline languages {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

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
    const std::size_t sign = std::min(bytes_.find_first_not_of(kBlanks, end), bytes_.size());
    if (sign >= bytes_.size() || bytes_[sign] != '=') return std::max(end, at + 1);
    const std::size_t quote = std::min(bytes_.find_first_not_of(kBlanks, sign + 1), bytes_.size());
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

std::string text_of(const ProgramText& text, const Tag& tag, const std::string& attribute) {
  const auto found = tag.attributes.find(attribute);
  if (found == tag.attributes.end()) return "";
  return std::string(text.text().substr(found->second.begin, found->second.size));
}

}  // namespace

std::vector<Val3Value> val3_values(const ProgramText& text) {
  const std::string_view bytes = text.text();
  const TagReader reader(text);
  std::vector<Val3Value> values;
  std::string name, type;
  for (std::size_t at = bytes.find('<'); at < bytes.size(); at = bytes.find('<', at)) {
    const std::size_t passed = std::max(reader.past(at, "<!--", "-->"), reader.past(at, "<![CDATA[", "]]>"));
    if (passed > at) {
      at = passed;
      continue;
    }
    const Tag tag = reader.tag(at);
    if (tag.name == "Data") {
      name = text_of(text, tag, "name");
      type = text_of(text, tag, "type");
    } else if (tag.name == "/Data") {
      type.clear();
    } else if (tag.name == "Value" && !type.empty()) {
      const std::string key = text_of(text, tag, "key");
      values.push_back({name + '[' + (key.empty() ? "0" : key) + ']', type, at, tag.attributes});
    }
    at = tag.end;
  }
  return values;
}

}  // namespace demecal::inline languages

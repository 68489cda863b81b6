#include "source.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace demecal::map {
namespace {

/// Walks over C++ text once and blanks what is not code. Line breaks stay, so that line numbers do.
class Blanker {
 public:
  Blanker(const std::string& text, bool literals) : text_(text), literals_(literals) {}

  std::string run() {
    while (at_ < text_.size()) step();
    return std::move(out_);
  }

 private:
  void step() {
    if (text_.compare(at_, 2, "//") == 0) return blank_until(text_.find('\n', at_), true);
    if (text_.compare(at_, 2, "/*") == 0) return blank_until(after(text_.find("*/", at_ + 2), 2), true);
    if (text_.compare(at_, 2, "R\"") == 0) return raw_literal();
    if (text_[at_] == '"' || (text_[at_] == '\'' && !within_number())) return literal(text_[at_]);
    out_ += text_[at_++];
  }

  /// A quote between digits or letters separates digits, as in 1'000.
  bool within_number() const { return at_ > 0 && std::isalnum(static_cast<unsigned char>(text_[at_ - 1])) != 0; }

  void literal(char quote) {
    out_ += text_[at_++];
    std::size_t end = at_;
    while (end < text_.size() && text_[end] != quote && text_[end] != '\n') end += text_[end] == '\\' ? 2 : 1;
    blank_until(end, literals_);
    if (at_ < text_.size()) out_ += text_[at_++];
  }

  void raw_literal() {
    const std::size_t open = text_.find('(', at_);
    if (open == std::string::npos) return blank_until(open, literals_);
    const std::string close = ')' + text_.substr(at_ + 2, open - at_ - 2) + '"';
    blank_until(after(text_.find(close, open), close.size()), literals_);
  }

  static std::size_t after(std::size_t found, std::size_t length) {
    return found == std::string::npos ? found : found + length;
  }

  void blank_until(std::size_t end, bool blank) {
    for (end = std::min(end, text_.size()); at_ < end; ++at_) out_ += blank && text_[at_] != '\n' ? ' ' : text_[at_];
  }

  const std::string& text_;
  bool literals_;
  std::size_t at_ = 0;
  std::string out_;
};

}  // namespace

std::string home_of(const Source& source) {
  const std::string common = "common/";
  const std::string rest = source.path.starts_with(common) ? source.path.substr(common.size()) : source.path;
  return rest.substr(0, rest.find('/'));
}

bool is_header(const Source& source) {
  return source.path.ends_with(".hpp");
}

std::string without_comments(const std::string& text) {
  return Blanker(text, false).run();
}

std::string code_of(const std::string& text) {
  return Blanker(text, true).run();
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<Include> includes_of(const Source& source) {
  static const std::regex directive(R"re(^\s*#\s*include\s*([<"])([^>"]+)[>"])re");
  std::vector<Include> includes;
  int number = 0;
  for (const std::string& line : lines_of(without_comments(source.text))) {
    ++number;
    std::smatch match;
    if (std::regex_search(line, match, directive)) includes.push_back({number, match[2].str(), match[1].str() == "\""});
  }
  return includes;
}

std::string read_file(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot read " + path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<Source> read_tree(const std::string& root, const std::vector<std::string>& folders) {
  namespace fs = std::filesystem;
  std::vector<Source> sources;
  for (const std::string& folder : folders) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(fs::path(root) / folder)) {
      const std::string extension = entry.path().extension().string();
      if (!entry.is_regular_file() || (extension != ".hpp" && extension != ".cpp")) continue;
      sources.push_back({fs::relative(entry.path(), root).generic_string(), read_file(entry.path().string())});
    }
  }
  std::ranges::sort(sources, {}, &Source::path);
  return sources;
}

}  // namespace demecal::map

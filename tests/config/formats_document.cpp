#include "formats_document.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <stdexcept>

namespace demecal {
namespace {

const std::filesystem::path kRepository = DEMECAL_SOURCE_DIR;

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

/// The cells of "| a | b |".
std::vector<std::string> cells_of_row(const std::string& line) {
  std::vector<std::string> cells;
  for (std::size_t begin = 1, end = 0; (end = line.find('|', begin)) != std::string::npos; begin = end + 1) {
    cells.push_back(trimmed(line.substr(begin, end - begin)));
  }
  return cells;
}

/// "x_{deg,rad}" as "x_deg" and "x_rad"; without braces itself.
std::vector<std::string> expanded_braces(const std::string& pattern) {
  const std::size_t open = pattern.find('{'), close = pattern.find('}', open);
  if (open == std::string::npos || close == std::string::npos) return {pattern};
  std::vector<std::string> all;
  std::istringstream choices(pattern.substr(open + 1, close - open - 1));
  for (std::string choice; std::getline(choices, choice, ',');) {
    for (std::string& key : expanded_braces(pattern.substr(0, open) + choice + pattern.substr(close + 1))) {
      all.push_back(std::move(key));
    }
  }
  return all;
}

/// Follows the lines of the page.
class PageReader {
 public:
  explicit PageReader(std::map<std::string, DocumentSection>& sections) : sections_(sections) {}

  void read(const std::string& line) {
    if (fenced_) {
      read_fenced(line);
    } else if (line.starts_with("```")) {
      fenced_ = true;
      open_fence(line);
    } else if (line.starts_with("## ")) {
      section_ = &sections_[line.substr(3)];
      section_->title = line.substr(3);
    } else if (line.starts_with("| ") && section_ != nullptr) {
      read_row(line);
    } else {
      in_table_ = false;
    }
  }

 private:
  void open_fence(const std::string& line) {
    std::istringstream words(line.substr(3));
    std::string language, name;
    words >> language >> name;
    if (!name.empty()) section_->examples.push_back({name, ""});
    kept_ = !name.empty();
  }

  void read_fenced(const std::string& line) {
    fenced_ = !line.starts_with("```");
    if (fenced_ && kept_) section_->examples.back().text += line + '\n';
  }

  void read_row(const std::string& line) {
    const std::vector<std::string> cells = cells_of_row(line);
    const bool heading = !in_table_;
    in_table_ = true;
    if (heading || cells.front().starts_with("---")) return;
    const std::vector<std::string> keys = code_spans(cells.front());
    section_->rows.push_back({cells, {keys.begin(), keys.end()}});
  }

  std::map<std::string, DocumentSection>& sections_;
  DocumentSection* section_ = nullptr;
  bool fenced_ = false, kept_ = false, in_table_ = false;
};

const std::map<std::string, DocumentSection>& formats_page() {
  static const std::map<std::string, DocumentSection> page = [] {
    std::map<std::string, DocumentSection> sections;
    PageReader reader(sections);
    std::istringstream lines(read_file(kRepository / "docs/FORMATS.md"));
    for (std::string line; std::getline(lines, line);) reader.read(line);
    return sections;
  }();
  return page;
}

/// Whether the key holds others of the paths.
bool holds_others(const std::string& path, const std::set<std::string>& paths) {
  return std::ranges::any_of(
      paths, [&](const std::string& other) { return other.starts_with(path + '.') || other.starts_with(path + "[]"); });
}

}  // namespace

std::vector<std::string> code_spans(const std::string& cell) {
  std::vector<std::string> spans;
  for (std::size_t begin = cell.find('`'); begin != std::string::npos;) {
    const std::size_t end = cell.find('`', begin + 1);
    if (end == std::string::npos) break;
    for (std::string& key : expanded_braces(cell.substr(begin + 1, end - begin - 1))) spans.push_back(std::move(key));
    begin = cell.find('`', end + 1);
  }
  return spans;
}

std::set<std::string> DocumentSection::keys() const {
  std::set<std::string> all;
  for (const DocumentRow& row : rows) {
    for (const std::string& key : row.keys)
      EXPECT_TRUE(all.insert(key).second) << title << " names " << key << " twice";
  }
  return all;
}

const DocumentSection& formats_section(const std::string& title) {
  const auto found = formats_page().find(title);
  if (found == formats_page().end()) throw std::runtime_error("docs/FORMATS.md has no section " + title);
  return found->second;
}

ExampleFolder::ExampleFolder() {
  constexpr auto kTree = std::filesystem::copy_options::recursive;
  for (const char* part : {"configs/robots", "configs/preparation"}) {
    std::filesystem::create_directories(path() / part);
    std::filesystem::copy(kRepository / part, path() / part, kTree);
  }
  for (const auto& [title, section] : formats_page()) {
    for (const DocumentExample& example : section.examples) folder_.write(example.name, example.text);
  }
}

void expect_documented(const DocumentSection& section, const std::set<std::string>& paths) {
  const std::set<std::string> keys = section.keys();
  std::vector<std::string> missing, stale;
  for (const std::string& path : paths) {
    if (!keys.contains(path) && !holds_others(path, paths)) missing.push_back(path);
  }
  for (const std::string& key : keys) {
    if (!paths.contains(key)) stale.push_back(key);
  }
  EXPECT_THAT(missing, ::testing::IsEmpty()) << "docs/FORMATS.md, " << section.title << ", lacks rows for these keys";
  EXPECT_THAT(stale, ::testing::IsEmpty())
      << "docs/FORMATS.md, " << section.title << ", has rows for keys that are none";
}

}  // namespace demecal

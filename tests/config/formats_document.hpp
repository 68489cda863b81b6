// docs/FORMATS.md as tests read it: the tables of its sections, key by key, and the files that stand there as examples.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "temporary_folder.hpp"

namespace demecal {

/// The line of a table.
struct DocumentRow {
  std::vector<std::string> cells;
  std::set<std::string> keys;  ///< of the first cell: what stands in backquotes, "x_{deg,rad}" being two keys
};

/// The file of a fenced block that names one, as in "```yaml job.yaml".
struct DocumentExample {
  std::string name;
  std::string text;
};

/// What stands between two headings of the second level.
struct DocumentSection {
  std::string title;
  std::vector<DocumentRow> rows;
  std::vector<DocumentExample> examples;

  /// All keys of its rows. A key that stands in two rows fails the test.
  std::set<std::string> keys() const;
};

/// The section of that title; throws std::runtime_error where there is none.
const DocumentSection& formats_section(const std::string& title);

/// The texts in backquotes, with braces expanded.
std::vector<std::string> code_spans(const std::string& cell);

/// A folder with every example of the page, as if it were the root of the repository: with its configs/.
class ExampleFolder {
 public:
  ExampleFolder();

  const std::filesystem::path& path() const { return folder_.path(); }
  const TemporaryFolder& folder() const { return folder_; }

 private:
  TemporaryFolder folder_;
};

/// Expects the section to name every one of these keys that holds no others, and no key that is not among them.
/// Paths are as on the page: "a.b", "a[].b".
void expect_documented(const DocumentSection& section, const std::set<std::string>& paths);

}  // namespace demecal

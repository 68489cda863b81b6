// What is added in one place is named in one place: a robot language in its own files and in the table of languages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>

#include "source.hpp"

namespace demecal::map {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

const std::set<std::string> kTables{"common/languages/languages.cpp", "common/kuka_abb_ur/kuka_abb_ur.cpp",
                                    "common/staubli_kawasaki/staubli_kawasaki.cpp"};

/// The languages that the tables list: their forward declarations.
std::vector<std::string> listed_languages(const std::string& root) {
  static const std::regex row("\nLanguage (\\w+)_language\\(\\);");
  std::vector<std::string> names;
  for (const std::string& path : kTables) {
    const std::string table = read_file(root + '/' + path);
    for (std::sregex_iterator match(table.begin(), table.end(), row), end; match != end; ++match)
      names.push_back((*match)[1].str());
  }
  return names;
}

/// Whether a file is one of the language's own, in whatever room languages of its family stand.
bool is_own_file(const std::string& language, const std::string& path) {
  return path.substr(path.rfind('/') + 1).starts_with(language);
}

/// "path:line" of every line that names the language, in code or in a string, outside its files and the table.
std::vector<std::string> named_elsewhere(const std::string& language, const std::vector<Source>& sources) {
  const std::regex name(language, std::regex::icase);
  std::vector<std::string> found;
  for (const Source& source : sources) {
    if (kTables.contains(source.path) || is_own_file(language, source.path)) continue;
    const std::vector<std::string> lines = lines_of(without_comments(source.text));
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (std::regex_search(lines[i], name)) found.push_back(source.path + ':' + std::to_string(i + 1));
    }
  }
  return found;
}

TEST(OnePlace, EveryLanguageIsNamedInItsOwnFilesAndTheTable) {
  const std::string root = DEMECAL_SOURCE_DIR;
  const std::vector<std::string> languages = listed_languages(root);
  EXPECT_THAT(languages, SizeIs(testing::Ge(9u)));
  const std::vector<Source> sources = read_tree(root, {"common", "coordinator", "worker"});
  for (const std::string& language : languages) {
    SCOPED_TRACE(language);
    EXPECT_TRUE(std::ranges::any_of(sources, [&](const Source& source) {
      return source.path.ends_with('/' + language + ".cpp") &&
             source.text.find(".name = \"" + language + '"') != std::string::npos;
    }));
    if (language == "csv") continue;  // data sets are CSV, too
    EXPECT_THAT(named_elsewhere(language, sources), IsEmpty());
  }
}

TEST(OnePlace, SeesANameInCodeAndInAStringButNotInAComment) {
  const std::vector<Source> sources{{"common/kuka_abb_ur/krl.cpp", "int krl;\n"},
                                    {"common/programs/a.cpp", "// KRL\nif (is_krl) return;\n"},
                                    {"coordinator/b.cpp", "print(\"KUKA KRL\");\n"}};
  EXPECT_THAT(named_elsewhere("krl", sources), testing::ElementsAre("common/programs/a.cpp:2", "coordinator/b.cpp:1"));
}

}  // namespace
}  // namespace demecal::map

// demecal template tells every key that docs/FORMATS.md has of robots, data sets, jobs and preparations, and no others.
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <sstream>

#include "config/job_file.hpp"
#include "data_files/data_set_file.hpp"
#include "data_files/robot_file.hpp"
#include "drafting/preparation_file.hpp"
#include "drafting/templates.hpp"
#include "errors/input_error.hpp"
#include "formats_document.hpp"

namespace demecal {
namespace {

struct TemplateOfPage {
  TemplateKind kind;
  std::string title;
  void (*read)(const std::filesystem::path&);
};

const TemplateOfPage kTemplates[] = {
    {TemplateKind::robot, "ROBOT.yaml", [](const std::filesystem::path& path) { load_robot(path); }},
    {TemplateKind::dataset, "DATASET.yaml", [](const std::filesystem::path& path) { load_data_set(path); }},
    {TemplateKind::job, "JOB.yaml", [](const std::filesystem::path& path) { load_job(path); }},
    {TemplateKind::preparation, "PREPARATION.yaml", [](const std::filesystem::path& path) {
       const YamlNode root = read_preparation(path);
       names_recordings(root) ? static_cast<void>(load_recordings(root)) : static_cast<void>(load_preparation(path));
     }}};

/// The last word of "a.b[].c"; of a name that the user chooses the map's.
std::string word_of(const std::string& key) {
  std::string rest = key;
  for (const char* chosen : {".CONTACT", ".TARGET"})
    if (rest.ends_with(chosen)) rest.erase(rest.rfind('.'));
  const std::string last = rest.substr(rest.rfind('.') + 1);
  return std::regex_replace(last, std::regex("\\[\\]"), "");
}

TEST(TemplateKeys, AreAllOfThePage) {
  for (const TemplateOfPage& page : kTemplates) {
    const std::string text = template_text(page.kind, {}, ".");
    EXPECT_EQ(text.find('@'), text.npos) << "a place is not filled in";
    for (const std::string& key : formats_section(page.title).keys())
      EXPECT_TRUE(std::regex_search(text, std::regex("(^|[^a-z_0-9])" + word_of(key) + ":")))
          << page.title << ": the template does not have " << key;
  }
}

/// The template's text, and every map that stands in it as a comment, with the marks taken off.
struct TakenApart {
  std::string plain;
  std::vector<std::string> with_lines{};  ///< the text with a commented line of a map, such as a column
  std::map<std::string, std::vector<std::string>> commented{};  ///< by their key
};

TakenApart taken_apart(const std::string& text) {
  static const std::regex within("  # ((?:- \\{|[a-z_]+: ).*)"), begin("# ([a-z_0-9]+):( .*|)"), more("#   .*");
  TakenApart apart;
  std::istringstream lines(text);
  std::string key;
  for (std::string line; std::getline(lines, line);) {
    std::smatch found;
    if (std::regex_match(line, found, begin)) {
      key = found[1];
      apart.commented[key].push_back(line.substr(2) + '\n');
    } else if (!key.empty() && std::regex_match(line, more)) {
      apart.commented[key].back() += line.substr(2) + '\n';
    } else {
      key.clear();
      apart.plain += line + '\n';
    }
  }
  std::istringstream plain(apart.plain);
  for (std::string line, before; std::getline(plain, line); before += line + '\n') {
    std::smatch found;
    if (!std::regex_match(line, found, within)) continue;
    std::string with = apart.plain;
    apart.with_lines.push_back(with.replace(before.size(), line.size(), "  " + found[1].str()));
  }
  return apart;
}

/// Without the map of that key, where it has one.
std::string without_key(const std::string& text, const std::string& key) {
  std::istringstream lines(text);
  std::string rest;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    const bool deeper = line.starts_with(' ') || line.starts_with('#');
    inside = line.starts_with(key + ':') || (inside && deeper);
    if (!inside) rest += line + '\n';
  }
  return rest;
}

/// What the reader says of the text but for what is no fault of the template: files, joints and columns are not there.
std::string fault_of_keys(const TemplateOfPage& page, const TemporaryFolder& folder, const std::string& text) {
  try {
    page.read(folder.write("commented.yaml", text));
  } catch (const InputError& error) {
    const std::string said = error.what();
    if (said.find("is no key") != said.npos || said.find("is not valid YAML") != said.npos) return said;
  }
  return "";
}

/// The files that templates name.
void write_named_files(const TemporaryFolder& folder) {
  folder.write("robot.yaml", template_text(TemplateKind::robot, {}, "."));
  folder.write("dataset.yaml", template_text(TemplateKind::dataset, {}, "."));
  std::string poses = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm,pose_id\n",
              readings = "pose,x_mm,y_mm,z_mm\n";
  for (const char* number : {"0", "1", "2", "3", "4"}) {
    poses += std::string("1,2,3,4,5,") + number + ",100,200,300,P" + number + '\n';
    readings += std::string("P") + number + ",1,2," + number + '\n';
  }
  folder.write("poses.csv", poses);
  folder.write("readings.txt", readings);
}

TEST(TemplateKeys, InCommentsAreKeys) {
  const TemporaryFolder folder;
  write_named_files(folder);
  std::size_t tried = 0;
  for (const TemplateOfPage& page : kTemplates) {
    const TakenApart apart = taken_apart(template_text(page.kind, {}, "."));
    EXPECT_EQ(fault_of_keys(page, folder, apart.plain), "") << page.title;
    for (const std::string& text : apart.with_lines) {
      EXPECT_EQ(fault_of_keys(page, folder, text), "") << text;
      ++tried;
    }
    for (const auto& [key, texts] : apart.commented) {
      for (const std::string& text : texts) {
        std::string rest = without_key(apart.plain, key);
        if (text.find("axis:") != text.npos) rest = without_key(rest, "convention") + "convention: urdf\n";
        if (key == "log")
          for (const char* other : {"instrument", "repeats", "sets"}) rest = without_key(rest, other);
        EXPECT_EQ(fault_of_keys(page, folder, rest + text), "") << page.title << ": " << text;
        ++tried;
      }
    }
  }
  EXPECT_GT(tried, 40u);
}

}  // namespace
}  // namespace demecal

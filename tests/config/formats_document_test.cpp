// docs/FORMATS.md names the keys that the readers of YAML files accept, no more and no less; its examples can be read,
// and the defaults that it gives for jobs are those that a job has.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <regex>

#include "config/cell_file.hpp"
#include "config/job_file.hpp"
#include "config/model_file.hpp"
#include "config/scenario_file.hpp"
#include "data_files/data_set_file.hpp"
#include "data_files/robot_file.hpp"
#include "drafting/preparation_file.hpp"
#include "formats_document.hpp"
#include "prediction/random_effects.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal {
namespace {

using ::testing::ContainerEq;
using ::testing::IsEmpty;

const std::string kNoKey = "key_that_no_reader_knows";

/// A file of the page, and what of its keys is told otherwise than by asking the reader.
struct DocumentedFile {
  std::string title;
  std::function<void(const std::filesystem::path&)> read;
  std::map<std::string, std::string> open_maps{};  ///< whose keys the user chooses, and what the page calls them
  std::string included{};                          ///< a map with the keys of another file
};

std::string scalar_text(const YamlNode& node) {
  const bool plain = !node.quoted && node.scalar.find_first_of(",[]{}#:\"'") == std::string::npos;
  return plain && !node.scalar.empty() ? node.scalar : '"' + node.scalar + '"';
}

/// The node as YAML on one line, with one more key in the map whose path is `spoilt`.
std::string flow_text(const YamlNode& node, const std::string& spoilt) {
  if (node.kind == YamlNode::Kind::scalar) return scalar_text(node);
  const bool is_map = node.kind == YamlNode::Kind::map;
  std::string text;
  for (const YamlNode& child : node.children) {
    text += (text.empty() ? "" : ", ") + (is_map ? child.name + ": " : "") + flow_text(child, spoilt);
  }
  if (is_map && node.key == spoilt) text += (text.empty() ? "" : ", ") + kNoKey + ": 1";
  return is_map ? '{' + text + '}' : '[' + text + ']';
}

/// A path as the page writes it: without the numbers of items, and with N for the number of a joint.
std::string page_path(const std::string& path) {
  static const std::regex item("\\[[0-9]+\\]"), joint("(^|\\.)q[0-9]+_");
  return std::regex_replace(std::regex_replace(path, item, "[]"), joint, "$1qN_");
}

bool is_effect_number(const std::string& map, const std::string& key) {
  static const std::set<std::string> general{"kind", "joint", "form", "formula", "standard_errors", "ranges"};
  return map == "effects[].standard_errors" || (map == "effects[]" && !general.contains(key));
}

/// Asks the reader of a file what it accepts, map by map, by giving it a key that it cannot know.
class AcceptedKeys {
 public:
  AcceptedKeys(const DocumentedFile& file, const ExampleFolder& folder) : file_(file), folder_(folder) {}

  void ask(const DocumentExample& example) {
    const YamlNode root = parse_yaml(example.text, example.name);
    ask(root, root, example.name);
  }

  const std::set<std::string>& accepted() const { return accepted_; }
  const std::set<std::string>& present() const { return present_; }  ///< of these, those that examples have

 private:
  std::string named(const std::string& map, const std::string& key) const {
    const auto open = file_.open_maps.find(map);
    const bool effect = is_effect_number(map, key);
    return page_path((map.empty() ? "" : map + '.') + (open != file_.open_maps.end() ? open->second
                                                       : effect                      ? "NAME"
                                                                                     : key));
  }

  /// The path with the page's word for keys that the user chose on the way.
  std::string within_open_maps(std::string path) const {
    for (const auto& [map, word] : file_.open_maps) {
      if (!path.starts_with(map + '.')) continue;
      const std::size_t begin = map.size() + 1, end = std::min(path.find('.', begin), path.size());
      path.replace(begin, end - begin, word);
    }
    return path;
  }

  void ask(const YamlNode& node, const YamlNode& root, const std::string& name) {
    if (node.kind == YamlNode::Kind::map) ask_map(node, root, name);
    if (node.key.empty() || node.key != file_.included) {
      for (const YamlNode& child : node.children) ask(child, root, name);
    }
  }

  void ask_map(const YamlNode& node, const YamlNode& root, const std::string& name) {
    if (!node.key.empty() && node.key == file_.included) return;
    const std::string map = within_open_maps(page_path(node.key));
    for (const YamlNode& child : node.children) present_.insert(named(map, child.name));
    const auto allowed = keys_allowed(flow_text(root, node.key), name);
    EXPECT_EQ(allowed.has_value(), !file_.open_maps.contains(map)) << name << ": the map '" << node.key << "'";
    if (!allowed) accepted_.insert(named(map, ""));
    for (const std::string& key : allowed.value_or(std::vector<std::string>{})) accepted_.insert(named(map, key));
  }

  /// What the reader says that the map with the unknown key may have; nothing where it does not mind the key.
  std::optional<std::vector<std::string>> keys_allowed(const std::string& text, const std::string& name) const {
    try {
      file_.read(folder_.folder().write("spoilt-" + name, text));
    } catch (const UnknownKey& fault) {
      EXPECT_EQ(fault.value(), kNoKey);
      return fault.allowed();
    } catch (const InputError&) {
      // The key was taken for one that the user chooses, and its value is not of the right kind.
    }
    return std::nullopt;
  }

  const DocumentedFile& file_;
  const ExampleFolder& folder_;
  std::set<std::string> accepted_, present_;
};

void expect_keys_of(const DocumentedFile& file) {
  const DocumentSection& section = formats_section(file.title);
  const ExampleFolder folder;
  AcceptedKeys keys(file, folder);
  for (const DocumentExample& example : section.examples) {
    EXPECT_NO_THROW(file.read(folder.path() / example.name)) << example.name;
    keys.ask(example);
  }
  expect_documented(section, keys.accepted());
  for (const DocumentRow& row : section.rows) {
    const bool shown =
        std::ranges::any_of(row.keys, [&](const std::string& key) { return keys.present().contains(key); });
    EXPECT_TRUE(shown) << "docs/FORMATS.md, " << file.title << ": no example has " << row.cells.front();
  }
}

TEST(FormatsDocument, HasTheKeysOfRobots) {
  expect_keys_of({.title = "ROBOT.yaml", .read = load_robot});
}

TEST(FormatsDocument, HasTheKeysOfDataSets) {
  expect_keys_of({.title = "DATASET.yaml",
                  .read = load_data_set,
                  .open_maps = {{"tools_mm", "TARGET"},
                                {"contacts.kinds", "CONTACT"},
                                {"contacts.radii_mm", "CONTACT"},
                                {"contacts.radii_sigma_mm", "CONTACT"},
                                {"contacts.flatness_mm", "CONTACT"},
                                {"contacts.grids[].places_mm", "CONTACT"}}});
}

TEST(FormatsDocument, HasTheKeysOfCells) {
  const ExampleFolder folder;
  const Robot robot = load_robot(folder.path() / "robot.yaml");
  const auto read = [&](const std::filesystem::path& path) { load_cell(path, robot); };
  expect_keys_of({.title = "CELL.yaml", .read = read, .open_maps = {{"tools_mm", "TARGET"}}});
}

TEST(FormatsDocument, HasTheKeysOfJobs) {
  expect_keys_of({.title = "JOB.yaml", .read = load_job});
}

TEST(FormatsDocument, HasTheKeysOfGrids) {
  const ExampleFolder jobs;
  const auto read = [&jobs](const std::filesystem::path& path) {
    grid_cells(jobs.path() / "job.yaml", load_grid(path));
  };
  expect_keys_of(
      {.title = "GRID.yaml", .read = read, .open_maps = {{"gp", "KEY"}, {"islands", "KEY"}, {"distal", "KEY"}}});
}

TEST(FormatsDocument, HasTheKeysOfScenarios) {
  expect_keys_of({.title = "SCENARIO.yaml", .read = load_scenario, .open_maps = {{"contacts.points_mm", "CONTACT"}}});
}

TEST(FormatsDocument, HasTheKeysOfPreparations) {
  const auto read = [](const std::filesystem::path& path) {
    const YamlNode preparation = read_preparation(path);
    if (names_recordings(preparation))
      load_recordings(preparation);
    else
      load_preparation(path);
  };
  expect_keys_of({.title = "PREPARATION.yaml", .read = read});
}

TEST(FormatsDocument, HasTheKeysOfFrames) {
  expect_keys_of({.title = "FRAMES.yaml", .read = load_frames, .open_maps = {{"frames", "NAME"}, {"tools", "NAME"}}});
}

TEST(FormatsDocument, HasTheKeysOfMatrices) {
  const auto read = [](const std::filesystem::path& path) {
    Algebra algebra;
    load_matrices(algebra, path);
  };
  expect_keys_of({.title = "MATRICES.yaml", .read = read, .open_maps = {{"values", "NAME"}}});
}

TEST(FormatsDocument, HasTheKeysOfModels) {
  expect_keys_of({.title = "model.yaml", .read = load_model, .included = "robot"});
}

/// A job that says nothing but where its data are, and this.
Job job_with(const std::string& key, const std::string& value) {
  const std::size_t dot = key.find('.');
  const std::string line = dot == std::string::npos
                               ? key + ": " + value
                               : key.substr(0, dot) + ": {" + key.substr(dot + 1) + ": " + value + '}';
  return read_job(parse_yaml("demecal_job: 1\ndata: data.yaml\n" + line + '\n', "job.yaml"));
}

TEST(FormatsDocument, GivesTheDefaultsOfJobs) {
  const Job plain = read_job(parse_yaml("demecal_job: 1\ndata: data.yaml\n", "job.yaml"));
  int defaults = 0;
  for (const DocumentRow& row : formats_section("JOB.yaml").rows) {
    const std::string& value = row.cells.at(2);
    if (!value.starts_with('`')) continue;
    const std::string key = *row.keys.begin();
    EXPECT_EQ(job_with(key, value.substr(1, value.size() - 2)), plain) << key << ": " << value;
    ++defaults;
  }
  EXPECT_GT(defaults, 40);
}

/// The names of coefficients of every law, for joints of both types, links without their numbers.
std::map<std::string, std::set<std::string>> names_of_coefficients() {
  static const std::regex link("moment_[0-9]_");
  RandomStream stream{1601};
  Robot turning = heavy(stream, wrist_arm());
  turning.balancers = {{1, 0.25, 0.4, 0.5}};
  Robot sliding = turning;
  for (Joint& joint : sliding.chain.joints) joint.type = JointType::prismatic;
  std::vector<Effect> effects = all_proposals(turning);
  effects.push_back({.kind = "compliance", .joint = 0, .settings = {{"with_payload", 1.0}}, .form = "moments"});
  for (const char* part : {"mx", "my", "mz", "mass"}) effects.back().settings[std::string("keep_3_") + part] = 1.0;
  effects.push_back(effects.back());
  effects.back().kind = "link_bending";
  effects.back().settings.erase("with_payload");
  std::map<std::string, std::set<std::string>> names;
  for (const Robot& robot : {turning, sliding}) {
    for (const Effect& effect : effects) {
      for (const CoefficientLabel& label : law_of(effect).coefficients(effect, robot)) {
        names[effect.kind].insert(std::regex_replace(label.name, link, "moment_L_"));
      }
    }
  }
  return names;
}

TEST(FormatsDocument, HasEveryLawOfTheCatalogue) {
  static const std::regex link("(keep|logged)_[0-9]_");
  const auto coefficients = names_of_coefficients();
  const auto set_of = [](const std::vector<std::string>& words) {
    return std::set<std::string>(words.begin(), words.end());
  };
  std::set<std::string> kinds;
  for (const DocumentRow& row : formats_section("Effects").rows) {
    const std::string kind = *row.keys.begin();
    SCOPED_TRACE(kind);
    kinds.insert(kind);
    const EffectLaw* law = find_law(kind);
    ASSERT_NE(law, nullptr);
    std::set<std::string> settings;
    for (const std::string& name : law->settings()) settings.insert(std::regex_replace(name, link, "$1_L_"));
    EXPECT_EQ(row.cells.at(1), law->subject() == Subject::joint ? "yes" : "no");
    EXPECT_THAT(code_spans(row.cells.at(2)), ContainerEq(law->forms()));
    EXPECT_THAT(set_of(code_spans(row.cells.at(3))), ContainerEq(settings));
    EXPECT_THAT(set_of(code_spans(row.cells.at(4))), ContainerEq(coefficients.at(kind)));
  }
  EXPECT_EQ(kinds.size(), catalogue().size());
  const std::set<std::string> words(effect_kinds().begin(), effect_kinds().end());
  EXPECT_THAT(words, ContainerEq(kinds));
}

}  // namespace
}  // namespace demecal

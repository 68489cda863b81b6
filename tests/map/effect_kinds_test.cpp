// A kind of effect is named where its law is written and where its simulated truth is, and nowhere else: a new one
// needs no other file of the product than these and its line of the catalogue.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>

#include "source.hpp"

namespace demecal::map {
namespace {

using ::testing::IsEmpty;
using ::testing::IsSupersetOf;

const std::string kSourceTree = DEMECAL_SOURCE_DIR;
const std::string kCatalogue = "common/effects/catalogue.cpp", kTruth = "common/simulation/truth.hpp";

/// The law's file by the kind, as laws say it.
std::map<std::string, std::string> law_files(const std::vector<Source>& tree) {
  static const std::regex says("(?:kind\\(\\) const override \\{ return|kSymbolic =) \"(\\w+)\"");
  std::map<std::string, std::string> files;
  for (const Source& source : tree) {
    if (!source.path.starts_with("common/effects/")) continue;
    for (std::sregex_iterator match(source.text.begin(), source.text.end(), says), end; match != end; ++match) {
      EXPECT_TRUE(files.try_emplace((*match)[1].str(), source.path).second) << (*match)[1] << " is written twice";
    }
  }
  return files;
}

/// Rooms where tools and jumps are what robot programs call so.
const std::set<std::string> kRoomsOfPrograms{"common/languages", "common/kuka_abb_ur", "common/staubli_kawasaki",
                                             "common/programs"};

/// Words that happen to be kinds' too, or that declare a whole kind: where they stand, and what they mean there.
bool means_something_else(const std::string& kind, const std::string& path) {
  static const std::map<std::string, std::set<std::string>> elsewhere{
      {"common/parameters/declared_model.cpp",
       {"registration", "tool", "joint_offset", "geometry"}},           // what jobs declare
      {"common/baselines/baseline.cpp", {"registration", "geometry"}},  // names of baselines
      {"common/trials/finding.cpp", {"joint_offset"}},                  // kinds of findings
      {"common/updating/change.cpp", {"registration"}}};                // a verdict
  const auto words = elsewhere.find(path);
  const std::string room = path.substr(0, path.rfind('/'));
  const bool of_a_robot_language = (kind == "tool" || kind == "jump") && kRoomsOfPrograms.contains(room);
  return of_a_robot_language || (words != elsewhere.end() && words->second.contains(kind));
}

TEST(EffectKinds, AreNamedByTheirLawAndTheirTruthAlone) {
  const std::vector<Source> tree = read_tree(kSourceTree, {"common", "coordinator", "worker"});
  const std::map<std::string, std::string> laws = law_files(tree);
  ASSERT_GE(laws.size(), 18u);
  std::vector<std::string> named_elsewhere;
  for (const Source& source : tree) {
    const std::string text = without_comments(source.text);
    for (const auto& [kind, law] : laws) {
      if (source.path == law || source.path == kCatalogue || source.path == kTruth ||
          means_something_else(kind, source.path))
        continue;
      if (text.find('"' + kind + '"') != std::string::npos) named_elsewhere.push_back(kind + " in " + source.path);
    }
  }
  EXPECT_THAT(named_elsewhere, IsEmpty()) << "say it by a trait of the law (common/effects/effect.hpp)";
}

TEST(EffectKinds, HaveALineOfTheCatalogueEach) {
  const std::vector<Source> tree = read_tree(kSourceTree, {"common"});
  const std::string catalogue = read_file(kSourceTree + '/' + kCatalogue);
  std::set<std::string> kinds, lines;
  for (const auto& [kind, law] : law_files(tree)) kinds.insert(kind);
  const std::regex line("\\{&(\\w+)_law\\(\\), ");
  for (std::sregex_iterator match(catalogue.begin(), catalogue.end(), line), end; match != end; ++match) {
    EXPECT_TRUE(lines.insert((*match)[1].str()).second) << (*match)[1] << " has two lines";
  }
  EXPECT_EQ(lines, kinds);
}

TEST(EffectKinds, OfJointsAreReadAndMadeByTheListOfTrueErrors) {
  const std::string truth = read_file(kSourceTree + '/' + kTruth);
  std::set<std::string> listed;
  const std::regex line("visit\\(\"(\\w+)\", errors\\.");
  for (std::sregex_iterator match(truth.begin(), truth.end(), line), end; match != end; ++match) {
    listed.insert((*match)[1].str());
  }
  EXPECT_THAT(listed,
              IsSupersetOf({"backlash", "compliance", "coupling", "eccentricity", "gear_harmonic", "geometry"}));
}

}  // namespace
}  // namespace demecal::map

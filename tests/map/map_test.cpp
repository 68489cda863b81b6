// The source tree is held to the map of rooms that common/CMakeLists.txt declares.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "rules.hpp"

namespace demecal::map {
namespace {

using ::testing::IsEmpty;

const std::string kRoot = DEMECAL_SOURCE_DIR;

const Map& the_map() {
  static const Map map = [] {
    Map read{parse_rooms(read_file(kRoot + "/common/CMakeLists.txt")), {}};
    for (const std::string program : {"coordinator", "worker"}) {
      read.programs[program] = parse_program(read_file(kRoot + "/" + program + "/CMakeLists.txt"), read.rooms);
    }
    return read;
  }();
  return map;
}

const std::vector<Source>& the_tree() {
  static const std::vector<Source> tree = read_tree(kRoot, {"common", "coordinator", "worker", "tests"});
  return tree;
}

Violations over_the_tree(const std::function<Violations(const Source&)>& rule) {
  Violations all;
  for (const Source& source : the_tree()) {
    const Violations found = rule(source);
    all.insert(all.end(), found.begin(), found.end());
  }
  return all;
}

TEST(SourceTree, HasAFileInEveryRoomAndProgram) {
  std::vector<std::string> homes;
  for (const auto& [room, links] : the_map().rooms) homes.push_back("common/" + room + "/");
  for (const auto& [program, links] : the_map().programs) homes.push_back(program + "/");
  EXPECT_GE(homes.size(), 10u);
  for (const std::string& home : homes) {
    EXPECT_TRUE(std::ranges::any_of(the_tree(), [&](const Source& source) { return source.path.starts_with(home); }))
        << home << " is empty";
  }
}

TEST(SourceTree, IncludesOnlyWhatTheMapAllows) {
  EXPECT_THAT(over_the_tree([](const Source& source) { return check_rooms(source, the_map()); }), IsEmpty());
}

TEST(SourceTree, IncludesOnlyLibrariesThatItLinksTo) {
  EXPECT_THAT(over_the_tree([](const Source& source) { return check_libraries(source, the_map()); }), IsEmpty());
}

TEST(SourceTree, KeepsYamlAndDdsInTheirRooms) {
  EXPECT_THAT(over_the_tree(check_owners), IsEmpty());
}

TEST(SourceTree, KeepsFilesThreadsAndClocksOutOfPureRooms) {
  EXPECT_THAT(over_the_tree(check_pure_headers), IsEmpty());
  EXPECT_THAT(over_the_tree(check_pure_calls), IsEmpty());
}

TEST(SourceTree, GivesEveryRoomItsNamespace) {
  EXPECT_THAT(over_the_tree(check_namespace), IsEmpty());
}

TEST(SourceTree, HasNoViewsThatTheFuzzersCompilerCannotCompile) {
  EXPECT_THAT(over_the_tree(check_views), IsEmpty());
}

TEST(SourceTree, HasShortFilesThatSayWhatTheyAreFor) {
  EXPECT_THAT(over_the_tree(check_shape), IsEmpty());
}

TEST(SourceTree, HasNamesThatSaySomething) {
  EXPECT_THAT(over_the_tree(check_names), IsEmpty());
}

std::vector<Source> without_tests() {
  std::vector<Source> programs = the_tree();
  std::erase_if(programs, [](const Source& source) { return source.path.starts_with("tests/"); });
  EXPECT_GE(programs.size(), 100u);
  return programs;
}

TEST(SourceTree, DefinesNoTypeTwice) {
  EXPECT_THAT(check_types_once(without_tests()), IsEmpty());
}

TEST(SourceTree, HasNoNameInTheAnonymousNamespacesOfTwoFiles) {
  EXPECT_THAT(check_anonymous_once(without_tests()), IsEmpty());
}

TEST(SourceTree, SaysNothingTwice) {
  EXPECT_THAT(check_passages_once(without_tests()), IsEmpty());
}

}  // namespace
}  // namespace demecal::map

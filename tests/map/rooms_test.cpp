// The reader of the build's map, on maps made up here.
#include "rooms.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace demecal::map {
namespace {

using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;

const char* const kRooms = R"(
# demecal_room(ghost ROOMS nothing)
function(demecal_room name)
  cmake_parse_arguments(ROOM "" "" "ROOMS" ${ARGN})
endfunction()
demecal_room(bottom LIBRARIES Eigen3::Eigen)
demecal_room(middle ROOMS bottom PRIVATE_LIBRARIES fmt::fmt)
demecal_room(top
  ROOMS middle)  # two lines
)";

Map made_up() {
  Map map{parse_rooms(kRooms), {}};
  map.programs["coordinator"] =
      parse_program("target_link_libraries(demecal_coordinator PUBLIC demecal_middle CLI11::CLI11)", map.rooms);
  return map;
}

TEST(Rooms, AreReadFromTheBuildWithoutCommentsAndDefinitions) {
  const std::map<std::string, Room> rooms = parse_rooms(kRooms);
  ASSERT_EQ(rooms.size(), 3u);
  EXPECT_THAT(rooms.at("bottom").libraries, ElementsAre("Eigen3::Eigen"));
  EXPECT_THAT(rooms.at("middle").rooms, ElementsAre("bottom"));
  EXPECT_THAT(rooms.at("middle").private_libraries, ElementsAre("fmt::fmt"));
  EXPECT_THAT(rooms.at("top").rooms, ElementsAre("middle"));
}

TEST(Rooms, CannotFormCycles) {
  EXPECT_THROW(parse_rooms("demecal_room(a ROOMS b)\ndemecal_room(b ROOMS a)\n"), std::runtime_error);
  EXPECT_THROW(parse_rooms("demecal_room(a ROOMS a)\n"), std::runtime_error);
}

TEST(Rooms, ReachWhatTheirRoomsReach) {
  const Map map = made_up();
  EXPECT_THAT(reachable_rooms(map, map.rooms.at("top")), UnorderedElementsAre("middle", "bottom"));
  EXPECT_THAT(reachable_rooms(map, map.rooms.at("bottom")), UnorderedElementsAre());
}

TEST(Rooms, PassOnPublicLibrariesAndKeepPrivateOnes) {
  const Map map = made_up();
  EXPECT_THAT(reachable_libraries(map, map.rooms.at("middle")), UnorderedElementsAre("fmt::fmt", "Eigen3::Eigen"));
  EXPECT_THAT(reachable_libraries(map, map.rooms.at("top")), UnorderedElementsAre("Eigen3::Eigen"));
}

TEST(Programs, ReachTheRoomsAndLibrariesThatTheyLinkTo) {
  const Map map = made_up();
  const Room& program = map.programs.at("coordinator");
  EXPECT_THAT(reachable_rooms(map, program), UnorderedElementsAre("middle", "bottom"));
  EXPECT_TRUE(reachable_libraries(map, program).contains("CLI11::CLI11"));
  EXPECT_FALSE(reachable_libraries(map, program).contains("fmt::fmt"));
}

}  // namespace
}  // namespace demecal::map

// The map of rooms as the build declares it: which room may include which, and which libraries it knows.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

namespace demecal::map {

/// One demecal_room(...) line.
struct Room {
  std::vector<std::string> rooms;              ///< ROOMS: what it links to directly
  std::vector<std::string> libraries;          ///< LIBRARIES: known to it and to every room above it
  std::vector<std::string> private_libraries;  ///< PRIVATE_LIBRARIES: known to it alone
};

/// The rooms, and the two programs with the rooms and libraries that they link to.
struct Map {
  std::map<std::string, Room> rooms;
  std::map<std::string, Room> programs;
};

/// Reads the demecal_room(...) calls of common/CMakeLists.txt. Throws std::runtime_error where a room links to one that
/// is not declared above it.
std::map<std::string, Room> parse_rooms(const std::string& cmake);

/// What the target_link_libraries(...) calls of a program's CMakeLists.txt name; `demecal_x` counts as the room x where
/// `rooms` has it.
Room parse_program(const std::string& cmake, const std::map<std::string, Room>& rooms);

/// Every room that `start` may include: its direct rooms and theirs.
std::set<std::string> reachable_rooms(const Map& map, const Room& start);

/// Every library that `start` may include: its own and the public ones of the rooms it reaches.
std::set<std::string> reachable_libraries(const Map& map, const Room& start);

/// True for a room that opens no file, starts no thread and reads no clock: all but yaml, config, and those through
/// which workers are reached and scheduled.
bool is_pure(const std::string& room);

}  // namespace demecal::map

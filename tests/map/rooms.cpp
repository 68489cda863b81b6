#include "rooms.hpp"

#include <regex>
#include <sstream>
#include <stdexcept>

namespace demecal::map {
namespace {

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// The arguments of every call of `command` whose first argument begins with a letter, comments left out.
std::vector<std::vector<std::string>> calls(const std::string& cmake, const std::string& command) {
  const std::string code = std::regex_replace(cmake, std::regex("#[^\n]*"), "");
  const std::regex call("(^|\n)\\s*" + command + "\\(\\s*([A-Za-z][^)]*)\\)");
  std::vector<std::vector<std::string>> found;
  for (std::sregex_iterator match(code.begin(), code.end(), call), end; match != end; ++match) {
    found.push_back(words_of((*match)[2].str()));
  }
  return found;
}

Room parse_room(const std::vector<std::string>& arguments) {
  Room room;
  std::vector<std::string>* list = nullptr;
  for (std::size_t i = 1; i < arguments.size(); ++i) {
    if (arguments[i] == "ROOMS") {
      list = &room.rooms;
    } else if (arguments[i] == "LIBRARIES") {
      list = &room.libraries;
    } else if (arguments[i] == "PRIVATE_LIBRARIES") {
      list = &room.private_libraries;
    } else if (list != nullptr) {
      list->push_back(arguments[i]);
    }
  }
  return room;
}

}  // namespace

std::map<std::string, Room> parse_rooms(const std::string& cmake) {
  std::map<std::string, Room> rooms;
  for (const std::vector<std::string>& arguments : calls(cmake, "demecal_room")) {
    const Room room = parse_room(arguments);
    for (const std::string& below : room.rooms) {
      if (!rooms.contains(below)) {
        throw std::runtime_error(arguments[0] + " links to " + below + ", which is not declared above it");
      }
    }
    rooms[arguments[0]] = room;
  }
  return rooms;
}

Room parse_program(const std::string& cmake, const std::map<std::string, Room>& rooms) {
  const std::string prefix = "demecal_";
  Room program;
  for (const std::vector<std::string>& arguments : calls(cmake, "target_link_libraries")) {
    for (std::size_t i = 1; i < arguments.size(); ++i) {
      const std::string name = arguments[i].starts_with(prefix) ? arguments[i].substr(prefix.size()) : "";
      if (rooms.contains(name)) {
        program.rooms.push_back(name);
      } else {
        program.libraries.push_back(arguments[i]);
      }
    }
  }
  return program;
}

std::set<std::string> reachable_rooms(const Map& map, const Room& start) {
  std::set<std::string> reached;
  for (const std::string& name : start.rooms) {
    if (!reached.insert(name).second) continue;
    reached.merge(reachable_rooms(map, map.rooms.at(name)));
  }
  return reached;
}

std::set<std::string> reachable_libraries(const Map& map, const Room& start) {
  std::set<std::string> libraries(start.libraries.begin(), start.libraries.end());
  libraries.insert(start.private_libraries.begin(), start.private_libraries.end());
  for (const std::string& name : reachable_rooms(map, start)) {
    const Room& room = map.rooms.at(name);
    libraries.insert(room.libraries.begin(), room.libraries.end());
  }
  return libraries;
}

bool is_pure(const std::string& room) {
  static const std::set<std::string> impure{"yaml", "data_files", "drafting",   "config",    "library", "transport",
                                            "dds",  "hosting",    "scheduling", "workflows", "http"};
  return !impure.contains(room);
}

}  // namespace demecal::map

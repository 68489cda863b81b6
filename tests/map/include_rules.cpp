#include <map>
#include <set>

#include "rules.hpp"

namespace demecal::map {
namespace {

/// The library that a header belongs to, by the beginning of its name; empty for those of the language and the project.
std::string library_of(const std::string& header) {
  static const std::map<std::string, std::string> libraries = {{"Eigen/", "Eigen3::Eigen"},
                                                               {"unsupported/Eigen/", "Eigen3::Eigen"},
                                                               {"boost/", "Boost::headers"},
                                                               {"fmt/", "fmt::fmt"},
                                                               {"nlohmann/", "nlohmann_json::nlohmann_json"},
                                                               {"yaml-cpp/", "yaml-cpp"},
                                                               {"openssl/", "OpenSSL::Crypto"},
                                                               {"libxml/", "LibXml2::LibXml2"},
                                                               {"CLI/", "CLI11::CLI11"},
                                                               {"httplib.h", "PkgConfig::HTTPLIB"},
                                                               {"fastdds/", "fastrtps"},
                                                               {"fastrtps/", "fastrtps"},
                                                               {"fastcdr/", "fastcdr"},
                                                               {"calibration.h", "demecal_idl"},
                                                               {"calibrationPubSubTypes.h", "demecal_idl"}};
  for (const auto& [beginning, library] : libraries) {
    if (header.starts_with(beginning)) return library;
  }
  return "";
}

bool is_program(const std::string& home, const Map& map) {
  return map.programs.contains(home);
}

/// The room or program of that name, or nullptr: tests may include everything.
const Room* find(const std::string& home, const Map& map) {
  if (is_program(home, map)) return &map.programs.at(home);
  return map.rooms.contains(home) ? &map.rooms.at(home) : nullptr;
}

std::string wrong_room(const std::string& home, const std::string& target, const Map& map) {
  if (target == home) return "";
  if (is_program(target, map)) return home + " may not include the program " + target;
  if (!map.rooms.contains(target)) return '\'' + target + "' is no room of the map; write \"room/file.hpp\"";
  if (reachable_rooms(map, *find(home, map)).contains(target)) return "";
  return home + " may not include " + target + ", which it does not link to";
}

/// The one room that may include the header; empty where it is free.
std::string owner_of(const std::string& header) {
  static const std::map<std::string, std::string> of_libraries = {
      {"yaml-cpp", "yaml"},     {"LibXml2::LibXml2", "certificate"}, {"fastrtps", "dds"}, {"fastcdr", "dds"},
      {"demecal_idl", "tests"}, {"PkgConfig::HTTPLIB", "http"}};
  static const std::set<std::string> slow_to_compile = {"Eigen/Cholesky",    "Eigen/Dense", "Eigen/Eigen",
                                                        "Eigen/Eigenvalues", "Eigen/QR",    "Eigen/SVD"};
  if (slow_to_compile.contains(header)) return "decompositions";
  const auto owner = of_libraries.find(library_of(header));
  return owner == of_libraries.end() ? "" : owner->second;
}

}  // namespace

Violations check_rooms(const Source& source, const Map& map) {
  const std::string home = home_of(source);
  if (source.path.starts_with("common/") && !map.rooms.contains(home)) {
    return {{source.path, 0, '\'' + home + "' is no room of the map"}};
  }
  if (find(home, map) == nullptr) return {};
  Violations found;
  for (const Include& include : includes_of(source)) {
    if (!include.quoted || !library_of(include.name).empty()) continue;
    const std::string what = wrong_room(home, include.name.substr(0, include.name.find('/')), map);
    if (!what.empty()) found.push_back({source.path, include.line, what});
  }
  return found;
}

Violations check_libraries(const Source& source, const Map& map) {
  const Room* room = find(home_of(source), map);
  if (room == nullptr) return {};
  const std::set<std::string> known = reachable_libraries(map, *room);
  Violations found;
  for (const Include& include : includes_of(source)) {
    const std::string library = library_of(include.name);
    if (!library.empty() && !known.contains(library)) {
      found.push_back({source.path, include.line, home_of(source) + " does not link to " + library});
    }
  }
  return found;
}

Violations check_owners(const Source& source) {
  const std::string home = home_of(source);
  if (home == "tests") return {};
  Violations found;
  for (const Include& include : includes_of(source)) {
    const std::string owner = owner_of(include.name);
    if (!owner.empty() && owner != home) {
      found.push_back({source.path, include.line, "only " + owner + " may include <" + include.name + ">"});
    }
  }
  return found;
}

Violations check_pure_headers(const Source& source) {
  static const std::set<std::string> forbidden = {
      "fstream", "filesystem", "iostream",  "thread",     "mutex",       "shared_mutex", "condition_variable",
      "future",  "chrono",     "semaphore", "stop_token", "latch",       "barrier",      "atomic",
      "ctime",   "time.h",     "unistd.h",  "syncstream", "stdio_ext.h", "pthread.h",    "fcntl.h",
      "csignal", "signal.h"};
  if (!source.path.starts_with("common/") || !is_pure(home_of(source))) return {};
  Violations found;
  for (const Include& include : includes_of(source)) {
    if (forbidden.contains(include.name) || include.name.starts_with("sys/")) {
      found.push_back({source.path, include.line, "a pure room may not include <" + include.name + ">"});
    }
  }
  return found;
}

}  // namespace demecal::map

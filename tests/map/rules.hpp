// The rules that hold every source file to the map of rooms. Each returns what breaks it, and nothing where all is
// well.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "rooms.hpp"
#include "source.hpp"

namespace demecal::map {

/// Where a rule is broken, and in what way.
struct Violation {
  std::string path;
  int line = 0;  ///< from 1; 0 where the file as a whole is meant
  std::string what;

  friend std::ostream& operator<<(std::ostream& stream, const Violation& violation) {
    stream << violation.path;
    if (violation.line > 0) stream << ':' << violation.line;
    return stream << ": " << violation.what;
  }
};

using Violations = std::vector<Violation>;

/// "room/file.hpp" names a room that the file's own room, or program, reaches; programs never include each other.
Violations check_rooms(const Source& source, const Map& map);

/// A third-party header belongs to a library that the room or program links to.
Violations check_libraries(const Source& source, const Map& map);

/// Whatever the build says: yaml-cpp only in yaml, Fast DDS only in dds, the types generated from the IDL only in
/// tests.
Violations check_owners(const Source& source);

/// A pure room includes no header of files, threads, clocks, streams to the terminal or the environment.
Violations check_pure_headers(const Source& source);

/// A pure room calls nothing that reads a clock, the environment or chance, opens files, or prints; nor a distribution
/// of the standard library, whose numbers differ from one library to the next.
Violations check_pure_calls(const Source& source);

/// No view of ranges: with the standard library of g++ 12, the clang of the fuzzer cannot compile any.
Violations check_views(const Source& source);

/// At most 300 lines; headers and tests begin with a // comment that says what they are for.
Violations check_shape(const Source& source);

/// What a room declares stands in the room's own namespace, which is inline: demecal::effects::Robot may be written
/// demecal::Robot.
Violations check_namespace(const Source& source);

/// No file or folder is called util, helper, manager, misc, or, below common/, common.
Violations check_names(const Source& source);

/// No class, struct, union or enumeration of the sources has the name of another, whatever their namespaces, anonymous
/// ones too: a reader who looks a name up finds one thing, and the linker never takes one of two.
Violations check_types_once(const std::vector<Source>& sources);

/// No function, constant or type that a file declares in an anonymous namespace has the name of one in another file's:
/// a name read anywhere, in a profile or a debugger too, is one thing. Overloads of one file and aliases that stand for
/// the same are one thing.
Violations check_anonymous_once(const std::vector<Source>& sources);

/// No passage of more than 12 lines of code stands twice in the sources. White space, comments, includes and lines
/// without a word do not count.
Violations check_passages_once(const std::vector<Source>& sources);

}  // namespace demecal::map

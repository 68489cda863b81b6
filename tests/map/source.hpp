// A source file as the rules read it: its place, its text, its includes and its code without words.
#pragma once

#include <string>
#include <vector>

namespace demecal::map {

/// A file of the tree.
struct Source {
  std::string path;  ///< from the root of the tree, as "common/kinematics/chain.hpp"
  std::string text;
};

/// One #include directive.
struct Include {
  int line = 0;
  std::string name;     ///< what stands between the quotes or angle brackets
  bool quoted = false;  ///< "name" rather than <name>
};

/// The room of a file below common/, else the top folder: "kinematics", "coordinator", "tests".
std::string home_of(const Source& source);

/// True for .hpp.
bool is_header(const Source& source);

/// The text with comments blanked out, line for line.
std::string without_comments(const std::string& text);

/// The text with comments and the insides of string and character literals blanked out, line for line.
std::string code_of(const std::string& text);

/// The #include directives in order, those within comments left out.
std::vector<Include> includes_of(const Source& source);

std::vector<std::string> lines_of(const std::string& text);

/// Every .hpp and .cpp file below the given top folders of `root`, ordered by path.
std::vector<Source> read_tree(const std::string& root, const std::vector<std::string>& folders);

/// Throws std::runtime_error where the file cannot be read.
std::string read_file(const std::string& path);

}  // namespace demecal::map

// What demecal wrote into a folder, kept in a list there: so files of others, and changed ones, are told from its own.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

namespace demecal {

/// The list `.demecal-files` of a folder, in the lines of sha256sum. Every change is written at once: a program that
/// dies leaves no file that the next one does not know.
class WrittenFiles {
 public:
  /// Reads the folder's list, if there is one. Throws InputError where it cannot be read.
  explicit WrittenFiles(std::string folder);

  /// Those of `names` that are in the folder and are not as demecal left them. In a folder without a list, as earlier
  /// versions left them, files go by what stands in them.
  std::vector<std::string> strangers(const std::vector<std::string>& names) const;

  /// Writes a file, whole or not at all, and notes it.
  void write(const std::string& name, const std::string& bytes);
  /// Notes that a file is being written piece by piece: until note_as_is(), whatever stands in it is demecal's.
  void begin(const std::string& name);
  /// Notes the file as it stands in the folder, or that there is none.
  void note_as_is(const std::string& name);

 private:
  std::string path_of(const std::string& name) const { return folder_ + "/" + name; }
  void take_over();
  bool is_ours(const std::string& name) const;
  void save() const;

  std::string folder_;
  std::map<std::string, std::set<std::string>> hashes_;  ///< by name: what may stand in it
};

}  // namespace demecal

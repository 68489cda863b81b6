// The folder a calibration leaves: model, report, tables of poses and, where formulas were evolved, of their evolution;
// and which files of a folder are demecal's own.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "calibration/job.hpp"
#include "data/data_set.hpp"
#include "report/report.hpp"
#include "workflows/workflows.hpp"

namespace demecal {

/// Whether a folder has files, but none that a run begins with or leaves.
bool holds_no_run(const std::string& folder);

/// The list `.demecal-files` of a folder, in the lines of sha256sum. Every change is written at once: a program that
/// dies leaves no file that the next one does not know.
class WrittenFiles {
 public:
  /// Reads the folder's list, if there is one. Throws InputError where it cannot be read.
  explicit WrittenFiles(std::string folder);

  /// Those of `names` that are in the folder and are not as demecal left them. In a folder without a list
  /// results go by what stands in them.
  std::vector<std::string> strangers(const std::vector<std::string>& names) const;

  /// Writes a file, whole or not at all, and notes it.
  void write(const std::string& name, const std::string& bytes);
  /// Notes that a file is being written piece by piece: until note_as_is(), whatever stands in it is demecal's.
  void begin(const std::string& name);
  /// Notes the file as it stands in the folder, or that there is none.
  void note_as_is(const std::string& name);
  /// Removes a file that is as demecal left it, and that nobody is writing.
  void remove(const std::string& name);

 private:
  std::string path_of(const std::string& name) const { return folder_ + "/" + name; }
  void take_over();
  bool is_ours(const std::string& name) const;
  void save() const;

  std::string folder_;
  std::map<std::string, std::set<std::string>> hashes_;  ///< by name: what may stand in it
};

/// Makes the folder where it is missing. Throws InputError where it cannot be written to, and, unless `force`,
/// ArgumentError where any of `files`, those to be written there, is there already and is not as demecal left it;
/// called before long work, so that none is lost.
void make_writable(const std::string& folder, const std::vector<std::string>& files, bool force);

/// Removes results that earlier runs left in the folder and this one, which writes `written`, does not: they are of
/// another model, or of other data. What was changed since, or is being written, stays.
void remove_earlier_results(const std::string& folder, const std::vector<std::string>& written);

/// Writes a file of the folder, whole or not at all, and notes in the folder that it is demecal's.
void write_result(const std::string& folder, const std::string& name, const std::string& bytes);

/// Writes the one file that an option names, by the rule of make_writable() for its folder; never over `input`, which
/// it is made of.
void write_named(const std::string& path, const std::string& bytes, const std::string& input, bool force);

/// Files of a folder that others write while this lives: they are demecal's whatever stands in them, and then what they
/// end as.
class FilesBeingWritten {
 public:
  FilesBeingWritten(std::string folder, std::vector<std::string> files);
  ~FilesBeingWritten();
  FilesBeingWritten(const FilesBeingWritten&) = delete;
  FilesBeingWritten& operator=(const FilesBeingWritten&) = delete;

 private:
  std::string folder_;
  std::vector<std::string> files_;
};

/// What write_results() writes for a method, and write_refusal().
std::vector<std::string> result_files(Method method);

/// Writes the model, reads it back, and writes the report of what was read, so that evaluating model.yaml gives the
/// same figures to the last digit. Each file appears whole or not at all; results of earlier runs are removed.
Report write_results(const std::string& folder, const DataSet& data, const CalibrateResult& result);

}  // namespace demecal

// The folder a calibration leaves: model.yaml, report.json, report.html and, where formulas were evolved, history.csv.
#pragma once

#include <string>
#include <vector>

#include "coordinator/calibrate.hpp"

namespace demecal {

/// Makes the folder where it is missing. Throws InputError where it cannot be written to, and, unless `force`,
/// ArgumentError where any of `files`, those to be written there, is there already and is not as demecal left it;
/// called before long work, so that none is lost.
void make_writable(const std::string& folder, const std::vector<std::string>& files, bool force);

/// Writes a file of the folder, whole or not at all, and notes in the folder that it is demecal's.
void write_result(const std::string& folder, const std::string& name, const std::string& bytes);

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
/// same figures to the last digit. Each file appears whole or not at all.
Report write_results(const std::string& folder, const DataSet& data, const CalibrateResult& result);

}  // namespace demecal

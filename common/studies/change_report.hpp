// What `check` says of a robot, as JSON and for a terminal; and the record of its checks: one line a check, of how far
// the robot strayed from its model and from what is usual.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "closed_calibration/calibrated_model.hpp"
#include "data/data_set.hpp"
#include "updating/change.hpp"

namespace demecal::inline studies {

/// One JSON object on one line.
std::string to_json(const ChangeReport& change, const DataSet& data, const std::string& model_file);

/// The answer first, then what was found and what to do, then what these poses do not see, then how sure it is. Where
/// nothing was found, what they do not see qualifies the answer, and follows it.
std::string change_text(const ChangeReport& change, const DataSet& data, const std::string& model_file);

struct CheckRecord {
  std::string date;  ///< YYYY-MM-DD
  std::string model, data;
  std::uint64_t poses = 0;
  std::string verdict;
  double strain = 0.0, strain_limit = 0.0;  ///< as of ChangeReport
  double error_mm = 0.0;                    ///< rms of the tool by the model
  std::string cause;                        ///< what was found, in words; empty: nothing
  std::string robot{};                      ///< see checked_robot(); empty in a record that does not say
  std::string model_sha256{};               ///< of the model file's bytes; likewise

  /// Whether both strayed from one model, as far as the records tell.
  bool of_model_of(const CheckRecord& other) const;
};

/// The robot that the model is of: its name and, where the model's job stated it, its serial number.
std::string checked_robot(const CalibratedModel& model);

CheckRecord check_record(const ChangeReport& change, const DataSet& data, const CalibratedModel& model,
                         const std::string& model_file, const std::string& model_sha256, const std::string& date);

/// A table that read_check_history() reads back.
std::string check_history_csv(const std::vector<CheckRecord>& records);
/// Throws InputError at the first fault; an empty text is a history without checks.
std::vector<CheckRecord> read_check_history(const std::string& text, const std::string& file);

}  // namespace demecal::inline studies

// A data set as every command takes it up: read, checked against its robot, and what was found said first.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "data/data_set.hpp"
#include "data_check/finding.hpp"
#include "errors/input_error.hpp"

namespace demecal {

struct CheckedData {
  DataSet data;  ///< without copies of rows
  DataCheck check;
};

/// The data set of a file and what the check of it found. Throws InputError
/// where the file is invalid, or a joint stands outside its limits and no finding says why.
CheckedData load_checked(const std::filesystem::path& path);

/// Whether the data contradict the robot's description, and nobody forces the command to go on: said on standard error.
bool refuses(const CheckedData& checked, bool force);

/// The option --force of a command that fits or judges data.
void add_force(CLI::App& command, bool& force);

/// Writes report.json and report.html of data that no model was fitted to, and says what was found on standard error.
void write_refusal(const std::string& folder, const std::string& job, const CheckedData& checked);

/// What `fit` returns. Where it throws InputError, since no model fits the data, what the check found in them is said
/// and reported before the error goes on.
template <typename Fit>
auto fit_or_report(const std::string& folder, const std::string& job, const CheckedData& checked, const Fit& fit) {
  try {
    return fit();
  } catch (const InputError&) {
    if (!checked.check.findings.empty()) write_refusal(folder, job, checked);
    throw;
  }
}

}  // namespace demecal

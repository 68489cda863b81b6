// Runs that begin with a model found before: calibrate and diagnose with --prior.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "calibration/job.hpp"
#include "coordinator/commands.hpp"

namespace demecal {

struct PriorRun {
  std::string prior_file, out;
  Job job;
  bool declared_stated = false;  ///< otherwise what is declared is the prior's
  bool json = false, quiet = false, force = false;
};

/// Brings the model up to date by the poses of job.data_file and writes the folder of results.
ExitCode run_with_prior(PriorRun run);

}  // namespace demecal

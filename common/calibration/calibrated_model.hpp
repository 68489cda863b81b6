// What a calibration leaves to be used: the model and where it came from.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "calibration/calibration.hpp"
#include "calibration/evolver.hpp"
#include "fitting/posterior.hpp"

namespace demecal {

struct CalibratedModel {
  std::string job;
  Robot nominal;  ///< the robot as its maker describes it
  Method method = Method::direct;
  DeclaredModel declared;
  CorrectedRobot robot;
  std::vector<ParameterEstimate> estimates;
  std::vector<JointSummary> joints;
  std::optional<Posterior> posterior{};          ///< nothing in models of old versions
  std::optional<PredictionInterval> interval{};  ///< nothing in models of old versions
  std::vector<Interval> measured{};  ///< of every joint, where it stood in the fitted poses; none in old models
  /// That formulas of several joints share; nothing where the job did not ask for any, none where none was found.
  KnownFunctions functions{};
  std::string data_name;
  std::string data_sha256;
  std::uint64_t seed = 0;
  std::string version;
};

}  // namespace demecal

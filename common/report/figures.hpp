// What page and terminal make of a report's figures: the error stage by stage, what to judge by, harmonics by joint.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "report/report.hpp"

namespace demecal {

/// A set of poses by its name, its errors and their number.
struct PoseSetOfReport {
  const char* name;
  SetErrors ErrorBySet::*errors;
  std::uint64_t Report::Poses::*poses;
};
inline constexpr std::array<PoseSetOfReport, 3> kPoseSets{
    {{"calibration", &ErrorBySet::calibration, &Report::Poses::calibration},
     {"validation", &ErrorBySet::validation, &Report::Poses::validation},
     {"accept", &ErrorBySet::accept, &Report::Poses::accept}}};

/// A stage of the calibration with its figures on every set.
struct Stage {
  std::string key;    ///< of error_mm
  std::string title;  ///< for people
  const ErrorBySet* errors = nullptr;

  const SetErrors& on(const PoseSetOfReport& set) const { return errors->*set.errors; }
};

/// Those that have figures, in the order of the calibration. The stage of the closed loop is left out where the loop
/// added nothing. They hold on to the report.
std::vector<Stage> error_stages(const Report& report);
/// Null where it is none of them.
const Stage* find_stage(const std::vector<Stage>& stages, const std::string& key);
/// The sets that any stage has a mean on.
std::vector<PoseSetOfReport> measured_sets(const std::vector<Stage>& stages);

/// The figures a calibration is judged by: those of accept poses; without these of validation poses, and so on.
struct Judgement {
  PoseSetOfReport set{};
  std::string from, to;  ///< titles of the stages
  SetErrors before;      ///< the robot with its base fitted and nothing else, or the first stage there is
  SetErrors after;       ///< the last stage
};

/// Nothing where no set has a mean before and after.
std::optional<Judgement> judgement(const std::vector<Stage>& stages);

struct Harmonic {
  double cycles = 0.0;                     ///< a turn
  double amplitude = 0.0;                  ///< SI, not negative
  std::optional<double> standard_error{};  ///< of the amplitude: the largest of its coefficients
  std::string unit;
};

/// The gear harmonics among effects by joint (from 1), each ascending by cycles: there may be dozens. Only those that
/// have a joint, a ratio and an amplitude.
std::map<std::uint64_t, std::vector<Harmonic>> harmonics_of(const std::vector<EffectEntry>& effects);

/// "9 harmonics, 11 to 31 cycles per turn, largest 0.21 mrad at 15"; of at least one.
std::string harmonics_words(const std::vector<Harmonic>& harmonics);

}  // namespace demecal

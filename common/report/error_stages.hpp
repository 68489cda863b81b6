// The tool error stage by stage, as the report's JSON has it, and what the page makes of it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "report/json_value.hpp"

namespace demecal {

struct StageFigures {
  std::optional<double> mean_mm, rms_mm, p95_mm, max_mm;
};

/// A stage of the calibration with its figures on every set, in the order of ErrorStages::kSets.
struct Stage {
  std::string key;    ///< of error_mm
  std::string title;  ///< for people
  std::array<StageFigures, 3> sets;
};

struct ErrorStages {
  static constexpr std::array<const char*, 3> kSets{"calibration", "validation", "accept"};

  std::vector<Stage> stages;             ///< in the order of the calibration; only those the JSON has figures of
  std::vector<std::size_t> shown;        ///< the sets that any stage has a mean on
  std::array<std::uint64_t, 3> poses{};  ///< in each set

  const Stage* find(const std::string& key) const;
};

/// Reads `error_mm` and `poses`. The stage of the closed loop is left out where the loop added nothing.
ErrorStages error_stages(const JsonValue& report);

/// The figures a calibration is judged by: those of accept poses; without these of validation poses, and so on.
struct Judgement {
  std::size_t set = 0;   ///< of ErrorStages::kSets
  std::string from, to;  ///< titles of the stages
  StageFigures before;   ///< the robot with its base fitted and nothing else, or the first stage there is
  StageFigures after;    ///< the last stage
};

/// Nothing where no set has a mean before and after.
std::optional<Judgement> judgement(const ErrorStages& errors);

}  // namespace demecal

// What page and terminal both make of a report: stages, what to judge by, amounts, and the sentences they share.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "report/report.hpp"

namespace demecal::inline report {

/// A set of poses by its name, its errors and their number.
struct ReportPoseSet {
  const char* name;
  SetErrors ErrorBySet::*errors;
  std::uint64_t Report::Poses::*poses;
};
inline constexpr std::array<ReportPoseSet, 3> kPoseSets{
    {{"calibration", &ErrorBySet::calibration, &Report::Poses::calibration},
     {"validation", &ErrorBySet::validation, &Report::Poses::validation},
     {"accept", &ErrorBySet::accept, &Report::Poses::accept}}};

/// A stage of the calibration with its figures on every set.
struct Stage {
  std::string key;    ///< of error_mm
  std::string title;  ///< for people
  const ErrorBySet* errors = nullptr;

  const SetErrors& on(const ReportPoseSet& set) const { return errors->*set.errors; }
};

/// Those that have figures, in the order of the calibration. The stage of the closed loop is left out where the loop
/// added nothing. They hold on to the report.
std::vector<Stage> error_stages(const Report& report);
/// Null where it is none of them.
const Stage* find_stage(const std::vector<Stage>& stages, const std::string& key);
/// The sets that any stage has a mean on.
std::vector<ReportPoseSet> measured_sets(const std::vector<Stage>& stages);

/// The figures a calibration is judged by: those of accept poses; without these of validation poses, and so on.
struct Improvement {
  ReportPoseSet set{};
  std::string from, to;  ///< titles of the stages
  SetErrors before;      ///< the robot with its base fitted and nothing else, or the first stage there is
  SetErrors after;       ///< the last stage
};

/// Nothing where no set has a mean before and after.
std::optional<Improvement> improvement(const std::vector<Stage>& stages);

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
std::string harmonics_text(const std::vector<Harmonic>& harmonics);

/// `value` of an SI unit as it stands in a coefficient's label, with three digits and a unit of fitting size:
/// (0.000412, "rad") is "0.412 mrad", (2e-7, "rad/Nm") "0.2 µrad/Nm", (1.3e-5, "1/K") "13 ppm/K". A dash where it is
/// not finite.
std::string amount(double value, const std::string& unit);

/// The same with two digits, and small angles in arc seconds: "8 arcsec".
std::string limit_amount(double value, const std::string& unit);

/// Two limits, the lower first, in the same unit.
std::array<std::string, 2> limit_amounts(double lower, double upper, const std::string& unit);

/// A p-value: "0.001", "0.24"; a dash where there is none.
std::string probability(std::optional<double> p);

/// "link geometry of joints 2 and 3 or instrument scale", "backlash or friction hysteresis of joint 2".
std::string class_text(const std::vector<ClassMember>& members);

/// "Link geometry of joint 2 or instrument scale: these poses cannot tell."; empty for an empty class.
std::string class_sentence(const std::vector<ClassMember>& members);

/// "gears of joint 2", or "gears of joint 2 or geometry of the link of joint 2 (these poses cannot tell)".
std::string cause_name(const CauseEntry& cause);
/// "gears of joint 2: 0.041 mm of the error (95 %: 0.035 to 0.047)".
std::string cost_sentence(const CauseEntry& cause);
/// The poses that causes are judged on: "validation", or "calibration" where there are none.
std::string_view judging_set(const Report& report);
/// What fewer causes would leave; empty where there are not at least two causes.
std::string front_sentence(const Report& report);

/// Why the loop stopped, from the report's word, in one sentence; empty where it did not run.
std::string stop_sentence(const std::string& stopped);

/// How measurements scatter, each by itself and together: "0.050 mm an axis, independent; joints repeat to 0.120 mrad".
std::string noise_sentence(const NoiseEntry& noise);

/// How each station's poses scatter; empty where no station states it.
std::string station_noise_sentence(const std::vector<StationEntry>& stations);

/// Whether a decoy won, or explains more than noise should; empty without decoys.
std::string decoys_sentence(const std::vector<DecoyEntry>& decoys);
/// Why effects that were added are not sure: a decoy fared as none should, other kinds were not considered, or no
/// unseen poses confirm them. Empty where there is no such reason, or no effect was added.
std::string doubt_sentence(const Report& report);

/// What the model's rms error of each set is without suspected outliers, and with them; empty where there are none.
std::string outliers_sentence(const Report& report);

/// That a correction was held back by its limit, or may exceed it all the same; empty where it was not.
std::string limit_sentence(const JointEntry& joint);

/// Which of the corrections are formulas as they evolved and which are sums of smooth terms in their place, and what
/// the evolved ones would leave; empty where nothing evolved or a report does not say where its corrections are from.
std::string origins_sentence(const Report& report);

/// What the loop's tests of the whole model say, in up to three sentences; empty where nothing is known.
std::string statistics_sentences(const Report& report);

}  // namespace demecal::inline report

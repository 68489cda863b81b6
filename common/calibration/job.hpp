// A calibration job: what the user asks for.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "data/certificate_fields.hpp"
#include "effect_sets/set_island.hpp"
#include "evolution/archipelago.hpp"
#include "explanations/explanation_search.hpp"
#include "expression/tree.hpp"
#include "fitness/parameters.hpp"
#include "fitting/stations.hpp"
#include "parameters/declared_model.hpp"

namespace demecal::inline calibration {

/// posterior: the most probable errors, given how far joints err and how far measurements scatter; exact: the joints
/// that reach the measured point with the orientation the model predicts (thesis 4.5).
enum class TargetKind { posterior, exact };

struct TargetOptions {
  TargetKind kind = TargetKind::posterior;
  double joint_error_rad = 1e-3;  ///< standard deviation of a joint's error before a pose is looked at; posterior only

  bool operator==(const TargetOptions&) const = default;
};

/// A correction to begin with, such as a user's guess or an earlier run's result.
struct SeedFormula {
  static constexpr int kEveryJoint = -1;
  int joint = kEveryJoint;  ///< from 0
  Tree formula;             ///< of theta, rad

  bool operator==(const SeedFormula&) const = default;
};

/// Whether joints are to share functions (thesis 7.1 ii): how many, and into how many stages the generations are
/// divided, between which these are found.
struct SharingOptions {
  int functions = 0;  ///< at most; 0: none, and no stages
  int stages = 4;

  bool operator==(const SharingOptions&) const = default;
};

struct CorrectionOptions {
  double largest_rad = std::numeric_limits<double>::infinity();  ///< that any correction may become in its range
  std::vector<SeedFormula> seeds;
  SharingOptions sharing{};

  bool operator==(const CorrectionOptions&) const = default;
};

/// How joint corrections are learnt; `diagnose`: no correction is evolved, the model comes from the closed loop alone,
/// in which joint corrections are sums of smooth terms; `structural`: not at all, transforms between the links are
/// searched for.
enum class Method { direct, distal, diagnose, structural };

/// "direct", "distal", "diagnose", "structural".
inline const char* to_string(Method method) {
  constexpr const char* kWords[] = {"direct", "distal", "diagnose", "structural"};
  return kWords[static_cast<std::size_t>(method)];
}

/// Whether populations are bred on islands.
constexpr bool has_islands(Method method) {
  return method == Method::direct || method == Method::distal;
}

struct IslandOptions {
  std::uint32_t per_joint = 2;
  Topology topology = Topology::ring;
  std::uint32_t migration_interval = 10;
  std::uint32_t migrants = 3;
  bool between_joints = false;
  Replacement replacement = Replacement::worst;
  double spread = 0.0;  ///< how far the parameters of a joint's islands lie apart, 0 to 1

  bool operator==(const IslandOptions&) const = default;
};

struct ClosedLoopOptions {
  int max_effects = 150;                ///< that the loop may add; 0: it does not run
  double family_error = 0.05;           ///< chance of adding anything to a model that lacks nothing
  std::vector<std::string> candidates;  ///< kinds of effects to consider, by the words of reports; empty: all
  int highest_ratio = 200;              ///< of the scan over gear harmonics
  std::vector<double> ratios;           ///< of gears, beyond the scan

  bool operator==(const ClosedLoopOptions&) const = default;
};

/// In which order joints learn from the whole model's error (thesis 4.4): all at once, round by round, each against
/// what the others left in the round before, or one at a time as in Figure 4-6.
enum class DistalForm { parallel, sequential };

/// How large a correction becomes when the model takes it: as it evolved, or as it suits those of the other joints.
enum class Amplitudes { as_evolved, fitted };

struct DistalOptions {
  DistalForm form = DistalForm::parallel;
  int rounds = 8;  ///< of the parallel form, into which the generations are divided
  /// Nothing: fitted in the parallel form, whose joints learn side by side and have to be brought together, and as
  /// evolved in the sequential, which is the thesis's.
  std::optional<Amplitudes> amplitudes{};

  bool operator==(const DistalOptions&) const = default;
};

struct Job {
  std::string name;                     ///< the job file's stem
  std::vector<std::string> data_files;  ///< paths of the data sets, resolved; several: a station each
  StationTools station_tools = StationTools::own;
  Method method = Method::direct;
  std::uint64_t seed = 1;
  DeclaredModel declared{.registration = true, .joint_corrections = true};
  GpParameters gp;
  CorrectionOptions corrections;
  TargetOptions targets;
  IslandOptions islands;
  ClosedLoopOptions closed_loop;
  ExplanationSearch explanations;  ///< at the loop's end; its most effects are those that the loop may add
  DistalOptions distal;
  CertificateFields certificate{};  ///< what certificates of the model are to state

  bool operator==(const Job&) const = default;
};

}  // namespace demecal::inline calibration

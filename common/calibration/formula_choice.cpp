#include "calibration/formula_choice.hpp"

#include <algorithm>
#include <cmath>

#include "calibration/jury.hpp"

namespace demecal {
namespace {

constexpr double kBeyondDoubt = 2.0;  ///< standard errors

}  // namespace

CorrectedRobot without_formulas(const CorrectedRobot& robot) {
  CorrectedRobot bare = robot;
  std::erase_if(bare.effects, is_symbolic);
  return bare;
}

bool asks_for_formulas(const LoopOutcome& loop, const CorrectedRobot& robot, const ClosedLoopOptions& options) {
  const bool wanted = options.candidates.empty() || std::ranges::count(options.candidates, symbolic_kind()) > 0;
  const bool at_its_end = loop.stopped == StopReason::no_gain || loop.stopped == StopReason::no_structure;
  const bool left = loop.p_structure_left <= options.family_error;
  return wanted && at_its_end && (left || std::ranges::any_of(robot.effects, is_symbolic));
}

double description_nats(const CorrectedRobot& robot, const DataSet& data, std::span<const std::size_t> poses,
                        const std::vector<Candidate>& candidates) {
  const Jury jury(data, poses, robot);
  const double squares = sum(jury.squared_errors(robot));
  double nats = 0.5 * jury.rows() * std::log(std::max(squares, 1e-300));
  for (const Effect& effect : robot.effects) {
    nats += 0.5 * static_cast<double>(effect.values.size()) * std::log(static_cast<double>(poses.size())) +
            price_nats(effect, candidates);
  }
  return nats;
}

bool describes_better(const CorrectedRobot& robot, const CorrectedRobot& present, const DataSet& data,
                      const std::vector<Candidate>& candidates) {
  const std::vector<std::size_t> fitted = poses_of(data, PoseSet::calibration);
  if (!(description_nats(robot, data, fitted, candidates) < description_nats(present, data, fitted, candidates))) {
    return false;
  }
  const std::vector<std::size_t> judging = poses_of(data, PoseSet::validation);
  const PairedDifference behind =
      paired(Jury(data, judging, robot).squared_errors(robot), Jury(data, judging, present).squared_errors(present));
  return judging.empty() || behind.mean <= kBeyondDoubt * behind.standard_error;
}

void note_unkept(const LoopOutcome& pass, const CorrectedRobot& kept, LoopOutcome& outcome) {
  const int group = outcome.rounds.empty() ? 1 : outcome.rounds.back().group + 1;
  for (Round round : pass.rounds) {
    const auto is_it = [&](const Effect& effect) { return effect.same_law_as(round.effect); };
    if (round.verdict != Verdict::added || std::ranges::any_of(kept.effects, is_it)) continue;
    round.verdict = Verdict::rejected;
    round.reason = "the model without it describes the poses better";
    round.number = static_cast<int>(outcome.rounds.size()) + 1;
    round.group = group;
    outcome.rounds.push_back(std::move(round));
  }
}

}  // namespace demecal

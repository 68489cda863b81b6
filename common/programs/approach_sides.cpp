#include "programs/approach_sides.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <utility>

#include "data/data_set.hpp"
#include "effects/arm_state.hpp"
#include "effects/effect.hpp"
#include "kinematics/units.hpp"
#include "parsed_programs/program_text.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline programs {
namespace {

bool outweighs_model(const CorrectedTarget& corrected) {
  constexpr double kWorthSaying_m = 5e-5;
  if (corrected.unknown_side_m <= kWorthSaying_m) return false;
  const double half_m = 0.5 * corrected.unknown_side_m;
  return !corrected.error95_m || half_m > *corrected.error95_m - half_m;
}

}  // namespace

bool depends_on_sides(const CommandModel& model) {
  return std::ranges::any_of(model.robot.effects, [&](const Effect& effect) {
    return law_of(effect).needs(effect, model.robot.described).approach;
  });
}

TargetVisits corrected_by_sides(
    const Program& program, const CommandModel& model, const Circumstances& circumstances,
    const std::function<CorrectedTarget(std::size_t, const std::vector<TargetVisit>&)>& correct,
    std::vector<CorrectedTarget>& corrected, std::vector<bool>& turned) {
  std::vector<AddedToJoints> added = nothing_added(program, model);
  TargetVisits visits;
  for (bool changed = true; changed;) {
    const bool first = visits.empty();
    TargetVisits followed(program.targets.size());
    for (TargetVisit& visit : followed_motions(program, model, circumstances, added))
      followed[visit.target].push_back(std::move(visit));
    changed = false;
    for (std::size_t i = 0; i < followed.size(); ++i) {
      if (!first && std::ranges::equal(followed[i], visits[i], {}, &TargetVisit::approach, &TargetVisit::approach))
        continue;
      changed = true;
      turned[i] = !first;
      corrected[i] = correct(i, followed[i]);
      if (corrected[i].is_uncorrected()) continue;
      const JointVector by = corrected[i].command - corrected[i].nominal;
      first ? static_cast<void>(added[i] = {by, by}) : added[i].take_in(by);  // what grows only comes to an end
    }
    visits = std::move(followed);
    if (!depends_on_sides(model)) return visits;
  }
  return visits;
}

double unknown_side_m(const CommandModel& model, const CorrectedTarget& corrected) {
  if (!depends_on_sides(model)) return 0.0;
  const Stop stop = corrected.stop.with_joints(corrected.command);
  std::vector<Eigen::Vector3d> apart;  // of each joint
  for (Eigen::Index joint = 0; joint < stop.approach.size(); ++joint) {
    if (stop.approach[joint] != 0.0) continue;
    Stop above = stop, below = stop;
    above.approach[joint] = 1.0;
    below.approach[joint] = -1.0;
    const Eigen::Vector3d way =
        model.robot.predict(above, "").translation() - model.robot.predict(below, "").translation();
    if (!way.isZero(0.0)) apart.push_back(way);
  }
  double most = 0.0;
  for (std::size_t signs = 0; signs < (std::size_t{1} << apart.size()); ++signs) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < apart.size(); ++i)
      sum += ((signs >> i) & 1) != 0 ? apart[i] : Eigen::Vector3d(-apart[i]);
    most = std::max(most, sum.norm());
  }
  return most;
}

void note_unknown_side(const Target& target, const CorrectedTarget& corrected, UnknownSides& sides) {
  if (!outweighs_model(corrected)) return;
  sides.targets.push_back(&target);
  sides.most_m = std::max(sides.most_m, corrected.unknown_side_m);
}

std::string unknown_side_sentence(const Program& program, const UnknownSides& sides, const std::string& why) {
  constexpr std::size_t kNamed = 5;
  std::string places;
  const std::size_t named = std::min(sides.targets.size(), kNamed);
  for (std::size_t i = 0; i < named; ++i) {
    const TextPlace& place = sides.targets[i]->place;
    places += (i == 0 ? "" : ", ") + std::to_string(place.line) +
              (program.further.empty() ? "" : " of " + program.file_name(place.file));
  }
  if (sides.targets.size() > named) places += " and " + std::to_string(sides.targets.size() - named) + " more";
  return "the side that the arm comes from to the targets of " +
         std::string(sides.targets.size() == 1 ? "line " : "lines ") + places + ' ' + why +
         ": their tool points may stand up to " + fixed_text(millimetres(sides.most_m), 3) +
         " mm apart by it, the middle is taken, and half of it is added to their predicted errors; a motion before, "
         "from where every joint comes from one side, tells it";
}

}  // namespace demecal::inline programs

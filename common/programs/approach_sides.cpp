#include "programs/approach_sides.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>

#include "data/data_set.hpp"
#include "effects/arm_state.hpp"
#include "effects/effect.hpp"
#include "kinematics/units.hpp"
#include "parsed_programs/program_text.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline programs {
namespace {

bool depends_on_sides(const CommandModel& model) {
  return std::ranges::any_of(model.robot.effects, [&](const Effect& effect) {
    return law_of(effect).needs(effect, model.robot.described).approach;
  });
}

}  // namespace

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

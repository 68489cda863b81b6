// Joint corrections as formulas that people read: a wave, a slope or an offset in the angle's own units.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline report {

struct ShortForm {
  std::string text;            ///< "0.31 mrad sin(q2 + 14 deg)"; joints count from 1
  std::size_t nodes = 0;       ///< at most 20, numbers and the joint's angle included
  JointCorrection correction;  ///< with the digits of the text
};

/// Of every joint's correction the shortest sum of waves, a slope and an offset that takes its place: with the forms of
/// all joints in theirs, with the digits that they show, the rms error of the validation poses (without any, of the
/// calibration poses) is at most 5 % above that of `robot`. Nothing for joints without correction, prismatic ones, and
/// where no such formula does.
std::vector<std::optional<ShortForm>> short_forms(const DataSet& data, const CorrectedRobot& robot);

}  // namespace demecal::inline report

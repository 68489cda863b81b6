#include "coordinator/known_arm.hpp"

#include <fmt/format.h>

#include <cmath>

#include "errors/input_error.hpp"

namespace demecal {
namespace {

bool same_link(const Joint& one, const Joint& other) {
  constexpr double kRounding = 1e-9;  // m or rad
  bool same = one.type == other.type;
  for (int parameter = 0; parameter < kLinkParameters; ++parameter) {
    const auto which = static_cast<LinkParameter>(parameter);
    same = same && std::abs(one.parameter(which) - other.parameter(which)) < kRounding;
  }
  return same;
}

}  // namespace

void require_same_arm(const CalibratedModel& model, const DataSet& data) {
  if (data.robot.chain.size() != model.robot.chain.size()) {
    throw InputError({data.file, 0}, std::to_string(data.robot.chain.size()),
                     fmt::format("is not the number of joints of the model ({})", model.robot.chain.size()));
  }
  for (const MeasuredPose& pose : data.poses) {
    if (!model.robot.tools.contains(pose.target)) {
      throw InputError({data.file, pose.line}, pose.target, "is a target that the model has no tool for");
    }
  }
}

void require_same_nominal_arm(const CalibratedModel& model, const DataSet& data) {
  require_same_arm(model, data);
  const Chain &one = model.nominal.chain, &other = data.robot.chain;
  for (std::size_t i = 0; i < one.joints.size(); ++i) {
    if (one.convention == other.convention && same_link(one.joints[i], other.joints[i])) continue;
    throw InputError({data.file, 0}, data.robot.name,
                     fmt::format("is not the arm that the model corrects: joint {} differs", i + 1));
  }
}

}  // namespace demecal

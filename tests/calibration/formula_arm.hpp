// An arm one of whose joints errs by a formula that no effect of the catalogue and no short formula of two writes.
#pragma once

#include <string>

#include "calibration/job.hpp"
#include "erring_arm.hpp"

namespace demecal {

/// Smooth errors of two joints and, of joint 3, the error that `formula` writes (q1 .. q6; empty: none). A third of the
/// poses validates; another quarter as many, at the end, are for acceptance. Noise 0.05 mm per axis.
inline DataSet formula_arm(const std::string& formula, int poses, std::uint64_t seed) {
  CorrectedRobot truth = true_puma({"0.0008*SIN(theta)", "", "0.0006*COS(theta)", "", "", ""});
  truth.described.chain = truth.chain;
  if (!formula.empty()) {
    Effect effect{.kind = "symbolic", .joint = 2, .values = {1.0}};
    effect.formula = parse(formula, symbolic_variables(truth.chain));
    truth.effects = {effect};
  }
  DataSet data = measure(true_puma({"", "", "", "", "", ""}), poses + poses / 4, 0.0, seed, false);
  RandomStream random{seed, 816};
  for (std::size_t i = 0; i < data.poses.size(); ++i) {
    MeasuredPose& pose = data.poses[i];
    for (double& joint : pose.joints) joint = random.real(-2.0, 2.0);
    const Eigen::Vector3d noise(random.normal(), random.normal(), random.normal());
    pose.position_m = truth.predict(Stop(pose), "").translation() + 5e-5 * noise;
    if (i >= static_cast<std::size_t>(poses)) pose.set = PoseSet::accept;
  }
  return data;
}

}  // namespace demecal

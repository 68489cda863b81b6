// What the rounding of written numbers does to a tool point is in its radius: of locations to 1/16 mm it is more than
// an arm's repeatability.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "corrected_arm.hpp"
#include "languages/written_program.hpp"

namespace demecal {
namespace {

/// Wrong in its links, and sure of itself.
CommandModel sure_model() {
  RandomStream stream{7661};
  const Robot nominal = elbow_arm(stream);
  CorrectedRobot identified = random_robot(stream, nominal.chain, 1e-3, 2e-3);
  identified.corrections.assign(6, {});
  CommandModel model = unbounded_model(nominal, identified);
  model.posterior = Posterior{{{.kind = ParameterId::Kind::link, .index = 1, .link = LinkParameter::theta}},
                              {},
                              Eigen::MatrixXd::Constant(1, 1, 1e-6)};
  model.interval = PredictionInterval{.quantile = 1.6};
  return model;
}

struct Rounding {
  double added_m = 0.0;   ///< to the radius
  double really_m = 0.0;  ///< by which the written place lies off
};

/// A location of VAL II, which counts 1/16 mm.
std::string counted_location(const Eigen::Isometry3d& tool) {
  std::string text = ".LOCATIONS\nmcp[1]";
  for (Eigen::Index i = 0; i < 9; ++i) text += ' ' + std::to_string(std::lround(16384.0 * tool.linear()(i % 3, i / 3)));
  for (Eigen::Index i = 0; i < 3; ++i) text += ' ' + std::to_string(std::lround(16e3 * tool.translation()[i]));
  return text + "\n.END\n";
}

Rounding rounding_of(WrittenIn language) {
  const CommandModel model = sure_model();
  JointVector joints(6);
  joints << 0.3, -0.4, 0.6, 0.2, 0.9, -0.4;
  const Eigen::Isometry3d tool = model.nominal_tool(joints);
  const std::string text =
      language == WrittenIn::val2
          ? counted_location(tool)
          : written(
                language, true, 1, [&](int index) { return pose_line(language, tool, joints, index, 6); }, "\n");
  const CorrectedProgram program = correct_program(text, read_program(language, text, "p", model.nominal.chain), model,
                                                   {.payload_kg = 0.0, .near = joints});
  const Target& target = program.program.targets.at(0);
  const CorrectedTarget& corrected = program.targets.at(0);
  EXPECT_FALSE(corrected.is_uncorrected()) << to_string(language);
  EXPECT_EQ(corrected.texts.size(),
            target.position.size() + (keeps_orientation(target) ? 0 : target.orientation.size()));
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 0; i < 3 && !corrected.texts.empty(); ++i) {
    const Cell& cell = target.position[static_cast<std::size_t>(i)];
    const std::string& number = corrected.texts[static_cast<std::size_t>(i)];
    place[i] = number.empty() ? cell.inside() : std::stod(number) * cell.unit;
  }
  return {*corrected.error95_m - *error95_m(model, corrected.stop) - corrected.left_m - corrected.residual_m,
          (target.frames.base_from_frame * place - corrected.command_tool.translation()).norm()};
}

TEST(RoundedNumbers, AreInTheRadiusWhereTheyMatter) {
  const Rounding coarse = rounding_of(WrittenIn::val2), fine = rounding_of(WrittenIn::krl);
  EXPECT_GT(coarse.really_m, 5e-6);
  EXPECT_LT(coarse.really_m, 6e-5) << "half of 1/16 mm in each direction";
  EXPECT_NEAR(coarse.added_m, coarse.really_m, 1e-9);
  EXPECT_LT(fine.really_m, 2e-6);
  EXPECT_NEAR(fine.added_m, 0.0, 1e-12);
}

}  // namespace
}  // namespace demecal

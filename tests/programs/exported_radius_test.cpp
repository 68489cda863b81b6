// The radius that is exported as code is the one that the library and programs state.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iomanip>
#include <sstream>

#include "corrected_arm.hpp"
#include "parameters/symbolic_radius.hpp"
#include "prediction/compiled_code.hpp"
#include "prediction/corrected_arm.hpp"
#include "programs/target_correction.hpp"
#include "symbolic/code.hpp"

namespace demecal {
namespace {

std::string with_commas(const Eigen::VectorXd& numbers) {
  std::ostringstream text;
  text << std::setprecision(17);
  for (Eigen::Index i = 0; i < numbers.size(); ++i) text << (i == 0 ? "" : ",") << numbers[i];
  return text.str();
}

/// An arm with every kind of effect and of number in its covariance, measured within a part of its joints' ranges.
CommandModel measured_arm(RandomStream& stream) {
  const Robot nominal = elbow_arm(stream);
  CommandModel model = erring_model(stream, nominal);
  for (Effect& effect : model.robot.effects)
    if (effect.settings.contains("reference_celsius")) effect.settings["reference_celsius"] = 22.0;
  using Kind = ParameterId::Kind;
  Posterior posterior;
  for (int joint = 0; joint < 6; ++joint)
    for (const auto link :
         {LinkParameter::theta, LinkParameter::d, LinkParameter::a, LinkParameter::alpha, LinkParameter::beta})
      posterior.ids.push_back({.kind = Kind::link, .index = joint, .link = link});
  for (int axis = 0; axis < 3; ++axis) posterior.ids.push_back({.kind = Kind::tool_translation, .index = axis});
  posterior.ids.push_back({.kind = Kind::tool_rotation, .index = 1});
  for (ParameterId& id : effect_parameters(model.robot)) posterior.ids.push_back(std::move(id));
  posterior.terms = {{1, {parse("SIN(theta)"), {true, 0.0}, {-2.0, 2.0}}},
                     {3, {parse("COS(2 * theta)"), {true, 0.5}, {-1.0, 1.0}}}};
  const auto size = static_cast<Eigen::Index>(posterior.ids.size() + posterior.terms.size());
  posterior.factor = Eigen::MatrixXd::Zero(size, size);
  for (Eigen::Index row = 0; row < size; ++row)
    for (Eigen::Index column = 0; column <= row; ++column) posterior.factor(row, column) = 1e-5 * stream.normal();
  model.posterior = posterior;
  model.interval = PredictionInterval{.quantile = 2.5, .noise_m = 1e-5, .model_error_m = 3e-5};
  for (int joint = 0; joint < 6; ++joint) model.measured.push_back({stream.real(-1.5, -0.5), stream.real(0.5, 1.5)});
  model.gaps = {{1, {{-0.3, 0.4}}}, {4, {{0.0, 0.3}}}};
  model.robot.payloads_kg = Interval{1.0, 5.0};
  model.robot.temperatures_celsius = Interval{20.0, 26.0};
  return model;
}

/// The exported file.
struct ExportedRadius {
  std::string code;
  double reference_celsius = 0.0;
};

ExportedRadius exported_radius(const CommandModel& model, CodeLanguage language) {
  Algebra algebra;
  const CorrectedArm arm = corrected_arm(algebra, model.robot, "");
  Listing listing = listing_of(arm, model.robot, "An arm");
  const RadiusListing radius = symbolic_radius(algebra, *model.interval, *model.posterior, model.robot,
                                               {model.measured, model.gaps}, arm.reference_celsius);
  listing.also = radius.expressions();
  listing.with_radius = true;
  const std::string code = radius_code(radius, listing, language);
  return {code_of(listing, language) + code, arm.reference_celsius};
}

/// At every stop and circumstance, stated; and with nothing carried and no temperature stated.
void expect_radii(const CommandModel& model, const std::vector<Stop>& stops, const std::string& printed) {
  std::istringstream in(printed);
  int outside = 0;
  for (const Stop& stop : stops) {
    double stated_m = 0.0, alone_m = 0.0;
    ASSERT_TRUE(in >> stated_m >> alone_m) << printed;
    Stop alone(stop.joints);
    EXPECT_NEAR(stated_m / *error95_m(model, stop), 1.0, 1e-9) << stop.joints.transpose();
    EXPECT_NEAR(alone_m / *error95_m(model, alone), 1.0, 1e-9) << stop.joints.transpose();
    outside += widening_at(model, stop).factor > 1.5 ? 1 : 0;
  }
  EXPECT_GT(outside, 10);
  EXPECT_LT(outside, std::ssize(stops));
}

std::vector<Stop> stops_anywhere(RandomStream& stream, const Chain& chain) {
  std::vector<Stop> stops;
  for (int i = 0; i < 60; ++i) {
    stops.push_back(random_stop(stream, chain));
    stops.back().time_s.reset();
    if (i % 2 == 0) stops.back().joints *= 0.2;
    if (i % 2 == 0) stops.back().payload_kg = 3.0, stops.back().temperature_celsius = 22.0;
  }
  return stops;
}

TEST(ExportedRadius, InCIsThatOfTheLibrary) {
  if (!there_is("cc")) GTEST_SKIP() << "there is no C compiler called cc";
  RandomStream stream{7571};
  const CommandModel model = measured_arm(stream);
  const std::vector<Stop> stops = stops_anywhere(stream, model.nominal.chain);
  const ExportedRadius exported = exported_radius(model, CodeLanguage::c);
  EXPECT_LT(exported.code.size(), 2'000'000u);
  EXPECT_EQ(exported.code.find("malloc"), std::string::npos);
  std::ostringstream code;
  code << exported.code << std::setprecision(17) << "#include <stdio.h>\nint main(void) {\n"
       << "  static const double stops[][6] = {";
  for (const Stop& stop : stops) code << '{' << with_commas(stop.joints) << "},\n";
  code << "};\n  static const struct circumstances at[] = {";
  for (const Stop& stop : stops)
    code << '{' << stop.payload_kg << ',' << *stop.temperature_celsius - exported.reference_celsius << ",{"
         << with_commas(stop.approach) << "}},\n";
  code << "};\n  for (int i = 0; i < " << stops.size()
       << "; ++i) printf(\"%.17g %.17g\\n\", radius95_at(at + i, stops[i]), radius95(stops[i]));\n  return 0;\n}\n";
  const CodeFolder folder;
  const std::string program = folder.path("radius");
  int failed = 0;
  const std::string said = output_of("cc -std=c99 -O0 -Wall -Wextra -Wno-missing-prototypes -Werror -o " + program +
                                         ' ' + folder.write("arm.c", code.str()) + " -lm",
                                     failed);
  ASSERT_EQ(failed, 0) << said;
  expect_radii(model, stops, output_of(program, failed));
}

TEST(ExportedRadius, InPythonIsThatOfTheLibrary) {
  if (!there_is("python3")) GTEST_SKIP() << "there is no python3";
  RandomStream stream{7572};
  const CommandModel model = measured_arm(stream);
  const std::vector<Stop> stops = stops_anywhere(stream, model.nominal.chain);
  const ExportedRadius exported = exported_radius(model, CodeLanguage::python);
  std::ostringstream code;
  code << exported.code << std::setprecision(17) << "\n\nfor q, payload, warming, approach in [\n";
  for (const Stop& stop : stops)
    code << "([" << with_commas(stop.joints) << "]," << stop.payload_kg << ','
         << *stop.temperature_celsius - exported.reference_celsius << ",[" << with_commas(stop.approach) << "]),\n";
  code << "]:\n    print(repr(radius95(q, payload, warming, approach)), repr(radius95(q)))\n";
  const CodeFolder folder;
  int failed = 0;
  const std::string printed = output_of("python3 -W error " + folder.write("arm.py", code.str()), failed);
  ASSERT_EQ(failed, 0) << printed;
  expect_radii(model, stops, printed);
}

TEST(ExportedRadius, InMatlabIsThatOfTheLibrary) {
  if (!there_is("octave")) GTEST_SKIP() << "there is no octave";
  RandomStream stream{7573};
  const CommandModel model = measured_arm(stream);
  const std::vector<Stop> stops = stops_anywhere(stream, model.nominal.chain);
  const ExportedRadius exported = exported_radius(model, CodeLanguage::matlab);
  const CodeFolder folder;
  folder.write("forward.m", exported.code);
  std::ostringstream code;
  code << std::setprecision(17);
  for (const Stop& stop : stops)
    code << "[~, ~, at] = forward([" << with_commas(stop.joints) << "]," << stop.payload_kg << ','
         << *stop.temperature_celsius - exported.reference_celsius << ",[" << with_commas(stop.approach)
         << "]);\n[~, ~, alone] = forward([" << with_commas(stop.joints)
         << "]);\nprintf('%.17g %.17g\\n', at, alone);\n";
  folder.write("judge.m", code.str());
  int failed = 0;
  const std::string printed = output_of("octave -qf -p " + folder.path("") + " --eval judge", failed);
  ASSERT_EQ(failed, 0) << printed;
  expect_radii(model, stops, printed);
}

}  // namespace
}  // namespace demecal

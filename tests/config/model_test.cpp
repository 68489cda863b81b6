// Model files: what is written reads back, to the last bit of an effect, and what cannot be is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>

#include "config/model_file.hpp"
#include "fitting/fit.hpp"
#include "prediction/random_effects.hpp"
#include "temporary_folder.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

/// A model with everything identified, of an arm with a prismatic joint.
CalibratedModel random_model(RandomStream& stream) {
  CalibratedModel model;
  model.job = "a job";
  model.version = "1.0";
  model.data_name = "data";
  model.data_sha256 = "0123";
  model.declared = {.registration = true, .geometry = true};
  Chain chain = wrist_arm();
  chain.joints[2].type = JointType::prismatic;
  model.nominal = heavy(stream, chain);
  model.nominal.name = "an arm";
  model.nominal.gravity_mps2 = {0.1, -0.2, -9.8};
  model.robot = random_robot(stream, chain, 1e-3, 0.0);
  model.robot.corrections.assign(6, {});
  model.robot.described = model.nominal;
  model.joints.resize(6);
  for (int joint = 0; joint < 6; ++joint) model.joints[static_cast<std::size_t>(joint)].joint = joint;
  return model;
}

CalibratedModel written_and_read(const CalibratedModel& model) {
  const TemporaryFolder folder;
  return load_model(folder.write("model.yaml", model_text(model)));
}

void expect_equal(const Effect& read, const Effect& written) {
  EXPECT_TRUE(read.same_law_as(written));
  EXPECT_EQ(read.form, written.form);
  EXPECT_EQ(read.values, written.values);
  EXPECT_EQ(read.standard_errors, written.standard_errors);
  EXPECT_EQ(read.ranges, written.ranges);
}

TEST(ModelFile, KeepsEveryEffectOfTheCatalogueToTheBit) {
  RandomStream stream{991};
  CalibratedModel model = random_model(stream);
  for (const Effect& proposal : all_proposals(model.nominal)) {
    Effect effect = of_size(proposal, model.nominal, stream, 1e-3);
    if (stream.chance(0.7)) {
      for (std::size_t i = 0; i < effect.values.size(); ++i) effect.standard_errors.push_back(stream.real(0, 1e-4));
    }
    for (const int joint : law_of(effect).ranged_joints(effect, model.nominal)) {
      effect.ranges[joint] = {stream.real(-2, 0), stream.real(0, 2)};
    }
    model.robot.effects.push_back(effect);
  }
  const CalibratedModel read = written_and_read(model);
  ASSERT_EQ(read.robot.effects.size(), model.robot.effects.size());
  for (std::size_t i = 0; i < read.robot.effects.size(); ++i) {
    SCOPED_TRACE(model.robot.effects[i].kind + ' ' + model.robot.effects[i].form);
    expect_equal(read.robot.effects[i], model.robot.effects[i]);
  }
}

TEST(ModelFile, KeepsHowTheModelWasFound) {
  RandomStream stream{992};
  CalibratedModel model = random_model(stream);
  for (const Method method : {Method::direct, Method::distal, Method::diagnose, Method::structural}) {
    model.method = method;
    EXPECT_EQ(written_and_read(model).method, method) << to_string(method);
  }
  model.data_findings = {"wrong_length", "outlier"};
  EXPECT_EQ(written_and_read(model).data_findings, model.data_findings);
}

TEST(ModelFile, PredictsTheSameAfterwards) {
  RandomStream stream{992};
  CalibratedModel model = random_model(stream);
  model.robot.effects = random_effects(model.nominal, stream, 1e-3, 2);
  const CalibratedModel read = written_and_read(model);
  for (int i = 0; i < 20; ++i) {
    const Stop stop = random_stop(stream, model.nominal.chain);
    const Eigen::Matrix4d before = model.robot.predict(stop, "B").matrix();
    EXPECT_LT((read.robot.predict(stop, "B").matrix() - before).norm(), 1e-12);
  }
}

TEST(ModelFile, KeepsTheMakersMassesAndGravityForTheEffects) {
  RandomStream stream{993};
  const CalibratedModel model = random_model(stream);
  const Robot described = written_and_read(model).robot.described;
  ASSERT_EQ(described.masses.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_DOUBLE_EQ(described.masses[i].mass_kg, model.nominal.masses[i].mass_kg);
    EXPECT_TRUE(described.masses[i].centre_m.isApprox(model.nominal.masses[i].centre_m, 1e-15));
  }
  EXPECT_EQ(described.gravity_mps2, model.nominal.gravity_mps2);
}

TEST(ModelFile, WithoutKnownCoefficientsReadsThemAsZero) {
  RandomStream stream{994};
  CalibratedModel model = random_model(stream);
  model.robot.effects = {{.kind = "eccentricity", .joint = 4, .settings = {{"order", 2.0}}}};
  EXPECT_EQ(written_and_read(model).robot.effects[0].values, (std::vector<double>{0.0, 0.0}));
}

TEST(ModelFile, HoldsSpringsAndJumpsAtAnyAngle) {
  RandomStream stream{77};
  CalibratedModel model = random_model(stream);
  for (const double at_rad : {-1.5, 0.0, 2.0}) {
    const std::map<std::string, double> spring{{"fixed_m", 0.25}, {"moving_m", 0.4}, {"shortest_rad", at_rad}};
    model.robot.effects = {{.kind = "balancer", .joint = 1, .settings = spring, .values = {1e-4, 2e-5}},
                           {.kind = "jump", .joint = 1, .settings = {{"at_rad", at_rad}}, .values = {1e-4}}};
    EXPECT_TRUE(written_and_read(model).robot.effects.at(0).same_law_as(model.robot.effects[0]));
    EXPECT_TRUE(written_and_read(model).robot.effects.at(1).same_law_as(model.robot.effects[1]));
  }
}

TEST(ModelFile, KeepsHowSureItsNumbersAreAndTheMeasuredRanges) {
  RandomStream stream{999};
  CalibratedModel model = random_model(stream);
  model.robot.effects = {{.kind = "backlash", .joint = 1, .values = {1e-4}}};
  EXPECT_FALSE(written_and_read(model).posterior);
  EXPECT_TRUE(written_and_read(model).measured.empty());
  EXPECT_FALSE(written_and_read(model).interval || written_and_read(model).robot.payloads_kg);
  Posterior posterior;
  posterior.ids = effect_parameters(model.robot);
  posterior.ids.push_back({.kind = ParameterId::Kind::link, .index = 3, .link = LinkParameter::beta});
  posterior.ids.push_back({.kind = ParameterId::Kind::tool_rotation, .index = 2, .target = "B"});
  posterior.terms = {{1, {wave(1.0, 2.0, 0.3), {}, {-0.5, 0.75}}}};
  posterior.ids.push_back({.kind = ParameterId::Kind::base_rotation, .index = 1});
  posterior.factor = Eigen::MatrixXd::Zero(5, 5);
  for (Eigen::Index row = 0; row < 5; ++row)
    for (Eigen::Index column = 0; column <= row; ++column) posterior.factor(row, column) = stream.normal() * 1e-4;
  model.posterior = posterior, model.pose_marks = {7, 0x123456789, 0xfedcba9876543210};
  model.interval = PredictionInterval{1.75, 3e-5, 2e-5, 1.25e-4, 30, 2, true, {{"", 2e-5}, {"B: door", 1e-3}}, true};
  for (int joint = 0; joint < 6; ++joint) model.measured.push_back({stream.real(-2, 0), stream.real(0, 2)});
  model.robot.temperatures_celsius = Interval{stream.real(15, 20), 25.0}, model.pose_counts[0].assign(kTurnSteps, 7);
  model.robot.payloads_kg = Interval{0.0, stream.real(1, 9)}, model.measured_gaps = {{1, {{-0.5, 0.25}, {0.5, 1.0}}}};
  const CalibratedModel read = written_and_read(model);
  ASSERT_TRUE(read.posterior && read.interval);
  EXPECT_DOUBLE_EQ(read.interval->noise_m, 3e-5);
  EXPECT_DOUBLE_EQ(read.interval->distance_noise_m, 2e-5);
  EXPECT_DOUBLE_EQ(read.interval->model_error_m, 1.25e-4);
  EXPECT_TRUE(read.interval->poses == 30U && read.interval->gross_errors == 2U && read.interval->quantile == 1.75);
  EXPECT_TRUE(read.interval->fitted && read.interval->along_path);
  EXPECT_DOUBLE_EQ(read.interval->station_noise_m.at("") + 2 * read.interval->station_noise_m.at("B: door"), 2.02e-3);
  EXPECT_EQ(read.posterior->ids, posterior.ids);
  ASSERT_EQ(read.posterior->terms.size(), 1u);
  EXPECT_EQ(read.posterior->terms[0].joint, 1);
  EXPECT_DOUBLE_EQ(read.posterior->terms[0].shape(0.6), posterior.terms[0].shape(0.6));
  EXPECT_LT((read.posterior->factor - posterior.factor).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_TRUE(read.measured == model.measured && read.measured_gaps == model.measured_gaps &&
              read.pose_counts == model.pose_counts && read.pose_marks == model.pose_marks &&
              read.robot.payloads_kg == model.robot.payloads_kg &&
              read.robot.temperatures_celsius == model.robot.temperatures_celsius);
}

/// Two joints with formulas of one structure, which is a shared function.
CalibratedModel sharing_model(RandomStream& stream) {
  CalibratedModel model = random_model(stream);
  model.functions = {parse_definition("F1(c1, c2, c3, a1) = c1 * SIN(c2 * a1 + c3)", 0),
                     parse_definition("F2(a1) = TANH(ATAN(a1))", 1)};
  for (const int joint : {0, 3}) {
    const double size = stream.real(1e-4, 1e-3), turns = stream.real(0.5, 3.0), phase = stream.real(-2.0, 2.0);
    const Tree formula = expanded(model.functions->front(), std::vector<Tree>{constant_tree(size), constant_tree(turns),
                                                                              constant_tree(phase), variable_tree(0)});
    model.robot.corrections[static_cast<std::size_t>(joint)] = {formula, {}, {-1.0, 1.0}};
    model.joints[static_cast<std::size_t>(joint)].kept = true;
  }
  return model;
}

TEST(ModelFile, KeepsSharedFunctionsAndSaysWhichJointsCallThem) {
  RandomStream stream{996};
  for (int i = 0; i < 20; ++i) {
    const CalibratedModel model = sharing_model(stream);
    const std::string text = model_text(model);
    EXPECT_THAT(text, HasSubstr("F1(c1, c2, c3, a1) = c1 * SIN(c2 * a1 + c3)\", joints: [1, 4]}"));
    EXPECT_THAT(text, HasSubstr("F2(a1) = TANH(ATAN(a1))\", joints: []}"));
    const CalibratedModel read = written_and_read(model);
    EXPECT_EQ(read.functions, model.functions);
    for (std::size_t joint = 0; joint < 6; ++joint)
      EXPECT_EQ(read.robot.corrections[joint].formula(), model.robot.corrections[joint].formula());
    const std::string again = model_text(read), from = "shared_functions:";
    EXPECT_EQ(again.substr(again.find(from)), text.substr(text.find(from)));
  }
}

TEST(ModelFile, SaysWhereNoFunctionIsSharedAndWhereNoneWasAskedFor) {
  RandomStream stream{997};
  CalibratedModel model = random_model(stream);
  EXPECT_EQ(model_text(model).find("functions"), std::string::npos);
  EXPECT_FALSE(written_and_read(model).functions);
  model.functions.emplace();
  EXPECT_THAT(model_text(model), HasSubstr("\nshared_functions: []\n"));
  EXPECT_TRUE(written_and_read(model).functions->empty());
}

TEST(ModelFile, RefusesFunctionsAndCallsThatAreNone) {
  RandomStream stream{998};
  const std::string text = model_text(sharing_model(stream));
  const auto said_of = [&](const std::string& from, const std::string& to) {
    std::string spoilt = text;
    const std::size_t at = spoilt.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    const TemporaryFolder folder;
    const auto path = folder.write("model.yaml", spoilt.replace(at, from.size(), to));
    return complaint([&] { load_model(path); });
  };
  EXPECT_THAT(said_of("TANH(ATAN(a1))", "TANH(ATAN(a1)"),
              HasSubstr("shared_functions[2].definition ' TANH(ATAN(a1)': column 15"));
  EXPECT_THAT(said_of("TANH(ATAN(a1))", "TANH(0.5 * a1)"), HasSubstr("must have no constants"));
  EXPECT_THAT(said_of("F2(a1) =", "F3(a1) ="), HasSubstr("must define F2"));
  EXPECT_THAT(said_of("with_functions: \"F1(", "with_functions: \"F3("), HasSubstr("corrections[1].with_functions"));
  EXPECT_THAT(said_of("with_functions: \"F1(", "with_functions: \"2 * F1("),
              HasSubstr("corrections[1].with_functions is not the formula that `expression` is"));
}

/// An item of `effects`, and what the user must be told of it.
struct BadEffect {
  const char* name;
  const char* item;
  const char* value;  ///< in quotes in the message; empty: none
  const char* rule;
};

std::ostream& operator<<(std::ostream& stream, const BadEffect& bad) {
  return stream << bad.name;
}

class BadEffects : public ::testing::TestWithParam<BadEffect> {};

TEST_P(BadEffects, AreRefusedWithFileLineValueAndRule) {
  RandomStream stream{995};
  std::string text = model_text(random_model(stream));
  const std::string none = "effects: []\n";
  const std::size_t at = text.find(none);
  ASSERT_NE(at, std::string::npos);
  const auto line = 2 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  text.replace(at, none.size(), std::string("effects:\n  - ") + GetParam().item + '\n');
  const TemporaryFolder folder;
  const auto path = folder.write("model.yaml", text);
  const std::string said = complaint([&] { load_model(path); }), value = GetParam().value;
  EXPECT_THAT(said, HasSubstr(path.string() + ':' + std::to_string(line) + ": "));
  EXPECT_THAT(said, HasSubstr(value.empty() ? ": " : ": '" + value + "': "));
  EXPECT_THAT(said, HasSubstr(GetParam().rule));
}

std::string name_of_effect(const ::testing::TestParamInfo<BadEffect>& info) {
  return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(
    ModelFile, BadEffects,
    ::testing::Values(
        BadEffect{"UnknownKind", "{kind: backlush, joint: 1, width_rad: 1e-4}", "backlush",
                  "effects[1].kind must be one of"},
        BadEffect{"MissingKind", "{joint: 1, width_rad: 1e-4}", "", "effects[1].kind is missing"},
        BadEffect{"JointZero", "{kind: backlash, joint: 0, width_rad: 1e-4}", "0", "must lie within 1 to 6"},
        BadEffect{"SeventhJoint", "{kind: backlash, joint: 7, width_rad: 1e-4}", "7", "must lie within 1 to 6"},
        BadEffect{"MissingJoint", "{kind: backlash, width_rad: 1e-4}", "", "effects[1].joint is missing"},
        BadEffect{"JointOfTheInstrument", "{kind: sensor_scale, joint: 1, share: 0}", "joint", "is no key"},
        BadEffect{"MissingCoefficient", "{kind: eccentricity, joint: 1, order: 1, sine_rad: 0}", "",
                  "effects[1].cosine_rad is missing"},
        BadEffect{"CoefficientOfTheWrongUnit", "{kind: backlash, joint: 3, width_rad: 1e-4}", "width_rad",
                  "the nearest is 'width_m'"},
        BadEffect{"CoefficientInWords", "{kind: backlash, joint: 1, width_rad: little}", "little",
                  "effects[1].width_rad must be a number"},
        BadEffect{"MissingSetting", "{kind: gear_harmonic, joint: 1, cosine_rad: 0, sine_rad: 0}", "",
                  "effects[1].ratio is missing"},
        BadEffect{"NegativeRatio", "{kind: gear_harmonic, joint: 1, ratio: -3, cosine_rad: 0, sine_rad: 0}", "-3",
                  "must be positive"},
        BadEffect{"CoupledToNoJoint", "{kind: coupling, joint: 1, from: 9, share: 0}", "9", "must lie within 1 to 6"},
        BadEffect{"UnknownForm", "{kind: backlash, joint: 1, form: sated, width_rad: 1e-4}", "sated",
                  "the nearest is 'seated'"},
        BadEffect{"FormOfAKindWithOne", "{kind: gain, joint: 1, form: linear, share: 0}", "linear",
                  "is not for a kind with one form only"},
        BadEffect{"BrokenFormula", "{kind: symbolic, joint: 1, formula: SIN(q9), scale_rad: 1}", "",
                  "effects[1].formula is no formula"},
        BadEffect{"NegativeError", "{kind: gain, joint: 1, share: 0, standard_errors: {share: -1}}", "-1",
                  "must not be negative"},
        BadEffect{"ErrorOfNothing", "{kind: gain, joint: 1, share: 0, standard_errors: {shire: 1}}", "shire",
                  "the nearest is 'share'"},
        BadEffect{"RangeOfTheWrongUnit", "{kind: gain, joint: 1, share: 0, ranges: {q3_rad: [0, 1]}}", "q3_rad",
                  "is no key of effects[1].ranges"},
        BadEffect{"RangeUpsideDown", "{kind: gain, joint: 1, share: 0, ranges: {q1_rad: [1, 0]}}", "[1, 0]",
                  "must rise from lower to upper"}),
    name_of_effect);

}  // namespace
}  // namespace demecal

// No law of the catalogue lacks anything that models, reports and the closed loop ask of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <sstream>

#include "effects/catalogue.hpp"
#include "laden_arm.hpp"

namespace demecal {
namespace {

using ::testing::AnyOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;

/// Every effect that is proposed for the robot with masses known and unknown, and a symbolic one.
std::vector<Effect> all_effects(const Robot& robot) {
  std::vector<Effect> effects;
  Evidence known = full_evidence(robot), unknown = known;
  unknown.masses = false;
  unknown.orientation = true;
  for (const Evidence& evidence : {known, unknown}) {
    for (const EffectLaw* law : catalogue()) {
      for (Effect& effect : law->proposals(robot, evidence)) effects.push_back(std::move(effect));
    }
  }
  for (const char* formula : {"SIN(q2 + q5)", "tau * q1", "s * 2", "T * T"}) {
    for (const char* form : {"formula", "wave"}) {
      effects.push_back({.kind = "symbolic",
                         .joint = 1,
                         .settings = {{"reference_celsius", 20}},
                         .form = form,
                         .formula = parse(formula, symbolic_variables(robot.chain))});
    }
  }
  return effects;
}

/// Checks that hold for every effect of every kind of arm.
void for_all_effects(std::uint64_t seed, const std::function<void(const Robot&, const EffectLaw&, Effect)>& check) {
  RandomStream stream{33, seed};
  for (const Arm arm : kArms) {
    const Robot robot = laden_arm(stream, arm);
    for (const Effect& effect : all_effects(robot)) {
      const EffectLaw& law = law_of(effect);
      SCOPED_TRACE(effect.kind + ' ' + std::to_string(effect.joint + 1) + ' ' + effect.form);
      check(robot, law, effect);
      if (::testing::Test::HasFailure()) return;
    }
  }
}

TEST(Catalogue, KnowsTheWordsOfTheReportsInTheirOrder) {
  std::vector<std::string_view> kinds;
  for (const EffectLaw* law : catalogue()) kinds.push_back(law->kind());
  EXPECT_THAT(kinds,
              ElementsAre("registration", "tool", "joint_offset", "geometry", "gain", "eccentricity", "gear_harmonic",
                          "compliance", "balancer", "link_bending", "coupling", "jump", "backlash", "hysteresis",
                          "axis_wobble", "thermal_offset", "thermal_length", "drift", "sensor_scale", "symbolic"));
  for (const EffectLaw* law : catalogue()) EXPECT_EQ(find_law(law->kind()), law);
  EXPECT_EQ(find_law("weather"), nullptr);
}

TEST(Catalogue, HasProposalsOfEveryKindAndFormButTheSymbolic) {
  RandomStream stream{33, 1};
  const Robot robot = laden_arm(stream, Arm::standard);
  std::set<std::pair<std::string, std::string>> proposed;
  for (const Effect& effect : all_effects(robot)) proposed.insert({effect.kind, effect.form});
  for (const EffectLaw* law : catalogue()) {
    std::vector<std::string> forms = law->forms();
    if (forms.empty()) forms = {""};
    for (const std::string& form : forms) {
      EXPECT_THAT(proposed, Contains(std::pair(std::string(law->kind()), form)));
    }
  }
  EXPECT_TRUE(find_law("symbolic")->proposals(robot, full_evidence(robot)).empty());
}

TEST(Catalogue, ProposesNothingThatTheDataCannotShow) {
  RandomStream stream{33, 2};
  for (const Arm arm : kArms) {
    const Robot robot = laden_arm(stream, arm);
    for (const EffectLaw* law : catalogue()) {
      for (const Effect& effect : law->proposals(robot, {})) {
        const Needs needs = law->needs(effect, robot);
        EXPECT_FALSE(needs.approach || needs.torque || needs.payload || needs.temperature || needs.time || needs.masses)
            << law->kind() << ' ' << effect.form;
      }
    }
  }
}

TEST(Catalogue, ProposesNoEffectTwice) {
  RandomStream stream{33, 3};
  const Robot robot = laden_arm(stream, Arm::standard);
  for (const EffectLaw* law : catalogue()) {
    const std::vector<Effect> effects = law->proposals(robot, full_evidence(robot));
    for (std::size_t i = 0; i < effects.size(); ++i) {
      EXPECT_EQ(effects[i].kind, law->kind());
      for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(effects[i].same_law_as(effects[j])) << law->kind();
    }
  }
}

TEST(Catalogue, NamesEveryCoefficientWithItsUnit) {
  const std::map<std::string, std::string> endings = {{"rad", "_rad"},
                                                      {"m", "_m"},
                                                      {"rad/Nm", "rad_per_nm"},
                                                      {"m/N", "m_per_n"},
                                                      {"rad/m^2", "_rad_per_m2"},
                                                      {"rad/K", "rad_per_kelvin"},
                                                      {"m/K", "m_per_kelvin"},
                                                      {"1/K", "share_per_kelvin"},
                                                      {"m/s", "_m_per_s"},
                                                      {"rad/s", "_rad_per_s"},
                                                      {"1", "share"},
                                                      {"rad/m", "per_m"}};
  const std::set<std::string> mixed = {"rad/m", "m/rad"};  // a share of the other kind of motion
  for_all_effects(4, [&](const Robot& robot, const EffectLaw& law, const Effect& effect) {
    const std::vector<CoefficientLabel> labels = law.coefficients(effect, robot);
    ASSERT_FALSE(labels.empty());
    std::set<std::string> names;
    for (const CoefficientLabel& label : labels) {
      EXPECT_TRUE(names.insert(label.name).second) << label.name << " twice";
      if (mixed.contains(label.unit) && label.name == "share") continue;
      ASSERT_TRUE(endings.contains(label.unit)) << label.unit;
      EXPECT_THAT(label.name, EndsWith(endings.at(label.unit)));
    }
  });
}

TEST(Catalogue, SettingsAndFormsAreThoseOfTheirLaw) {
  for_all_effects(5, [](const Robot& robot, const EffectLaw& law, const Effect& effect) {
    for (const auto& [name, value] : effect.settings) EXPECT_THAT(law.settings(), Contains(name));
    if (!effect.form.empty()) {
      EXPECT_THAT(law.forms(), Contains(effect.form));
    }
    EXPECT_EQ(law.subject() == Subject::joint, effect.joint >= 0);
    EXPECT_LT(effect.joint, robot.chain.size());
    for (const int joint : law.ranged_joints(effect, robot)) {
      EXPECT_GE(joint, 0);
      EXPECT_LT(joint, robot.chain.size());
    }
  });
}

TEST(Catalogue, DependsOnJointsOnlyWhereItSaysSo) {
  RandomStream stream{33, 6};
  const Robot robot = laden_arm(stream, Arm::standard);
  const auto ranged = [&](Effect effect) { return law_of(effect).ranged_joints(effect, robot); };
  EXPECT_THAT(ranged({.kind = "gain", .joint = 3}), ElementsAre(3));
  EXPECT_THAT(ranged({.kind = "gear_harmonic", .joint = 3}), ElementsAre(3));
  EXPECT_THAT(ranged({.kind = "eccentricity", .joint = 3}), ElementsAre(3));
  EXPECT_THAT(ranged({.kind = "axis_wobble", .joint = 3}), ElementsAre(3));
  EXPECT_THAT(ranged({.kind = "jump", .joint = 3}), ElementsAre(3));
  EXPECT_THAT(ranged({.kind = "coupling", .joint = 3, .settings = {{"from", 2}}}), ElementsAre(1));
  EXPECT_THAT(
      ranged({.kind = "symbolic", .joint = 3, .formula = parse("q6 * tau + q1 % s", symbolic_variables(robot.chain))}),
      ElementsAre(0, 5));
  for (const char* kind : {"registration", "tool", "joint_offset", "geometry", "compliance", "link_bending", "backlash",
                           "hysteresis", "thermal_offset", "thermal_length", "drift", "sensor_scale"}) {
    EXPECT_TRUE(ranged({.kind = kind, .joint = 3}).empty()) << kind;
  }
}

TEST(Catalogue, SymbolicNeedsWhatItsFormulaMentions) {
  RandomStream stream{33, 7};
  const Robot robot = laden_arm(stream, Arm::standard);
  const auto needs = [&](const char* formula) {
    const Effect effect{.kind = "symbolic", .joint = 0, .formula = parse(formula, symbolic_variables(robot.chain))};
    const Needs all = law_of(effect).needs(effect, robot);
    EXPECT_FALSE(all.payload || all.time);
    return std::array{all.approach, all.temperature, all.masses};
  };
  EXPECT_EQ(needs("q1 * q6"), (std::array{false, false, false}));
  EXPECT_EQ(needs("q1 + tau"), (std::array{false, false, true}));
  EXPECT_EQ(needs("q1 + s"), (std::array{true, false, false}));
  EXPECT_EQ(needs("q1 + T"), (std::array{false, true, false}));
}

TEST(Catalogue, EveryCoefficientMovesTheArmSomewhere) {
  RandomStream stream{33, 8};
  for_all_effects(8, [&](const Robot& robot, const EffectLaw& law, const Effect& effect) {
    const int n = robot.chain.size();
    const std::size_t count = law.coefficients(effect, robot).size();
    std::vector<double> largest(count, 0.0);
    for (int i = 0; i < 5; ++i) {
      ArmState state = arm_state(robot, random_stop(stream, robot));
      state.tool_in_sensor_m = {1.0, 2.0, 3.0};
      std::vector<UnitMotion> motions;
      law.unit_motions(effect, robot, state, motions);
      for (const UnitMotion& motion : motions) {
        ASSERT_GE(motion.coefficient, 0);
        ASSERT_LT(static_cast<std::size_t>(motion.coefficient), count);
        ASSERT_TRUE(motion.place == kSensorPlace || (motion.place >= 0 && motion.place <= n)) << motion.place;
        ASSERT_TRUE(motion.axis >= 0 && motion.axis < 6);
        ASSERT_TRUE(std::isfinite(motion.size));
        double& most = largest[static_cast<std::size_t>(motion.coefficient)];
        most = std::max(most, std::abs(motion.size));
      }
    }
    for (const double most : largest) EXPECT_GT(most, 1e-6);
  });
}

TEST(Catalogue, FormulasNameTheJointAndEveryValue) {
  for_all_effects(9, [](const Robot& robot, const EffectLaw& law, Effect effect) {
    const std::size_t count = law.coefficients(effect, robot).size();
    for (std::size_t i = 0; i < count; ++i) {
      effect.values.push_back((i % 2 == 0 ? 2e-4 : -2e-4) * static_cast<double>(i + 1));
    }
    const std::string formula = law.formula(effect, robot);
    if (law.subject() == Subject::joint) {
      EXPECT_THAT(formula, HasSubstr(std::to_string(effect.joint + 1) + " ="));
    }
    EXPECT_THAT(formula, HasSubstr(" = "));
    EXPECT_EQ(formula.find('\n'), std::string::npos);
    const double scale = effect.kind == "backlash" || effect.kind == "jump" ? 0.5 : 1.0;
    for (const double value : effect.values) {
      std::ostringstream text;
      text << scale * std::abs(value);
      EXPECT_THAT(formula, HasSubstr(text.str()));
    }
  });
}

TEST(Catalogue, DiagnosesAreSentencesWithNumbersAndUnits) {
  for_all_effects(10, [](const Robot& robot, const EffectLaw& law, Effect effect) {
    effect.values.assign(law.coefficients(effect, robot).size(), 0.00025);
    const std::string diagnosis = law.diagnosis(effect, robot);
    EXPECT_TRUE(std::isupper(static_cast<unsigned char>(diagnosis[0]))) << diagnosis;
    EXPECT_THAT(diagnosis, EndsWith("."));
    EXPECT_THAT(diagnosis,
                AnyOf(HasSubstr("mm"), HasSubstr("mrad"), HasSubstr("ppm"), HasSubstr("rad/m"), HasSubstr("m/rad")));
    if (law.subject() == Subject::joint) {
      EXPECT_THAT(diagnosis, AnyOf(HasSubstr("oint " + std::to_string(effect.joint + 1)),
                                   HasSubstr("Link " + std::to_string(effect.joint + 1))));
    }
    effect.values.clear();
    EXPECT_FALSE(law.diagnosis(effect, robot).empty());
  });
}

TEST(Catalogue, SpeaksOfBacklashAsEngineersDo) {
  RandomStream stream{33, 11};
  const Robot robot = laden_arm(stream, Arm::standard);
  const Effect effect{
      .kind = "backlash", .joint = 1, .settings = {}, .form = "approach", .formula = {}, .values = {1e-3}};
  EXPECT_EQ(law_of(effect).formula(effect, robot), "dq2 = -0.0005 rad s2");
  EXPECT_EQ(law_of(effect).diagnosis(effect, robot),
            "Joint 2 stops 0.5 mrad (103 arcsec) short on either side of where it is sent: lost motion in its gear.");
}

TEST(Catalogue, SaysWhereABalanceSpringMayBeTakenForAnEccentricGear) {
  RandomStream stream{33, 12};
  Robot robot = laden_arm(stream, Arm::standard);
  const auto names_balancers = [&](int joint) {
    const Effect effect{.kind = "eccentricity", .joint = joint, .settings = {{"order", 1.0}}, .values = {1e-3, 0.0}};
    return law_of(effect).diagnosis(effect, robot).find("(balancers)") != std::string::npos;
  };
  robot.gravity_mps2 = 9.81 * Eigen::Vector3d::UnitX();  // across the first axis
  robot.balancers.clear();
  EXPECT_TRUE(names_balancers(0));
  EXPECT_FALSE(names_balancers(4));
  robot.balancers = {{0, 0.3, 0.4, 0.0}};
  EXPECT_FALSE(names_balancers(0));
  robot.balancers.clear();
  robot.gravity_mps2 = -9.81 * Eigen::Vector3d::UnitZ();  // along it
  EXPECT_FALSE(names_balancers(0));
}

TEST(LikelyCauses, AreTheKindsOfTheCatalogueAndNoOthers) {
  for (const EffectLaw* const law : catalogue()) EXPECT_LT(rarity(law->kind()), causes().size()) << law->kind();
  EXPECT_EQ(causes().size(), catalogue().size());
  for (const Cause& cause : causes()) {
    EXPECT_NE(find_law(cause.kind), nullptr) << cause.kind;
    EXPECT_EQ(&cause_of(cause.kind), &cause) << cause.kind;
    EXPECT_FALSE(cause.words.empty()) << cause.kind;
    EXPECT_GT(cause.largest_turn_rad, 0.0) << cause.kind;
    EXPECT_GT(cause.largest_shift_m, 0.0) << cause.kind;
  }
}

TEST(LikelyCauses, BeginWithTheLinksAndEndWithTheInstrument) {
  EXPECT_EQ(rarity("geometry"), 0u);
  EXPECT_EQ(rarity("sensor_scale") + 1, causes().size());
  EXPECT_LT(rarity("backlash"), rarity("hysteresis"));
  EXPECT_EQ(rarity("no such kind"), causes().size());
}

}  // namespace
}  // namespace demecal

// An effect keeps its place and its numbers on the way through JSON, and people read sizes they can picture.
#include "report/make_report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "made_up_loop.hpp"
#include "report/figures.hpp"
#include "report/json.hpp"

namespace demecal {
namespace {

/// The effect as the only one of a report.
nlohmann::ordered_json effect_json(const EffectEntry& effect) {
  Report report;
  report.dropped = {effect};
  return nlohmann::ordered_json::parse(to_json(report))["dropped"][0];
}

EffectEntry read_back(const nlohmann::ordered_json& effect) {
  const nlohmann::ordered_json report{{"demecal_report", 1}, {"dropped", nlohmann::ordered_json::array({effect})}};
  return read_report(report.dump(), "report.json").dropped.at(0);
}

EffectEntry read_back(const EffectEntry& effect) {
  return read_back(effect_json(effect));
}

void expect_same(const std::vector<NamedNumber>& a, const std::vector<NamedNumber>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].name, b[i].name);
    EXPECT_EQ(a[i].value, b[i].value);
  }
}

void expect_same(const EffectEntry& a, const EffectEntry& b) {
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.joint, b.joint);
  EXPECT_EQ(a.form, b.form);
  EXPECT_EQ(a.amplitude, b.amplitude);
  EXPECT_EQ(a.unit, b.unit);
  expect_same(a.parameters, b.parameters);
  expect_same(a.standard_errors, b.standard_errors);
}

TEST(EffectEntry, ComesBackFromJsonTheSameForEveryKindOfTheCatalogue) {
  RandomStream random{833};
  const Robot robot = made_up_arm();
  for (const EffectLaw* const law : catalogue()) {
    Effect effect{.kind = std::string(law->kind()), .joint = law->subject() == Subject::joint ? 2 : -1, .settings = {}};
    for (const std::string& setting : law->settings()) effect.settings[setting] = 1.0;
    for (std::size_t i = law->coefficients(effect, robot).size(); i > 0; --i) {
      effect.values.push_back(random.real(-1e-3, 1e-3));
      effect.standard_errors.push_back(random.real(1e-6, 1e-5));
    }
    const EffectEntry entry = effect_entry(effect, robot);
    expect_same(read_back(entry), entry);
    EXPECT_EQ(entry.parameters.size(), effect.settings.size() + effect.values.size()) << effect.kind;
    EXPECT_EQ(entry.name().find(effect.kind), 0u);
  }
}

TEST(EffectEntry, HasNoNumbersWhereTheEffectHasNone) {
  const EffectEntry entry = effect_entry(without_values(made_up_backlash()), made_up_arm());
  EXPECT_TRUE(entry.parameters.empty());
  EXPECT_EQ(entry.size(), "");
  EXPECT_FALSE(effect_json(entry).contains("amplitude"));
  EXPECT_FALSE(effect_json(entry).contains("standard_errors"));
  expect_same(read_back(entry), entry);
}

TEST(EffectEntry, IsAsLargeAsItsWave) {
  const EffectEntry entry = effect_entry(made_up_harmonic(2, 24.0, 3e-4, -4e-4), made_up_arm());
  EXPECT_NEAR(*entry.amplitude, 5e-4, 1e-15);
  EXPECT_EQ(entry.size(), "0.5 mrad");
  EXPECT_EQ(entry.name(), "gear_harmonic (ratio 24), joint 3");
}

TEST(EffectEntry, KeepsTheSignOfASingleNumber) {
  Effect effect = made_up_backlash();
  effect.values = {-2e-4};
  EXPECT_EQ(effect_entry(effect, made_up_arm()).size(), "-0.2 mrad");
}

TEST(EffectEntry, NamesTheFormOnlyWhereItIsNotTheUsualOne) {
  Effect effect = made_up_backlash();
  EXPECT_EQ(effect_entry(effect, made_up_arm()).name(), "backlash, joint 2");
  effect.form = "seated";
  EXPECT_EQ(effect_entry(effect, made_up_arm()).name(), "backlash (seated), joint 2");
  EXPECT_EQ(effect_entry(Effect{.kind = "drift", .joint = -1, .settings = {}}, made_up_arm()).name(), "drift");
}

TEST(EffectEntry, WritesNullForNumbersThatDoNotExist) {
  Effect effect = made_up_backlash();
  effect.values = {std::nan("")};
  const auto json = effect_json(effect_entry(effect, made_up_arm()));
  EXPECT_TRUE(json["parameters"]["width_rad"].is_null());
  EXPECT_TRUE(json["amplitude"].is_null());
  effect.joint = -1;
  effect.kind = "no such kind";
  EXPECT_TRUE(effect_json(effect_entry(effect, made_up_arm()))["joint"].is_null());
}

TEST(EffectEntry, TakesJointZeroForNone) {
  EXPECT_FALSE(read_back(nlohmann::ordered_json{{"kind", "drift"}, {"joint", 0}}).joint.has_value());
  EXPECT_EQ(read_back(nlohmann::ordered_json()).name(), "");
}

TEST(Amount, HasAUnitOfFittingSize) {
  EXPECT_EQ(amount(4.12e-4, "rad"), "0.412 mrad");
  EXPECT_EQ(amount(-1.25e-6, "rad"), "-1.25 µrad");
  EXPECT_EQ(amount(2e-7, "rad/Nm"), "0.2 µrad/Nm");
  EXPECT_EQ(amount(0.012, "m"), "12 mm");
  EXPECT_EQ(amount(1.3e-5, "1/K"), "13 ppm/K");
  EXPECT_EQ(amount(0.00123, "1"), "1230 ppm");
  EXPECT_EQ(amount(0.0, "rad"), "0 mrad");
  EXPECT_EQ(amount(3.0, "Nm"), "3 Nm");
  EXPECT_EQ(amount(std::nan(""), "rad"), "–");
}

TEST(Amount, NamesLimitsOfAnglesInArcSeconds) {
  EXPECT_EQ(limit_amount(3.9e-5, "rad"), "8 arcsec");
  EXPECT_EQ(limit_amount(1.5e-4, "rad"), "31 arcsec");
  EXPECT_EQ(limit_amount(0.05, "rad"), "50 mrad");
  EXPECT_EQ(limit_amount(2.5e-7, "rad/Nm"), "0.25 µrad/Nm");
  EXPECT_EQ(limit_amount(std::nan(""), "rad"), "–");
}

TEST(Amount, KeepsTwoDigitsOfWhateverItIsGiven) {
  RandomStream random{834};
  for (int trial = 0; trial < 300; ++trial) {
    const double value = std::pow(10.0, random.real(-7.0, 0.0));
    const std::string text = amount(value, "rad");
    const double scale = text.find(" µ") != std::string::npos ? 1e-6 : 1e-3;
    EXPECT_NEAR(std::stod(text) * scale, value, 0.006 * value) << text;
  }
}

RivalEntry rival(const char* kind, std::optional<std::uint64_t> joint, double cosine) {
  RivalEntry entry;
  entry.effect.kind = kind;
  entry.effect.joint = joint;
  entry.cosine = cosine;
  return entry;
}

/// The class of an effect with these rivals.
std::vector<ClassMember> class_of(const char* kind, std::optional<std::uint64_t> joint,
                                  const std::vector<RivalEntry>& rivals) {
  return effect_class(rival(kind, joint, 1.0).effect, rivals);
}

TEST(EffectClass, HasTheMoreCommonCauseFirstWhicheverTheModelHolds) {
  const auto scale = class_of("sensor_scale", std::nullopt, {rival("geometry", 3, 0.99), rival("geometry", 2, 0.985)});
  EXPECT_EQ(class_text(scale), "link geometry of joints 2 and 3 or instrument scale");
  const auto links = class_of("geometry", 2, {rival("sensor_scale", std::nullopt, 0.99), rival("geometry", 3, 0.985)});
  EXPECT_EQ(class_text(links), class_text(scale));
  EXPECT_EQ(class_sentence(links), "Link geometry of joints 2 and 3 or instrument scale: these poses cannot tell.");
}

TEST(EffectClass, SaysAJointThatAllShareOnce) {
  const auto members = class_of("hysteresis", 2, {rival("backlash", 2, 1.0), rival("backlash", 2, 0.99)});
  EXPECT_EQ(class_text(members), "backlash or friction hysteresis of joint 2");
  EXPECT_EQ(members.size(), 2u);
}

TEST(EffectClass, IsNoneWhereNoRivalIsAsGood) {
  EXPECT_TRUE(class_of("backlash", 2, {}).empty());
  EXPECT_TRUE(class_of("backlash", 2, {rival("hysteresis", 2, 0.97)}).empty());
  EXPECT_EQ(class_sentence({}), "");
}

TEST(EffectClass, HoldsWhatTheCatalogueHasBesideAFormulaThatDoesNearlyTheSame) {
  EXPECT_EQ(class_of("symbolic", 3, {rival("thermal_offset", 3, 0.95), rival("symbolic", 3, 0.95)}).size(), 2u);
  EXPECT_TRUE(class_of("symbolic", 3, {rival("thermal_offset", 3, 0.89)}).empty());
  EXPECT_TRUE(class_of("thermal_offset", 3, {rival("symbolic", 3, 0.95)}).empty()) << "that is known";
}

/// The only cause of an arm with one effect, by poses that show the kinds but `unseen`; `rounds` added it.
CauseEntry cause_of_one(Effect effect, const std::vector<std::string>& unseen,
                        const std::vector<RoundEntry>& rounds = {}) {
  Robot described;
  described.chain.joints.resize(6);
  CorrectedRobot robot;
  robot.chain = described.chain;
  robot.effects = {std::move(effect)};
  ErrorBudget budget;
  budget.causes = {{.cause = causes_of(robot).front()}};
  Report report;
  report.rounds = rounds;
  for (const std::string& kind : unseen) report.untestable.push_back({kind, "not recorded"});
  set_causes(budget, robot, described, report);
  return report.causes.at(0);
}

TEST(CauseEntry, MayBeLostMotionWhereSidesAreNotRecorded) {
  const Effect gain{.kind = "gain", .joint = 1, .values = {-1e-4}};
  const CauseEntry unsure = cause_of_one(gain, {"backlash", "drift"});
  EXPECT_EQ(unsure.alternatives, std::vector<std::string>{"lost motion of joint 2"});
  EXPECT_NE(unsure.advice.find("do not correct programs by it"), std::string::npos);
  EXPECT_TRUE(cause_of_one(gain, {"drift"}).alternatives.empty());
  const Effect ripple{.kind = "gear_harmonic", .joint = 1, .settings = {{"ratio", 50.0}}, .values = {1e-4, 0.0}};
  EXPECT_TRUE(cause_of_one(ripple, {"backlash"}).alternatives.empty()) << "no side follows that";
}

TEST(CauseEntry, OfAFormulaGoesByTheKnownCauseThatDoesNearlyTheSame) {
  const Effect formula{.kind = "symbolic", .joint = 2, .values = {1e-4}};
  RoundEntry round;
  round.verdict = "added";
  round.effect = effect_entry(formula, made_up_arm());
  const CauseEntry unknown = cause_of_one(formula, {}, {round});
  EXPECT_EQ(unknown.cause, "formula");
  EXPECT_EQ(unknown.joint, 3u);
  round.members = {{"thermal_offset", 3}, {"symbolic", 3}};
  const CauseEntry known = cause_of_one(formula, {}, {round});
  EXPECT_EQ(known.cause, "heat");
  EXPECT_FALSE(known.joint) << "of the whole arm";
  EXPECT_EQ(known.alternatives, std::vector<std::string>{unknown.name});
  EXPECT_NE(known.advice.find("a formula that describes it a little better"), std::string::npos);
  EXPECT_GT(known.advice.size(), 80u) << "and what to do about heat: " << known.advice;
}

TEST(CauseEntry, SaysWhereASignIsNoArms) {
  const auto says = [](const std::string& kind, double value, const std::string& words, const std::string& form = "") {
    const Effect effect{.kind = kind, .joint = 1, .settings = {{"from", 1.0}}, .form = form, .values = {value, 0.0}};
    return cause_of_one(effect, {}).advice.find(words) != std::string::npos;
  };
  EXPECT_TRUE(says("compliance", -1e-6, "against its load"));
  EXPECT_FALSE(says("compliance", 1e-6, "against its load"));
  EXPECT_TRUE(says("backlash", -1e-4, "stops beyond where it is sent"));
  EXPECT_FALSE(says("backlash", 1e-4, "stops beyond"));
  EXPECT_FALSE(says("backlash", -1e-4, "signs of approach", "seated")) << "that form has none";
  EXPECT_TRUE(says("gain", 1e-4, "gear ratio"));
  EXPECT_TRUE(says("coupling", 1e-4, "Another joint drags it"));
  EXPECT_TRUE(says("joint_offset", 1e-4, "Master the joint"));
}

TEST(Doubt, IsSaidOfWhatWasNotLookedForAndNotConfirmed) {
  Report report;
  report.poses.validation = 20;
  report.considered = {"backlash", "gain"};
  EXPECT_EQ(doubt_sentence(report), "") << "nothing was added";
  RoundEntry added;
  added.verdict = to_string(Verdict::added);
  report.rounds = {added};
  EXPECT_EQ(doubt_sentence(report), "Nothing but backlash and gain was looked for: other causes may explain the same.");
  report.considered.clear();
  EXPECT_EQ(doubt_sentence(report), "");
  report.poses.validation = 0;
  EXPECT_NE(doubt_sentence(report).find("no validation poses"), std::string::npos);
}

}  // namespace
}  // namespace demecal

// An effect keeps its place and its numbers on the way through JSON, and people read sizes they can picture.
#include "report/effect_entry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "made_up_loop.hpp"
#include "report/amount.hpp"

namespace demecal {
namespace {

EffectEntry read_back(const EffectEntry& effect) {
  return effect_entry(JsonValue::parse(to_json(effect).dump(), "report.json"));
}

void expect_same(const EffectEntry& a, const EffectEntry& b) {
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.joint, b.joint);
  EXPECT_EQ(a.form, b.form);
  EXPECT_EQ(a.amplitude, b.amplitude);
  EXPECT_EQ(a.unit, b.unit);
  ASSERT_EQ(a.parameters.size(), b.parameters.size());
  for (std::size_t i = 0; i < a.parameters.size(); ++i) {
    EXPECT_EQ(a.parameters[i].name, b.parameters[i].name);
    EXPECT_EQ(a.parameters[i].value, b.parameters[i].value);
    EXPECT_EQ(a.parameters[i].standard_error, b.parameters[i].standard_error);
  }
}

TEST(EffectEntry, ComesBackFromJsonTheSameForEveryKindOfTheCatalogue) {
  RandomStream random{833};
  const Robot robot = made_up_arm();
  for (const EffectLaw* const law : catalogue()) {
    Effect effect{.kind = std::string(law->kind()), .joint = law->of_joint() ? 2 : -1, .settings = {}};
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
  EXPECT_FALSE(to_json(entry).contains("amplitude"));
  EXPECT_FALSE(to_json(entry).contains("standard_errors"));
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
  const auto json = to_json(effect_entry(effect, made_up_arm()));
  EXPECT_TRUE(json["parameters"]["width_rad"].is_null());
  EXPECT_TRUE(json["amplitude"].is_null());
  effect.joint = -1;
  effect.kind = "no such kind";
  EXPECT_TRUE(to_json(effect_entry(effect, made_up_arm()))["joint"].is_null());
}

TEST(EffectEntry, TakesJointZeroForNone) {
  EXPECT_FALSE(effect_entry(JsonValue::parse(R"({"kind": "drift", "joint": 0})", "report.json")).joint.has_value());
  EXPECT_EQ(effect_entry(JsonValue::parse("null", "report.json")).name(), "");
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

}  // namespace
}  // namespace demecal

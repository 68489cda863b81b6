// Scenarios that contradict themselves are refused in one sentence.
#include <gtest/gtest.h>

#include <functional>

#include "errors/input_error.hpp"
#include "planar_arm.hpp"

namespace demecal {
namespace {

struct Contradiction {
  std::string named;  ///< what the sentence must contain
  std::function<void(Scenario&)> make;
};

TEST(Scenario, RefusesWhatContradictsItselfAndNamesTheKey) {
  const std::vector<Contradiction> contradictions{
      {"backlash",
       [](Scenario& s) {
         s.backlash = {{2, 0.1}};
       }},
      {"geometry",
       [](Scenario& s) {
         s.geometry = {{-1, LinkParameter::a, 0.1}};
       }},
      {"coupling",
       [](Scenario& s) {
         s.couplings = {{0, 5, 0.1}};
       }},
      {"joint_errors",
       [](Scenario& s) {
         s.joint_errors = {{0, {}}};
       }},
      {"joint_errors",
       [](Scenario& s) {
         s.joint_errors = {{0, variable_tree(1)}};
       }},
      {"symbolic",
       [](Scenario& s) {
         s.symbolic = {{0, variable_tree(5)}};
       }},
      {"home", [](Scenario& s) { s.home = joints({0.0}); }},
      {"joint_ranges",
       [](Scenario& s) {
         s.joint_ranges = {{0.0, 1.0}};
       }},
      {"joint_ranges",
       [](Scenario& s) {
         s.joint_ranges = {{0.0, 1.0}, {1.0, 0.0}};
       }},
      {"repeats", [](Scenario& s) { s.repeats = 0; }},
      {"poses",
       [](Scenario& s) {
         s.poses = {1, -1, 0};
       }},
      {"noise", [](Scenario& s) { s.noise_m = -1.0; }},
      {"links", [](Scenario& s) { s.robot.masses.resize(1); }},
      {"robot", [](Scenario& s) { s.robot.chain.joints.clear(); }},
      {"temperature",
       [](Scenario& s) {
         s.temperature = TemperatureCourse{20, 30, 0};
       }},
  };
  for (const Contradiction& contradiction : contradictions) {
    Scenario scenario;
    scenario.robot = planar_arm();
    scenario.by_joints = true;
    ASSERT_NO_THROW(check(scenario));
    contradiction.make(scenario);
    try {
      check(scenario);
      ADD_FAILURE() << contradiction.named << " was accepted";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(contradiction.named), std::string::npos) << error.what();
    }
  }
}

TEST(Scenario, NeedsAHomeWhereOrientationsVaryAroundIt) {
  Scenario scenario;
  scenario.robot = puma_761();
  EXPECT_THROW(check(scenario), InputError);
  scenario.by_joints = true;
  EXPECT_NO_THROW(check(scenario));
}

}  // namespace
}  // namespace demecal

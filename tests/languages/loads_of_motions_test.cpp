// Loads that hold for one motion or spline alone: those behind WITH in KRL and TLoad of RAPID. What holds for the
// motions before and behind is another's.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "kinematics/random_arm.hpp"
#include "languages/reading_checks.hpp"
#include "parsed_programs/payload_flow.hpp"

namespace demecal {
namespace {

using ::testing::ElementsAre;

using Kilograms = std::vector<std::optional<double>>;

Kilograms kilograms_in(WrittenIn language, const std::string& text) {
  Kilograms found;
  for (const Target& target : with_followed_payloads(read_program(language, text, "p", wrist_arm())).targets)
    found.push_back(target.payload_kg);
  return found;
}

const std::string kAxes = "{A1 10,A2 -70,A3 50,A4 20,A5 60,A6 10}";

/// Of a motion between two with 4 kg.
Kilograms krl_between(const std::string& motion) {
  return kilograms_in(WrittenIn::krl, "DEF m()\nLOAD_DATA[3]={M 12.0,CM {X 0,Y 0,Z 0}}\n$LOAD={M 4.0}\nPTP " + kAxes +
                                          "\n" + motion + "\nPTP " + kAxes + "\nEND\n");
}

TEST(LoadsOfMotions, BehindWithOfKrlHoldForThemAlone) {
  const auto of = [](const std::string& with) { return krl_between("SPTP " + kAxes + with); };
  EXPECT_THAT(of(""), ElementsAre(4.0, 4.0, 4.0));
  EXPECT_THAT(of(" WITH $LOAD.M=10"), ElementsAre(4.0, 10.0, 4.0));
  EXPECT_THAT(of(" C_SPL WITH $VEL.CP=0.2, $LOAD={M 6.0,CM {X 0,Y 0,Z 5}}"), ElementsAre(4.0, 6.0, 4.0));
  EXPECT_THAT(of(" WITH $LOAD = SLOAD ( 3 )"), ElementsAre(4.0, 12.0, 4.0));
  EXPECT_THAT(of(" WITH $LOAD=LOAD_DATA[3]"), ElementsAre(4.0, 12.0, 4.0));
  EXPECT_THAT(of(" WITH $LOAD=SLOAD(4)"), ElementsAre(4.0, std::nullopt, 4.0)) << "given nowhere";
  EXPECT_THAT(of(" WITH $LOAD=SLOAD(FP1.TOOL_NO)"), ElementsAre(4.0, std::nullopt, 4.0));
  EXPECT_THAT(of(" WITH $LOAD.CM.Z=10"), ElementsAre(4.0, std::nullopt, 4.0));
  EXPECT_THAT(of(" ; WITH $LOAD.M=10"), ElementsAre(4.0, 4.0, 4.0));
}

TEST(LoadsOfMotions, OfSplinesHoldToTheirEnd) {
  const std::string spline = "SPL {X 1,Y 2,Z 3,A 4,B 5,C 6}\n";
  for (const char* word : {"SPLINE", "PTP_SPLINE"})
    EXPECT_THAT(krl_between(std::string(word) + " WITH $LOAD={M 10.0}\n" + spline +
                            "SPL {X 1,Y 2,Z 3,A 4,B 5,C 6} WITH $LOAD.M=2\nENDSPLINE"),
                ElementsAre(4.0, 10.0, 2.0, 4.0))
        << word;
}

TEST(LoadsOfMotions, OfTLoadAreNotTold) {
  const std::string joints = "[[10,20,10,20,60,30],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0";
  const auto rapid = [&](const std::string& option, const std::string& grip = "GripLoad part;\n") {
    return kilograms_in(WrittenIn::rapid,
                        "MODULE M\nPERS loaddata part:=[10,[0,0,50],[1,0,0,0],0,0,0];\nPROC main()\n" + grip +
                            "MoveAbsJ " + joints + ";\nMoveAbsJ " + joints + option + ";\nMoveAbsJ " + joints +
                            ";\nENDPROC\nENDMODULE\n");
  };
  EXPECT_THAT(rapid(""), ElementsAre(10.0, 10.0, 10.0));
  EXPECT_THAT(rapid("\\TLoad:=part"), ElementsAre(10.0, std::nullopt, 10.0)) << "it is with the tool's";
  EXPECT_THAT(rapid(" \\WObj:=wobj0 \\ TLoad := load0"), ElementsAre(10.0, std::nullopt, 10.0));
  EXPECT_THAT(rapid("\\TLoad:=part", ""), ElementsAre(std::nullopt, std::nullopt, std::nullopt));
}

}  // namespace
}  // namespace demecal

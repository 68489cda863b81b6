// What users get wrong, file by file: every fault names its file, line, value and rule.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>

#include "config/job_file.hpp"
#include "config/scenario_file.hpp"
#include "data_files/data_set_file.hpp"
#include "data_files/robot_file.hpp"
#include "sample_files.hpp"
#include "temporary_folder.hpp"

namespace demecal {
namespace {

using ::testing::HasSubstr;

/// A change to one of the sample files, and what the user must be told.
struct BadInput {
  const char* name;
  const char* file;  ///< that is changed
  const char* from;  ///< what stands there once; empty: the whole file
  const char* to;
  const char* where;  ///< "FILE:LINE" or "FILE" of the fault
  const char* value;  ///< in quotes in the message; empty: none
  const char* rule;
};

std::ostream& operator<<(std::ostream& stream, const BadInput& bad) {
  return stream << bad.name;
}

std::string sample(const std::string& file) {
  if (file == "robot.yaml") return kRobotText;
  if (file == "poses.csv") return kPosesText;
  if (file == "dataset.yaml") return kDataSetText;
  if (file == "job.yaml") return kJobText;
  return kScenarioText;
}

void load(const std::filesystem::path& folder, const std::string& changed_file) {
  if (changed_file == "job.yaml") {
    load_job(folder / "job.yaml");
  } else if (changed_file == "scenario.yaml") {
    load_scenario(folder / "scenario.yaml");
  } else {
    load_data_set(folder / "dataset.yaml");
  }
}

class BadInputs : public ::testing::TestWithParam<BadInput> {};

TEST_P(BadInputs, AreNamedWithFileLineValueAndRule) {
  const BadInput& bad = GetParam();
  const TemporaryFolder folder;
  for (const char* file : {"robot.yaml", "poses.csv", "dataset.yaml", "job.yaml", "scenario.yaml"}) {
    const std::string text = sample(file);
    const bool whole = std::string(bad.from).empty();
    folder.write(file, bad.file != std::string(file) ? text : whole ? bad.to : changed(text, bad.from, bad.to));
  }
  const std::string said = complaint([&] { load(folder.path(), bad.file); });
  EXPECT_THAT(said, HasSubstr((folder.path() / bad.where).string() + ": "));
  const std::string value = bad.value;
  EXPECT_THAT(said, HasSubstr(value.empty() ? ": " : ": '" + value + "': "));
  EXPECT_THAT(said, HasSubstr(bad.rule));
}

std::string name_of(const ::testing::TestParamInfo<BadInput>& info) {
  return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(
    Poses, BadInputs,
    ::testing::Values(
        BadInput{"EmptyFile", "poses.csv", "", "", "poses.csv", "", "is empty"},
        BadInput{"HeaderOnly", "poses.csv", "", "q1_deg,q2_mm\n", "poses.csv:1", "", "has a header but no rows"},
        BadInput{"TextInANumber", "poses.csv", "-80,200", "-8O,200", "poses.csv:4", "-8O", "q1_deg is not a number"},
        BadInput{"EmptyNumber", "poses.csv", "-80,200", "-80,", "poses.csv:4", "", "q2_mm is empty"},
        BadInput{"NotANumber", "poses.csv", "4,5,6", "NaN,5,6", "poses.csv:4", "NaN", "x_mm must be a finite number"},
        BadInput{"Infinite", "poses.csv", "4,5,6", "4,inf,6", "poses.csv:4", "inf", "y_mm must be a finite number"},
        BadInput{"ShortRow", "poses.csv", ",P2,A", ",P2", "poses.csv:4", "", "has 10 fields, but the header has 11"},
        BadInput{"DoubleColumn", "poses.csv", "x_mm,y_mm", "x_mm,x_mm", "poses.csv:1", "x_mm", "name of two columns"},
        BadInput{"ApproachInDegrees", "poses.csv", "700,-1,1", "700,-1,2", "poses.csv:4", "2", "must be -1, 0 or 1"},
        BadInput{"UnknownSet", "poses.csv", "1,validation", "1,test", "poses.csv:4", "test",
                 "must be calibration, validation or accept"},
        BadInput{"RepeatsWithOtherJoints", "poses.csv", "-1,1,validation,P2", "-1,1,calibration,P1", "poses.csv:4",
                 "P1", "joints differ from those of line 2"},
        BadInput{"UnknownTarget", "poses.csv", "P2,A", "P2,C", "poses.csv:4", "C", "is no target of tools_mm"},
        BadInput{"NegativeDistance", "poses.csv", "6,700", "6,-700", "poses.csv:4", "-700", "must be positive"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    DataSets, BadInputs,
    ::testing::Values(
        BadInput{"Malformed", "dataset.yaml", "[q1_deg, q2_mm]", "[q1_deg, q2_mm", "dataset.yaml:8", "",
                 "is not valid YAML"},
        BadInput{"Empty", "dataset.yaml", "", "", "dataset.yaml", "", "is empty"},
        BadInput{"OtherKindOfFile", "dataset.yaml", "demecal_dataset", "demecal_robot", "dataset.yaml:2",
                 "demecal_robot", "demecal_dataset: 1 is expected"},
        BadInput{"LaterVersion", "dataset.yaml", "demecal_dataset: 1", "demecal_dataset: 2", "dataset.yaml:2", "2",
                 "demecal_dataset must be 1"},
        BadInput{"UnknownKey", "dataset.yaml", "tools_mm", "tool_mm", "dataset.yaml:15", "tool_mm",
                 "is no key; the nearest is 'tools_mm'"},
        BadInput{"UnknownColumnKey", "dataset.yaml", "approach:", "aproach:", "dataset.yaml:10", "aproach",
                 "is no key of columns; the nearest is 'approach'"},
        BadInput{"DoubledKey", "dataset.yaml", "frame: base", "name: again", "dataset.yaml:16", "name", "stands twice"},
        BadInput{"UnknownColumn", "dataset.yaml", "z_mm]", "zz_mm]", "dataset.yaml:8", "zz_mm", "is no column of "},
        BadInput{"ColumnUsedTwice", "dataset.yaml", "z_mm]", "x_mm]", "dataset.yaml:8", "x_mm", "is named twice"},
        BadInput{"TooFewJointColumns", "dataset.yaml", "[q1_deg, q2_mm]", "[q1_deg]", "dataset.yaml:7", "",
                 "columns.joints must name 2 columns, not 1"},
        BadInput{"WrongUnit", "dataset.yaml", "[q1_deg, q2_mm]", "[q2_mm, q1_deg]", "dataset.yaml:7", "q2_mm",
                 "ends in a unit of a length"},
        BadInput{"NoUnit", "dataset.yaml", "[l1_mm]", "[pose_id]", "dataset.yaml:12", "pose_id", "is named twice"},
        BadInput{"ExcludesTwice", "dataset.yaml", "frame: base", "exclude: [P1, P1]", "dataset.yaml:16", "P1",
                 "is excluded already"},
        BadInput{"ExcludesNoPose", "dataset.yaml", "frame: base", "exclude: [P9]", "dataset.yaml:16", "P9",
                 "is the id of no pose; the nearest is 'P1'"},
        BadInput{"UnknownFrame", "dataset.yaml", "frame: base", "frame: world", "dataset.yaml:16", "world",
                 "must be one of: base sensor"},
        BadInput{"MissingRobot", "dataset.yaml", "robot: robot.yaml\n", "", "dataset.yaml:2", "", "robot is missing"},
        BadInput{"AbsentPosesFile", "dataset.yaml", "poses.csv", "other.csv", "dataset.yaml:5", "",
                 "poses names a file that does not exist"},
        BadInput{"DistancesWithoutAnchors", "dataset.yaml", "anchors_mm: [[1000, 0, 0]]\n", "", "dataset.yaml:9",
                 "l1_mm", "anchors_mm is missing"},
        BadInput{"TooManyAnchors", "dataset.yaml", "[[1000, 0, 0]]", "[[1, 0, 0], [2, 0, 0]]", "dataset.yaml:14", "",
                 "anchors_mm must have 1 elements, not 2"},
        BadInput{"SplitOfEverything", "dataset.yaml", "frame: base", "split: {validation_fraction: 1}",
                 "dataset.yaml:16", "", "leaves no poses for calibration"},
        BadInput{"SplitBeyondOne", "dataset.yaml", "frame: base", "split: {validation_fraction: 30}", "dataset.yaml:16",
                 "30", "split.validation_fraction must lie within 0 to 1"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Robots, BadInputs,
    ::testing::Values(
        BadInput{"UnknownConvention", "robot.yaml", "standard_dh", "dh", "robot.yaml:4", "dh",
                 "convention must be one of: standard_dh modified_dh"},
        BadInput{"TwoJointsOfOneName", "robot.yaml", "limits_deg: [-170, 170]}\n  - {",
                 "name: elbow, limits_deg: [-170, 170]}\n  - {name: elbow, ", "robot.yaml:7", "elbow",
                 "is the name of two joints"},
        BadInput{"BalancerOfASlide", "robot.yaml", "tool_mm:",
                 "balancers: [{joint: 2, fixed_mm: 100, moving_mm: 200, shortest_deg: 0}]\ntool_mm:", "robot.yaml:8",
                 "2", "joint slides"},
        BadInput{"BalancerWithoutLength", "robot.yaml", "tool_mm:",
                 "balancers: [{joint: 1, fixed_mm: 100, moving_mm: 100, shortest_deg: 0}]\ntool_mm:", "robot.yaml:8",
                 "100", "moving_mm must differ from fixed_mm"},
        BadInput{"TwoBalancersOfAJoint", "robot.yaml", "tool_mm:",
                 "balancers: [{joint: 1, fixed_mm: 100, moving_mm: 200, shortest_deg: 0}, {joint: 1, fixed_mm: 100, "
                 "moving_mm: 300, shortest_deg: 0}]\ntool_mm:",
                 "robot.yaml:8", "1", "has a balancer already"},
        BadInput{"UnknownJointKey", "robot.yaml", "d_mm: 10", "d_m: 10", "robot.yaml:7", "d_m",
                 "is no key of joints[2]; the nearest is 'd_mm'"},
        BadInput{"MissingLength", "robot.yaml", "a_mm: 400, ", "", "robot.yaml:6", "", "joints[1].a_mm is missing"},
        BadInput{"UnknownJointType", "robot.yaml", "type: prismatic", "type: linear", "robot.yaml:7", "linear",
                 "joints[2].type must be one of"},
        BadInput{"LimitsOfTheWrongUnit", "robot.yaml", "limits_mm: [0, 250]", "limits_deg: [0, 250]", "robot.yaml:7",
                 "", "a prismatic joint has limits_mm"},
        BadInput{"LimitsThatFall", "robot.yaml", "[-170, 170]", "[170, -170]", "robot.yaml:6", "[170, -170]",
                 "limits_deg must rise from lower to upper"},
        BadInput{"AngleInRadians", "robot.yaml", "alpha_deg: 0, a_mm: 400", "alpha_deg: 1.5708, a_mm: 400",
                 "robot.yaml:6", "1.5708", "joints[1].alpha_deg looks like radians"},
        BadInput{"TooFewLinks", "robot.yaml", "  - {mass_kg: 1, com_mm: [-150, 0, 0]}\n", "", "robot.yaml:9", "",
                 "links must have 2 elements, not 1"},
        BadInput{"NegativeMass", "robot.yaml", "mass_kg: 3", "mass_kg: -3", "robot.yaml:10", "-3",
                 "links[1].mass_kg must not be negative"},
        BadInput{"GravityInMillimetres", "robot.yaml", "-9.81", "-9810", "robot.yaml:12", "", "must not exceed 20"},
        BadInput{"NoJoints", "robot.yaml", "", "demecal_robot: 1\nname: a\nconvention: standard_dh\njoints: []\n",
                 "robot.yaml:4", "", "joints must be from 1 to 9, not 0"},
        BadInput{"ToolOfTwoNumbers", "robot.yaml", "[0, 0, 50]", "[0, 50]", "robot.yaml:8", "",
                 "tool_mm must have 3 elements, not 2"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Jobs, BadInputs,
    ::testing::Values(
        BadInput{"UnknownKey", "job.yaml", "population_size", "populaton_size", "job.yaml:8", "populaton_size",
                 "is no key of gp; the nearest is 'population_size'"},
        BadInput{"NegativePopulation", "job.yaml", "population_size: 120", "population_size: -120", "job.yaml:8",
                 "-120", "gp.population_size must be at least 1"},
        BadInput{"HugePopulation", "job.yaml", "population_size: 120", "population_size: 3000000000", "job.yaml:8",
                 "3000000000", "gp.population_size must lie within"},
        BadInput{"HalfAGeneration", "job.yaml", "number_generations: 40", "number_generations: 40.5", "job.yaml:9",
                 "40.5", "gp.number_generations must be a whole number"},
        BadInput{"CrossedDepthRamp", "job.yaml", "depth1: 3", "depth1: 7", "job.yaml:11", "7",
                 "must not exceed initial_max_tree_depth2"},
        BadInput{"FewerNodesThanTheRampTakes", "job.yaml", "max_tree_depth: 8",
                 "max_tree_depth: 8\n  max_tree_nodes: 126", "job.yaml:14", "126",
                 "gp.max_tree_nodes must be 0 (no limit) or at least 127"},
        BadInput{"MinimumAboveTheRamp", "job.yaml", "min_tree_depth: 2", "min_tree_depth: 5", "job.yaml:14", "5",
                 "must not exceed initial_max_tree_depth1"},
        BadInput{"TournamentLargerThanPopulation", "job.yaml", "tournament_size: 4", "tournament_size: 121",
                 "job.yaml:10", "121", "must not exceed population_size"},
        BadInput{"DefaultTournamentLargerThanPopulation", "job.yaml", "",
                 "demecal_job: 1\ndata: d.yaml\ngp:\n  population_size: 3\n", "job.yaml:3", "5",
                 "gp (tournament_size) must not exceed population_size"},
        BadInput{"RateAboveOne", "job.yaml", "crossover_rate: 0.7", "crossover_rate: 1.2", "job.yaml:16", "1.2",
                 "gp.crossover_rate must lie within 0 to 1"},
        BadInput{"RateInWords", "job.yaml", "mutation_rate: 0.25", "mutation_rate: often", "job.yaml:17", "often",
                 "gp.mutation_rate must be a number"},
        BadInput{"UnknownFunction", "job.yaml", "SIN,", "SINE,", "job.yaml:21", "SINE", "the nearest is 'SIN'"},
        BadInput{"UnquotedFunction", "job.yaml", "'*'", "*", "job.yaml:21", "", "symbols such as * and % need quotes"},
        BadInput{"NoFunctions", "job.yaml", "['+', '-', '*', '%', SIN, SQRTp]", "[]", "job.yaml:21", "",
                 "must name at least one function"},
        BadInput{"FunctionTwice", "job.yaml", "SIN, SQRTp", "SIN, SIN", "job.yaml:21", "SIN", "no function twice"},
        BadInput{"FallingConstants", "job.yaml", "[-2, 2.5]", "[2.5, -2]", "job.yaml:22", "[2.5, -2]",
                 "gp.constants_range must rise"},
        BadInput{"UnknownPolicyOfConstants", "job.yaml", "mutation_rate: 0.25",
                 "mutation_rate: 0.25\n  constants: darwinian", "job.yaml:18", "darwinian",
                 "gp.constants must be one of: none lamarckian baldwin"},
        BadInput{"ShareAboveOne", "job.yaml", "mutation_rate: 0.25", "mutation_rate: 0.25\n  constant_share: 1.5",
                 "job.yaml:18", "1.5", "gp.constant_share must lie within 0 to 1"},
        BadInput{"NoSteps", "job.yaml", "mutation_rate: 0.25", "mutation_rate: 0.25\n  constant_steps: 0",
                 "job.yaml:18", "0", "gp.constant_steps must be at least 1"},
        BadInput{"UnknownTopology", "job.yaml", "topology: full", "topology: star", "job.yaml:25", "star",
                 "islands.topology must be one of: none ring full"},
        BadInput{"NoIslands", "job.yaml", "per_joint: 3", "per_joint: 0", "job.yaml:24", "0",
                 "islands.per_joint must lie within 1"},
        BadInput{"MoreMigrantsThanResidents", "job.yaml", "migrants: 2", "migrants: 120", "job.yaml:27", "120",
                 "islands.migrants must lie within 0 to 119"},
        BadInput{"TruthInWords", "job.yaml", "between_joints: true", "between_joints: perhaps", "job.yaml:28",
                 "perhaps", "islands.between_joints must be one of: true false"},
        BadInput{"SeedInWords", "job.yaml", "seed: 7", "seed: lucky", "job.yaml:5", "lucky",
                 "seed must be a whole number"},
        BadInput{"NegativeSeed", "job.yaml", "seed: 7", "seed: -7", "job.yaml:5", "-7", "seed must be a whole number"},
        BadInput{"UnknownMethod", "job.yaml", "method: distal", "method: distant", "job.yaml:4", "distant",
                 "method must be one of: direct distal diagnose structural; the nearest is 'distal'"},
        BadInput{"UnknownDistalForm", "job.yaml", "form: sequential", "form: sequentiel", "job.yaml:35", "sequentiel",
                 "distal.form must be one of: parallel sequential; the nearest is 'sequential'"},
        BadInput{"UnknownAmplitudes", "job.yaml", "amplitudes: fitted", "amplitudes: fit", "job.yaml:35", "fit",
                 "distal.amplitudes must be one of: as_evolved fitted; the nearest is 'fitted'"},
        BadInput{"UnknownTargets", "job.yaml", "targets: posterior", "targets: exactly", "job.yaml:36", "exactly",
                 "targets must be one of: exact posterior; the nearest is 'exact'"},
        BadInput{"JointErrorOfExactTargets", "job.yaml", "targets: posterior", "targets: exact", "job.yaml:37", "2.5",
                 "joint_error_mrad says nothing where targets are exact"},
        BadInput{"NoJointError", "job.yaml", "joint_error_mrad: 2.5", "joint_error_mrad: 0", "job.yaml:37", "0",
                 "joint_error_mrad must be"},
        BadInput{"NoRounds", "job.yaml", "rounds: 3", "rounds: 0", "job.yaml:35", "0",
                 "distal.rounds must lie within 1 to 1000"},
        BadInput{"UnknownDeclaration", "job.yaml", "geometry", "geometri", "job.yaml:6", "geometri",
                 "model.declared[2] must be one of"},
        BadInput{"UnknownCandidate", "job.yaml", "[backlash, compliance]", "[backlush]", "job.yaml:32", "backlush",
                 "the nearest is 'backlash'"},
        BadInput{"CertainFamilyError", "job.yaml", "family_error: 0.01", "family_error: 1", "job.yaml:31", "1",
                 "closed_loop.family_error must be below 1"},
        BadInput{"TooManyEffects", "job.yaml", "max_effects: 4", "max_effects: 1001", "job.yaml:30", "1001",
                 "closed_loop.max_effects must lie within 0 to 1000"},
        BadInput{"NegativeRatio", "job.yaml", "[161, 211.5]", "[161, -3]", "job.yaml:34", "-3",
                 "closed_loop.ratios[2] must be"},
        BadInput{"MissingData", "job.yaml", "data: dataset.yaml\n", "", "job.yaml:2", "", "data is missing"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Scenarios, BadInputs,
    ::testing::Values(
        BadInput{"UnknownError", "scenario.yaml", "  backlash:", "  backlsh:", "scenario.yaml:20", "backlsh",
                 "is no key of errors; the nearest is 'backlash'"},
        BadInput{"JointZero", "scenario.yaml", "joint: 1, share: 1e-4", "joint: 0, share: 1e-4", "scenario.yaml:25",
                 "0", "errors.gain[1].joint must lie within 1 to 2"},
        BadInput{"BrokenFormula", "scenario.yaml", "0.001 * SIN(theta)", "0.001 * SIN(theta", "scenario.yaml:19",
                 "0.001 * SIN(theta", "errors.joint_errors[1].formula is no formula"},
        BadInput{"UnknownVariable", "scenario.yaml", "SIN(q1 + 2 * q2)", "SIN(q1 + 2 * q3)", "scenario.yaml:31", "",
                 "errors.symbolic[1].formula is no formula"},
        BadInput{"WidthWithoutUnit", "scenario.yaml", "width_deg", "width", "scenario.yaml:20", "width",
                 "the nearest is 'width_m'"},
        BadInput{"WidthOfTheWrongUnit", "scenario.yaml", "width_mm", "width_deg", "scenario.yaml:20", "",
                 "give width_mm or width_m"},
        BadInput{"ValueInTwoUnits", "scenario.yaml", "width_deg: 0.02", "width_deg: 0.02, width_rad: 0.1",
                 "scenario.yaml:20", "", "another unit has given already"},
        BadInput{"NoPoses", "scenario.yaml", "{calibration: 4, validation: 3, accept: 2, repeats: 2}", "{}",
                 "scenario.yaml:6", "", "poses must be one at least"},
        BadInput{"TwoRegions", "scenario.yaml", "home:", "cuboid: {}\nhome:", "scenario.yaml:7", "",
                 "joint_ranges contradicts cuboid"},
        BadInput{"RangeBeyondLimits", "scenario.yaml", "[-90, 90]", "[-90, 180]", "scenario.yaml:7", "[-90, 180]",
                 "joint_ranges.q1_deg reaches beyond the joint's limits, -170 to 170 deg; narrow the range"},
        BadInput{"HomeOutsideLimits", "scenario.yaml", "q2_m: 0.1", "q2_m: 100", "scenario.yaml:8", "100",
                 "home puts joint 2 outside its limits"},
        BadInput{"NegativeNoise", "scenario.yaml", "noise_mm: 0.1", "noise_mm: -0.1", "scenario.yaml:11", "-0.1",
                 "measurement.noise_mm must not be negative"},
        BadInput{"FaultInTheRobotItNames", "scenario.yaml", "robot: robot.yaml", "robot: poses.csv", "poses.csv:1", "",
                 "must be a map"}),
    name_of);

TEST(BadInput, AbsentFilesAreNamed) {
  EXPECT_EQ(complaint([] { load_robot("/nowhere/robot.yaml"); }),
            "/nowhere/robot.yaml: cannot be read: No such file or directory");
  EXPECT_EQ(complaint([] { load_job("/nowhere/job.yaml"); }),
            "/nowhere/job.yaml: cannot be read: No such file or directory");
}

}  // namespace
}  // namespace demecal

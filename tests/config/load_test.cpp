// Valid files of every kind become the values they write.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/job_file.hpp"
#include "config/scenario_file.hpp"
#include "data_files/data_set_file.hpp"
#include "data_files/robot_file.hpp"
#include "kinematics/units.hpp"
#include "sample_files.hpp"
#include "temporary_folder.hpp"
#include "yaml/files.hpp"

namespace demecal {
namespace {

using ::testing::DoubleEq;
using ::testing::ElementsAre;

struct Samples {
  TemporaryFolder folder;
  std::filesystem::path robot = folder.write("robot.yaml", kRobotText);
  std::filesystem::path poses = folder.write("poses.csv", kPosesText);
  std::filesystem::path data_set = folder.write("dataset.yaml", kDataSetText);
  std::filesystem::path job = folder.write("demo.yaml", kJobText);
  std::filesystem::path scenario = folder.write("scenario.yaml", kScenarioText);
};

TEST(LoadRobot, ReadsEveryKey) {
  const Samples samples;
  const Robot robot = load_robot(samples.robot);
  EXPECT_EQ(robot.name, "Two joints");
  ASSERT_EQ(robot.chain.size(), 2);
  EXPECT_EQ(robot.chain.joints[1].type, JointType::prismatic);
  EXPECT_DOUBLE_EQ(robot.chain.joints[0].a_m, 0.4);
  EXPECT_DOUBLE_EQ(robot.chain.joints[0].upper, radians(170.0));
  EXPECT_DOUBLE_EQ(robot.chain.joints[1].upper, 0.25);
  EXPECT_DOUBLE_EQ(robot.chain.tool_m.z(), 0.05);
  EXPECT_DOUBLE_EQ(robot.masses[0].centre_m.x(), -0.2);
  EXPECT_EQ(robot.gravity_mps2, Eigen::Vector3d(0.0, 0.0, -9.81));
  EXPECT_DOUBLE_EQ(*robot.repeatability_m, 5e-5);
  EXPECT_DOUBLE_EQ(*robot.payload_kg, 10.0);
}

TEST(LoadDataSet, ReadsEveryKey) {
  const Samples samples;
  const DataSet data = load_data_set(samples.data_set);
  EXPECT_EQ(data.name, "two");
  EXPECT_EQ(data.frame, Frame::base);
  EXPECT_EQ(data.file, samples.poses.string());
  EXPECT_EQ(data.sha256, sha256(kPosesText));
  ASSERT_EQ(data.poses.size(), 3u);
  EXPECT_DOUBLE_EQ(data.poses[2].joints[0], radians(-80.0));
  EXPECT_DOUBLE_EQ(data.poses[2].joints[1], 0.2);
  EXPECT_THAT(data.poses[2].distances_m, ElementsAre(DoubleEq(0.7)));
  EXPECT_EQ(nominal_tool(data, data.poses[1]), Eigen::Vector3d(0.0, 0.03, 0.05));
  EXPECT_THAT(data.anchors_m, ElementsAre(Eigen::Vector3d(1.0, 0.0, 0.0)));
  EXPECT_THAT(poses_of(data, PoseSet::calibration), ElementsAre(0u, 1u));
}

TEST(LoadDataSet, SplitsByPoseWhereThereIsNoSetColumn) {
  const Samples samples;
  std::string text = changed(kDataSetText, "  set: set\n", "");
  text += "split: {validation_fraction: 0.5, seed: 3}\n";
  const DataSet data = load_data_set(samples.folder.write("split.yaml", text));
  EXPECT_EQ(data.poses[0].set, data.poses[1].set);
  EXPECT_NE(data.poses[0].set, data.poses[2].set);
}

TEST(LoadDataSet, TakesUnknownAnchors) {
  const Samples samples;
  const auto path = samples.folder.write("u.yaml", changed(kDataSetText, "[[1000, 0, 0]]", "unknown"));
  EXPECT_TRUE(load_data_set(path).anchors_unknown);
}

TEST(LoadJob, TakesADataSetOfEveryStation) {
  const Samples samples;
  const std::string file = samples.data_set.filename().string();
  const std::string list = "demecal_job: 1\ndata: [" + file + ", " + file + "]\n";
  const Job job = load_job(samples.folder.write("stations.yaml", list));
  EXPECT_EQ(job.data_files.size(), 2U);
  EXPECT_EQ(job.station_tools, StationTools::own);
  const std::string shared = "demecal_job: 1\nstation_tools: shared\ndata: [" + file + ", " + file + "]\n";
  EXPECT_EQ(load_job(samples.folder.write("shared.yaml", shared)).station_tools, StationTools::shared);
  EXPECT_THROW(load_job(samples.folder.write("none.yaml", "demecal_job: 1\ndata: []\n")), InputError);
  EXPECT_THROW(load_job(samples.folder.write("wrong.yaml", "demecal_job: 1\ndata: [a]\nstation_tools: mine\n")),
               InputError);
}

TEST(LoadJob, ReadsEveryKey) {
  const Samples samples;
  const Job job = load_job(samples.job);
  EXPECT_EQ(job.name, "demo");
  EXPECT_EQ(job.data_files, std::vector{samples.data_set.string()});
  EXPECT_EQ(job.method, Method::distal);
  EXPECT_EQ(job.seed, 7u);
  EXPECT_EQ(job.distal.form, DistalForm::sequential);
  EXPECT_EQ(job.distal.rounds, 3);
  EXPECT_EQ(job.distal.amplitudes, Amplitudes::fitted);
  EXPECT_EQ(job.targets.kind, TargetKind::posterior);
  EXPECT_DOUBLE_EQ(job.targets.joint_error_rad, 2.5e-3);
  EXPECT_TRUE(job.declared.registration && job.declared.geometry && job.declared.joint_corrections);
  EXPECT_FALSE(job.declared.tool || job.declared.joint_offset);
  EXPECT_EQ(job.gp.population_size, 120);
  EXPECT_EQ(job.gp.number_generations, 40);
  EXPECT_EQ(job.gp.tournament_size, 4);
  EXPECT_EQ(job.gp.initial_max_tree_depth1, 3);
  EXPECT_EQ(job.gp.initial_max_tree_depth2, 6);
  EXPECT_EQ(job.gp.max_tree_depth, 8);
  EXPECT_EQ(job.gp.min_tree_depth, 2);
  EXPECT_EQ(job.gp.invalid_attempts, 11);
  EXPECT_EQ(job.gp.crossover_rate, 0.7);
  EXPECT_EQ(job.gp.mutation_rate, 0.25);
  EXPECT_EQ(job.gp.terminal_crossover_rate, 0.15);
  EXPECT_EQ(job.gp.terminal_mutation_rate, 0.35);
  EXPECT_EQ(job.gp.shrink_mutation_rate, 0.1);
  EXPECT_THAT(job.gp.functions, ElementsAre(Primitive::add, Primitive::subtract, Primitive::multiply, Primitive::divide,
                                            Primitive::sine, Primitive::square_root));
  EXPECT_EQ(job.gp.constants_lower, -2.0);
  EXPECT_EQ(job.gp.constants_upper, 2.5);
  EXPECT_EQ(job.islands.per_joint, 3u);
  EXPECT_EQ(job.islands.topology, Topology::full);
  EXPECT_EQ(job.islands.migration_interval, 5u);
  EXPECT_EQ(job.islands.migrants, 2u);
  EXPECT_TRUE(job.islands.between_joints);
  EXPECT_EQ(job.closed_loop.max_effects, 4);
  EXPECT_EQ(job.closed_loop.family_error, 0.01);
  EXPECT_THAT(job.closed_loop.candidates, ElementsAre("backlash", "compliance"));
  EXPECT_EQ(job.closed_loop.highest_ratio, 90);
  EXPECT_THAT(job.closed_loop.ratios, ElementsAre(161.0, 211.5));
  EXPECT_EQ(job.explanations.variations, 2000);
  EXPECT_EQ(job.explanations.most_causes, 8U);
}

TEST(LoadJob, ReadsHowConstantsAreFitted) {
  const Samples samples;
  const char* const kText =
      "demecal_job: 1\ndata: d.yaml\n"
      "gp: {constants: baldwin, constant_steps: 6, constant_share: 0.2, linear_scaling: true}\n";
  const Job job = load_job(samples.folder.write("fitted.yaml", kText));
  EXPECT_EQ(job.gp.constants, ConstantPolicy::baldwin);
  EXPECT_EQ(job.gp.constant_steps, 6);
  EXPECT_EQ(job.gp.constant_share, 0.2);
  EXPECT_TRUE(job.gp.linear_scaling);
}

TEST(LoadJob, ReadsHowEvolutionKeepsItsVariety) {
  const Samples samples;
  const char* const kText =
      "demecal_job: 1\ndata: d.yaml\n"
      "gp: {no_duplicates: true, restart_after: 5, functions: [\"+\", TANH, MAX], function_weights: [1, 2, 0.5]}\n"
      "islands: {replacement: random, spread: 0.4}\n";
  const Job job = load_job(samples.folder.write("varied.yaml", kText));
  EXPECT_TRUE(job.gp.no_duplicates);
  EXPECT_EQ(job.gp.restart_after, 5);
  EXPECT_THAT(job.gp.functions, ElementsAre(Primitive::add, Primitive::hyperbolic_tangent, Primitive::maximum));
  EXPECT_THAT(job.gp.function_weights, ElementsAre(1.0, 2.0, 0.5));
  EXPECT_EQ(job.islands.replacement, Replacement::random);
  EXPECT_EQ(job.islands.spread, 0.4);
}

TEST(LoadJob, ReadsWhatIsAskedOfCorrections) {
  const Samples samples;
  const char* const kText =
      "demecal_job: 1\ndata: d.yaml\n"
      "gp: {largest_correction_mrad: 5, seed_formulas: [\"0.002 * SIN(theta)\", {joint: 2, expression: theta}]}\n";
  const Job job = load_job(samples.folder.write("seeded.yaml", kText));
  EXPECT_DOUBLE_EQ(job.corrections.largest_rad, 0.005);
  ASSERT_EQ(job.corrections.seeds.size(), 2u);
  EXPECT_EQ(job.corrections.seeds[0].joint, SeedFormula::kEveryJoint);
  EXPECT_EQ(job.corrections.seeds[0].formula.size(), 4u);
  EXPECT_EQ(job.corrections.seeds[1].joint, 1);
  EXPECT_EQ(job.corrections.seeds[1].formula, variable_tree(0));
}

TEST(LoadJob, ReadsHowJointsShareFunctions) {
  const Samples samples;
  const std::string head = "demecal_job: 1\ndata: d.yaml\n";
  const Job none = load_job(samples.folder.write("none.yaml", head));
  EXPECT_EQ(none.corrections.sharing.functions, 0);
  const Job job = load_job(samples.folder.write(
      "sharing.yaml", head + "gp: {shared_functions: 3, function_stages: 5, shared_function_weight: 0.5}\n"));
  EXPECT_EQ(job.corrections.sharing.functions, 3);
  EXPECT_EQ(job.corrections.sharing.stages, 5);
  EXPECT_EQ(job.gp.shared_function_weight, 0.5);
}

TEST(LoadJob, RefusesFunctionsThatCannotBeShared) {
  const Samples samples;
  for (const char* const rest : {"gp: {shared_functions: -1}\n", "gp: {shared_functions: 17}\n",
                                 "gp: {function_stages: 1}\n", "gp: {shared_function_weight: 0}\n",
                                 "gp: {shared_functions: 2}\nmethod: distal\ndistal: {form: sequential}\n"}) {
    const auto path = samples.folder.write("bad.yaml", std::string("demecal_job: 1\ndata: d.yaml\n") + rest);
    EXPECT_THROW(load_job(path), InputError) << rest;
  }
}

TEST(LoadJob, RefusesSeedsThatAreNoFormulasOrHaveNoPlace) {
  const Samples samples;
  for (const char* const rest :
       {"gp: {seed_formulas: [\"SIN(\"]}\n", "gp: {seed_formulas: [{joint: 0, expression: theta}]}\n",
        "gp: {seed_models: [nowhere.yaml]}\n", "gp: {largest_correction_mrad: 0}\n", "gp: {function_weights: [1, 2]}\n",
        "islands: {spread: 1.5}\n", "gp: {seed_formulas: [theta]}\nmethod: distal\ndistal: {form: sequential}\n"}) {
    const std::string text = std::string("demecal_job: 1\ndata: d.yaml\n") + rest;
    EXPECT_THROW(load_job(samples.folder.write("refused.yaml", text)), InputError) << rest;
  }
}

TEST(LoadJob, DeclaresByTheSameWordsFromACommandLine) {
  const std::vector<std::string> words{"tool", "joint_corrections"};
  const DeclaredModel declared = declared_model(words);
  EXPECT_TRUE(declared.tool && declared.joint_corrections);
  EXPECT_FALSE(declared.registration || declared.joint_offset || declared.geometry);
  EXPECT_THAT(declared_words(), ElementsAre("registration", "tool", "joint_offset", "geometry", "joint_corrections"));
}

TEST(LoadJob, KeepsDefaultsForWhatIsLeftOut) {
  const Samples samples;
  const Job job = load_job(samples.folder.write("least.yaml", "demecal_job: 1\ndata: d.yaml\n"));
  const Job defaults;
  EXPECT_EQ(job.gp.population_size, defaults.gp.population_size);
  EXPECT_EQ(job.gp.functions, defaults.gp.functions);
  EXPECT_EQ(job.islands.per_joint, defaults.islands.per_joint);
  EXPECT_EQ(job.declared.registration, defaults.declared.registration);
  EXPECT_TRUE(job.closed_loop.candidates.empty());
  EXPECT_EQ(job.closed_loop.max_effects, 150);
  EXPECT_EQ(job.targets.kind, TargetKind::posterior);
  EXPECT_EQ(job.targets.joint_error_rad, 1e-3);
}

TEST(LoadJob, TakesTargetsAsTheThesisDidWhereAsked) {
  const Samples samples;
  const char* const kText = "demecal_job: 1\ndata: d.yaml\ntargets: exact\n";
  EXPECT_EQ(load_job(samples.folder.write("exact.yaml", kText)).targets.kind, TargetKind::exact);
}

TEST(LoadScenario, ReadsWhereAndHowIsMeasured) {
  const Samples samples;
  const Scenario scenario = load_scenario(samples.scenario);
  EXPECT_EQ(scenario.robot.name, "Two joints");
  EXPECT_EQ(scenario.robot_file, samples.robot.string());
  EXPECT_EQ(scenario.seed, 5u);
  EXPECT_THAT(scenario.poses, ElementsAre(4, 3, 2));
  EXPECT_EQ(scenario.repeats, 2);
  EXPECT_TRUE(scenario.by_joints);
  EXPECT_DOUBLE_EQ(scenario.joint_ranges[0][1], radians(90.0));
  EXPECT_DOUBLE_EQ(scenario.joint_ranges[1][0], 0.01);
  EXPECT_DOUBLE_EQ(scenario.home[1], 0.1);
  EXPECT_TRUE(scenario.sensor_from_base.isApprox(Eigen::Translation3d(0.1, 0.2, 0.3) *
                                                 Eigen::AngleAxisd(radians(90.0), Eigen::Vector3d::UnitZ())));
  EXPECT_DOUBLE_EQ(scenario.noise_m, 1e-4);
  EXPECT_TRUE(scenario.orientation_measured);
  EXPECT_DOUBLE_EQ(scenario.orientation_noise_rad, radians(0.02));
  EXPECT_FALSE(scenario.approach_recorded);
  EXPECT_THAT(scenario.payloads_kg, ElementsAre(0.0, 2.5));
  EXPECT_EQ(scenario.seconds_per_pose, 20.0);
  EXPECT_EQ(scenario.temperature->upper_celsius, 30.0);
  EXPECT_EQ(scenario.reference_celsius, 22.0);
}

TEST(LoadScenario, ReadsEveryErrorCountingJointsFromOne) {
  const Samples samples;
  const Scenario scenario = load_scenario(samples.scenario);
  ASSERT_EQ(scenario.geometry.size(), 2u);
  EXPECT_EQ(scenario.geometry[0].joint, 0);
  EXPECT_EQ(scenario.geometry[0].parameter, LinkParameter::a);
  EXPECT_DOUBLE_EQ(scenario.geometry[0].value, 4e-4);
  EXPECT_DOUBLE_EQ(scenario.geometry[1].value, radians(0.1));
  EXPECT_EQ(to_string(scenario.joint_errors.at(0).formula), "0.001 * SIN(theta)");
  EXPECT_DOUBLE_EQ(scenario.backlash.at(0).width_rad, radians(0.02));
  EXPECT_EQ(scenario.backlash.at(1).joint, 1);
  EXPECT_DOUBLE_EQ(scenario.backlash.at(1).width_rad, 1e-4);
  EXPECT_EQ(scenario.hysteresis.at(0).per_nm, 0.01);
  EXPECT_EQ(scenario.compliance.at(1).rad_per_nm, 2e-7);
  EXPECT_EQ(scenario.link_bending.at(0).x_rad_per_nm, 1e-6);
  EXPECT_EQ(scenario.gear_harmonics.at(0).ratio, 71.0);
  EXPECT_EQ(scenario.gains.at(0).per_rad, 1e-4);
  EXPECT_EQ(scenario.eccentricities.at(0).order, 2);
  EXPECT_EQ(scenario.couplings.at(0).from, 0);
  EXPECT_DOUBLE_EQ(scenario.couplings.at(0).sine_rad, 1e-4);
  EXPECT_DOUBLE_EQ(scenario.axis_wobble.at(0).cosine_rad.x(), radians(0.01));
  EXPECT_EQ(scenario.axis_wobble.at(0).sine_rad.y(), 1e-4);
  EXPECT_EQ(scenario.balance_springs.at(0).moving_m, 0.4);
  EXPECT_DOUBLE_EQ(scenario.balance_springs.at(0).shortest_rad, radians(90.0));
  EXPECT_EQ(scenario.balance_springs.at(0).n_per_m, 15000.0);
  EXPECT_EQ(scenario.thermal_offsets.at(0).rad_per_kelvin, 1e-5);
  EXPECT_EQ(scenario.thermal_lengths.at(0).per_kelvin, 1.2e-5);
  EXPECT_EQ(scenario.symbolic.size(), 1u);
  EXPECT_DOUBLE_EQ(scenario.drift.metres_per_s.x(), 1e-6);
  EXPECT_DOUBLE_EQ(scenario.drift.rad_per_s.z(), radians(1e-5));
  EXPECT_EQ(scenario.sensor_scale.share, 1e-5);
  EXPECT_DOUBLE_EQ(scenario.tool_error_m.z(), -1e-4);
}

}  // namespace
}  // namespace demecal

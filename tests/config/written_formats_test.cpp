// docs/FORMATS.md names the keys and columns of what demecal writes, no more and no less, and the files and exit codes
// that stand in the sources.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "acceptance/certificate.hpp"
#include "data/csv.hpp"
#include "data_files/data_set_file.hpp"
#include "drafting/planned_files.hpp"
#include "drafting/preparation_file.hpp"
#include "formats_document.hpp"
#include "full_report.hpp"
#include "languages/named_languages.hpp"
#include "monitor/events.hpp"
#include "monitor/made_up_run.hpp"
#include "preparation/results.hpp"
#include "programs/corrected_arm.hpp"
#include "programs/summary.hpp"
#include "report/evaluation.hpp"
#include "report/history.hpp"
#include "studies/change_report.hpp"
#include "studies/study.hpp"

namespace demecal {
namespace {

using ::testing::ContainerEq;
using ::testing::IsEmpty;
using Json = nlohmann::ordered_json;

const std::filesystem::path kSources = DEMECAL_SOURCE_DIR;

/// What the page calls the keys of objects whose keys are names.
using NamedObjects = std::map<std::string, std::string>;

/// Every key of the document as a path.
std::set<std::string> paths_of(const Json& json, const NamedObjects& named, const std::string& path = "") {
  std::set<std::string> paths;
  if (json.is_array()) {
    for (const Json& item : json) paths.merge(paths_of(item, named, path + "[]"));
  }
  if (!json.is_object()) return paths;
  for (const auto& [key, value] : json.items()) {
    const auto name = named.find(path);
    const std::string child = (path.empty() ? "" : path + '.') + (name == named.end() ? key : name->second);
    paths.insert(child);
    paths.merge(paths_of(value, named, child));
  }
  return paths;
}

void expect_json(const std::string& title, const std::vector<std::string>& texts, const NamedObjects& named = {}) {
  std::set<std::string> paths;
  for (const std::string& text : texts) paths.merge(paths_of(Json::parse(text), named));
  expect_documented(formats_section(title), paths);
}

/// Expects the page to have these columns; those with the number of a joint or an anchor have N there.
void expect_columns(const std::string& title, const std::vector<std::string>& tables) {
  static const std::regex number("^([qsl]|torque)[0-9]+");
  std::set<std::string> columns;
  for (const std::string& table : tables) {
    std::istringstream text(table);
    for (const std::string& name : read_csv(text, title).columns)
      columns.insert(std::regex_replace(name, number, "$1N"));
  }
  EXPECT_THAT(formats_section(title).keys(), ContainerEq(columns)) << title;
}

TEST(WrittenFormats, ReportHasTheKeysOfThePage) {
  NamedObjects named{{"rounds[].interval", "NAME"}};
  for (const char* effect : {"rounds[].effect", "rounds[].rivals[]", "dropped[]", "not_found[]"})
    for (const char* numbers : {".parameters", ".standard_errors"}) named[std::string(effect) + numbers] = "NAME";
  expect_json("report.json", {to_json(full_report()), to_json(made_up_report())}, named);
}

TEST(WrittenFormats, ReportNamesEveryFinding) {
  const std::set<std::string> named = [] {
    for (const DocumentRow& row : formats_section("report.json").rows) {
      const auto words = code_spans(row.cells.at(1));
      if (row.keys.contains("data_check.findings[].kind")) return std::set<std::string>(words.begin(), words.end());
    }
    return std::set<std::string>();
  }();
  std::set<std::string> kinds;
  for (int kind = 0; kind <= static_cast<int>(FindingKind::other_robot); ++kind)
    kinds.emplace(to_string(static_cast<FindingKind>(kind)));
  EXPECT_THAT(named, ContainerEq(kinds));
}

const UncertaintyEntry kMadeUpUncertainty{{{"numbers of the model", "A", 0.03}}, 0.04, 2.0, 0.08, "from poses"};

TEST(WrittenFormats, EvaluationHasTheKeysOfThePage) {
  Report report = full_report();
  for (PoseErrorEntry& pose : report.pose_errors) pose.place = {};  // evaluate says no more than the errors
  Evaluation evaluation{report.after, report.pose_errors, report.data_check, {}, report.prediction_interval};
  evaluation.effects_not_applied = {{"backlash", 2, "approach", 30, "It cannot be applied."}};
  evaluation.uncertainty = kMadeUpUncertainty;
  evaluation.length_errors = report.length_errors;
  evaluation.touches = true;
  evaluation.orientations_judged = false;
  expect_json("evaluate --json", {to_json(evaluation)});
}

/// Two cells with one seed each.
Study one_run_a_cell() {
  Study study;
  study.keys = {"gp.population_size"};
  study.cells = {{"100"}, {"300"}};
  study.seeds = {1};
  for (const std::size_t cell : {0u, 1u}) {
    StudyRun run;
    run.cell = cell;
    run.calibration_mm = run.validation_mm = run.accept_mm = 0.2;
    study.runs.push_back(run);
  }
  study.blocks.push_back({parse("SIN(theta)"), 2, 3, 4, 0.5});
  return study;
}

TEST(WrittenFormats, StudyHasTheKeysAndColumnsOfThePage) {
  const Study study = one_run_a_cell();
  expect_json("study.json", {to_json(study)}, {{"cells[].parameters", "KEY"}});
  const std::string table = study_csv(study), key = study.keys.front();
  expect_columns("study.csv", {std::string(table).replace(table.find(key), key.size(), "KEY")});
}

TEST(WrittenFormats, ComparisonHasTheKeysOfThePage) {
  Comparison comparison;
  comparison.methods.resize(1);
  expect_json("comparison.json", {to_json(comparison)});
}

TEST(WrittenFormats, CertificateHasTheKeysOfThePage) {
  Certificate certificate;
  certificate.uncertainty = kMadeUpUncertainty;
  certificate.conditions.resize(1);
  certificate.characteristics.resize(1);
  certificate.poses.resize(1);
  expect_json("certify --json", {to_json(certificate)});
}

TEST(WrittenFormats, PosesHaveTheColumnsOfThePage) {
  Report arms = full_report(), sliding = arms;
  sliding.arm->joints.front().type = "prismatic";
  expect_columns("pose-errors.csv", {pose_errors_csv(arms), pose_errors_csv(sliding)});
}

TEST(WrittenFormats, HistoriesHaveTheColumnsOfThePage) {
  expect_columns("history.csv", {history_csv(made_up_history(1, 1, 1))});
  expect_columns("check-history.csv", {check_history_csv({CheckRecord{}})});
  expect_columns("fronts.csv", {fronts_csv({EvolvedCorrection{}})});
  expect_columns("distal.csv", {distal_csv(*full_report().distal)});
}

TEST(WrittenFormats, EventsHaveTheKeysOfThePage) {
  std::vector<Message> messages = made_up_messages(made_up_data());
  messages.emplace_back(WorkerLost{"cell-a"});
  messages.emplace_back(Control{kRun, Control::State::finished, "note"});
  messages.emplace_back(CalibrationLost{kCalibration});
  for (const Message& found : made_up_findings()) messages.push_back(found);
  std::vector<std::string> lines{first_event_line()};
  for (const Message& message : messages) lines.push_back(event_line(message, 1.0));
  std::set<std::string> paths;
  for (const std::string& line : lines) {
    const Json json = Json::parse(line);
    for (const std::string& key : paths_of(json, {})) paths.insert(json.at("event").get<std::string>() + '.' + key);
  }
  expect_documented(formats_section("Events"), paths);
}

TEST(WrittenFormats, DataSetsHaveTheColumnsOfThePage) {
  const ExampleFolder examples;
  DataSet data = load_data_set(examples.path() / "dataset.yaml");
  const TemporaryFolder written;
  write_data_set(data, written.path(), "a test");
  expect_columns("Pose CSV", {read_file(written.path() / "poses.csv")});
  const Stop stop(data.poses.front());
  const std::string proposed = proposed_poses_csv(examples.path() / "dataset.yaml", data, {stop});
  expect_columns("proposed.csv", {proposed});
}

TEST(WrittenFormats, PreparationsHaveTheKeysAndColumnsOfThePage) {
  const ExampleFolder examples;
  const RawMeasurements raw = load_preparation(examples.path() / "preparation.yaml");
  const Prepared prepared = prepare_measurements(raw);
  const std::string statistic = statistic_json(error_statistic(raw, prepared), raw.name, "best_fit", {"dataset.yaml"});
  expect_json("prepare --json", {statistic}, {{"sets", "SET"}});
  expect_columns("errors.csv", {errors_file(prepared, FrameKind::best_fit).text});
}

TEST(WrittenFormats, FalseTargetsOutsideProgramsHaveTheColumnsOfThePage) {
  const ExampleFolder examples;
  RawMeasurements raw = load_preparation(examples.path() / "preparation.yaml");
  Prepared prepared = prepare_measurements(raw);
  for (PreparedPose& pose : prepared.poses) pose.pose_target.reset();
  const std::vector<WrittenFile> files = false_targets(raw, prepared, FrameKind::best_fit);
  ASSERT_EQ(files.size(), 1u);
  EXPECT_EQ(files.front().name, "corrected.csv");
  expect_columns("corrected.csv", {files.front().text});
}

/// The summary of a program of one target, corrected by an arm that is off by little.
std::string summary_of(const std::string& program, const Robot& nominal, const CommandModel& model,
                       const JointVector& near) {
  CorrectedProgram corrected = correct_program(
      program, read_program(WrittenIn::csv, program, "program.csv", nominal.chain), model, {.near = near});
  EXPECT_FALSE(corrected.targets.at(0).is_uncorrected()) << program;
  corrected.targets.front().error95_m = 1e-4;
  corrected.warnings.push_back({kWholeProgram, "", "a warning"});
  return summary_json(corrected, nominal.chain);
}

TEST(WrittenFormats, CorrectedProgramsHaveTheKeysOfThePage) {
  RandomStream stream{1602};
  const Robot nominal = elbow_arm(stream);
  const CommandModel model = neutral_model(stream, nominal);
  const JointVector joints = regular_joints(stream, nominal.chain);
  const Eigen::Isometry3d tool = model.nominal_tool(joints);
  const Eigen::Quaterniond turn(tool.linear());
  std::ostringstream angles, pose;
  angles.precision(12);
  pose.precision(12);
  angles << "q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad,payload_kg\n";
  for (Eigen::Index i = 0; i < 6; ++i) angles << joints[i] << ',';
  angles << "0.5";
  pose << "x_m,y_m,z_m,qw,qx,qy,qz\n";
  for (const double coordinate : tool.translation()) pose << coordinate << ',';
  pose << turn.w() << ',' << turn.x() << ',' << turn.y() << ',' << turn.z();
  expect_json("apply --json", {summary_of(angles.str() + '\n', nominal, model, joints),
                               summary_of(pose.str() + '\n', nominal, model, joints)});
}

/// What the first part of the expression is in every match, over the sources of the rooms and of the programs.
std::set<std::string> in_sources(const std::regex& expression) {
  std::set<std::string> found;
  for (const char* part : {"common", "coordinator"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kSources / part)) {
      if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
      const std::string text = read_file(entry.path());
      for (std::sregex_iterator match(text.begin(), text.end(), expression), end; match != end; ++match) {
        found.insert((*match)[1].str());
      }
    }
  }
  return found;
}

TEST(WrittenFormats, PageHasTheFilesThatTheSourcesName) {
  static const std::regex name("\"/?([a-z][a-z-]*\\.(?:csv|jsonl?|yaml|html|journal|v2|pdf|xml)|\\.demecal-files)\"");
  EXPECT_THAT(formats_section("Files").keys(), ContainerEq(in_sources(name)));
}

TEST(WrittenFormats, PageHasTheExitCodes) {
  static const std::regex code("= ([0-9]+)");
  const std::string text = read_file(kSources / "coordinator/commands.hpp");
  std::set<std::string> codes;
  for (std::sregex_iterator match(text.begin(), text.end(), code), end; match != end; ++match) {
    codes.insert((*match)[1].str());
  }
  EXPECT_THAT(formats_section("Exit codes").keys(), ContainerEq(codes));
}

TEST(WrittenFormats, PageHasTheColumnsOfReadings) {
  static const std::regex name("\"([a-z_]+)\"");
  const std::string text = read_file(kSources / "common/preparation/readings.cpp");
  const std::string lists = text.substr(0, text.find("kind_of("));
  std::set<std::string> columns;
  for (std::sregex_iterator match(lists.begin(), lists.end(), name), end; match != end; ++match) {
    columns.insert((*match)[1].str());
  }
  EXPECT_THAT(formats_section("Readings CSV").keys(), ContainerEq(columns));
}

TEST(WrittenFormats, ProgramsAreReadFromTheColumnsOfThePage) {
  const ExampleFolder examples;
  const Chain arm = load_data_set(examples.path() / "dataset.yaml").robot.chain;
  const std::vector<std::string> tables{
      "name,q1_deg,q2_mm,s1,s2,payload_kg,temperature_celsius,time_s\nP1,1,2,1,-1,3,21,5\n",
      "pose_id,q1_rad,q2_m\nP1,1,0.2\n", "id,x_mm,y_mm,z_mm,qw,qx,qy,qz\nP1,1,2,3,1,0,0,0\n", "x_m,y_m,z_m\n1,2,3\n"};
  std::vector<Target> targets;
  for (const std::string& table : tables)
    targets.push_back(read_program(WrittenIn::csv, table, "p.csv", arm).targets.at(0));
  EXPECT_TRUE(targets[0].approach && targets[0].payload_kg && targets[0].temperature_celsius && targets[0].time_s);
  for (const std::size_t i : {0u, 1u, 2u}) EXPECT_EQ(targets[i].name, "P1");
  for (const std::size_t i : {0u, 1u}) EXPECT_EQ(targets[i].joints.size(), 2u);
  for (const std::size_t i : {2u, 3u}) EXPECT_EQ(targets[i].position.size(), 3u);
  EXPECT_EQ(targets[2].orientation.size(), 4u);
  expect_columns("Program CSV", tables);
}

}  // namespace
}  // namespace demecal

// docs/FORMATS.md names the keys of plan.json, of what `check --json` and `prepare --log --json` print, and the columns
// of standstills.csv; a plan's files are read back.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "config/job_file.hpp"
#include "data/csv.hpp"
#include "data_files/data_set_file.hpp"
#include "data_files/robot_file.hpp"
#include "drafting/planned_files.hpp"
#include "formats_document.hpp"
#include "made_up_recording.hpp"
#include "studies/change_report.hpp"
#include "studies/plan_report.hpp"
#include "temporary_folder.hpp"

namespace demecal {
namespace {

using Json = nlohmann::ordered_json;

std::set<std::string> all_paths(const Json& json, const std::string& path = "") {
  std::set<std::string> paths;
  if (json.is_array())
    for (const Json& item : json) paths.merge(all_paths(item, path + "[]"));
  if (!json.is_object()) return paths;
  for (const auto& [key, value] : json.items()) {
    const std::string child = (path.empty() ? "" : path + '.') + key;
    paths.insert(child);
    paths.merge(all_paths(value, child));
  }
  return paths;
}

PlanRequest small_request() {
  PlanRequest request;
  request.robot = load_robot(std::string(DEMECAL_SOURCE_DIR) + "/configs/robots/puma761.yaml");
  request.poses = 14;
  request.validation = 3;
  request.accept = 3;
  for (const EffectLaw* law : catalogue())
    if (law->prerequisite() == Circumstance::approach && request.detect.empty())
      request.detect.emplace_back(law->kind());
  return request;
}

PlanRequest small_request_of_sockets() {
  PlanRequest request = small_request();
  request.places = 1;
  request.cell = assumed_cell_of_sockets(request.robot);
  request.cell->sockets.length_m = 0.05;
  return request;
}

TEST(PlannedFormats, PlanHasTheKeysOfThePage) {
  const PlanRequest request = small_request();
  Plan plan = make_plan(request);
  plan.refused.fill(1);
  const PlanRequest of_sockets = small_request_of_sockets();
  std::set<std::string> paths = all_paths(Json::parse(to_json(plan, request, {"a"})));
  paths.merge(all_paths(Json::parse(to_json(make_plan(of_sockets), of_sockets, {"a"}))));
  expect_documented(formats_section("plan.json"), paths);
}

TEST(PlannedFormats, CheckHasTheKeysOfThePage) {
  ChangeReport change;
  ChangeCause cause;
  for (const EffectLaw* law : catalogue())
    if (law->subject() == Subject::tool) cause.effect = law->proposals(small_request().robot, {}).front();
  cause.effect.values.assign(law_of(cause.effect).coefficients(cause.effect, small_request().robot).size(), 0.0);
  cause.unit = "rad";
  change.found = change.tried = {cause};
  DataSet data;
  data.robot = small_request().robot;
  expect_documented(formats_section("check --json"), all_paths(Json::parse(to_json(change, data, "model.yaml"))));
}

TEST(RecordedFormats, AreThoseOfThePage) {
  const auto [json, standstills] = made_up_recording();
  expect_documented(formats_section("prepare --log --json"), all_paths(Json::parse(json)));
  std::istringstream text(standstills);
  const std::vector<std::string> columns = read_csv(text, "standstills.csv").columns;
  EXPECT_EQ(formats_section("standstills.csv").keys(), std::set<std::string>(columns.begin(), columns.end()));
}

TEST(PlannedFormats, FilesOfAPlanAreReadBackOnceWhatIsMeasuredIsThere) {
  const PlanRequest request = small_request();
  const Plan plan = make_plan(request);
  const TemporaryFolder folder;
  std::istringstream poses(planned_poses_csv(plan, request));
  std::string measured, line;
  for (bool heading = true; std::getline(poses, line); heading = false)
    measured += line + (heading ? ",x_mm,y_mm,z_mm\n" : ",1,2,3\n");
  folder.write("poses.csv", measured);
  folder.write("robot.yaml", "demecal_robot: 1\n" + robot_text(request.robot));
  folder.write("DATASET.yaml", planned_data_set_text(plan, request));
  folder.write("JOB.yaml", planned_job_text(request));
  const DataSet data = load_data_set(folder.path() / "DATASET.yaml");
  ASSERT_EQ(data.poses.size(), plan.stops.size());
  for (std::size_t i = 0; i < data.poses.size(); ++i) {
    EXPECT_EQ(data.poses[i].set, plan.stops[i].set);
    EXPECT_NEAR((data.poses[i].joints - plan.stops[i].pose.joints).norm(), 0.0, 1e-9);
    EXPECT_EQ(*data.poses[i].approach, plan.stops[i].pose.approach);
  }
  EXPECT_EQ(poses_of(data, PoseSet::calibration).size(), 14u);
  EXPECT_EQ(load_job(folder.path() / "JOB.yaml").declared, request.declared);
}

TEST(PlannedFormats, JobOfAPlanThatGoesOnFitsBothDataSets) {
  const TemporaryFolder folder;
  folder.write("JOB.yaml", planned_job_text(small_request(), "../first: half/DATASET.yaml"));
  folder.write("DATASET.yaml", "");
  const Job job = load_job(folder.path() / "JOB.yaml");
  ASSERT_EQ(job.data_files.size(), 2u);
  EXPECT_EQ(std::filesystem::path(job.data_files[0]).lexically_normal(),
            (folder.path() / "../first: half/DATASET.yaml").lexically_normal());
  EXPECT_EQ(std::filesystem::path(job.data_files[1]).filename(), "DATASET.yaml");
}

TEST(PlannedFormats, FilesOfAPlanOfSocketsAreReadAsTheyAre) {
  const PlanRequest request = small_request_of_sockets();
  const Plan plan = make_plan(request);
  const TemporaryFolder folder;
  folder.write("poses.csv", planned_poses_csv(plan, request));
  folder.write("robot.yaml", "demecal_robot: 1\n" + robot_text(request.robot));
  folder.write("DATASET.yaml", planned_data_set_text(plan, request));
  const DataSet data = load_data_set(folder.path() / "DATASET.yaml");
  ASSERT_EQ(data.poses.size(), plan.stops.size());
  for (std::size_t i = 0; i < data.poses.size(); ++i) {
    EXPECT_EQ(data.poses[i].contact, plan.sockets[*plan.stops[i].pose.socket].name);
    EXPECT_FALSE(data.poses[i].position_m);
  }
  ASSERT_EQ(data.contacts.distances.size(), plan.lengths.size());
  EXPECT_NEAR(data.contacts.distances.front().length_m, 0.05, 1e-12);
}

}  // namespace
}  // namespace demecal

// demecal prepare: raw measurements in, a data set out that the other commands take, and nothing where something is
// wrong.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <sstream>

#include "data/csv.hpp"
#include "data/text.hpp"
#include "program.hpp"
#include "random/random_stream.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

using Json = nlohmann::json;

const std::string kShipped = std::string(DEMECAL_SOURCE_DIR) + "/configs/preparation/puma761-cords.yaml";

Ended prepare(const std::string& file, const std::string& out, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{"prepare", file, "--out", out};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run("demecal", arguments);
}

TEST(Prepare, LeadsToADataSetThatIsDiagnosedAndEvaluated) {
  const SmallJob job;
  const Ended prepared = prepare(kShipped, job.path("prepared"));
  ASSERT_EQ(prepared.code, 0) << prepared.err;
  EXPECT_NE(prepared.out.find("three-point frame"), std::string::npos) << prepared.out;
  EXPECT_EQ(prepared.err, "");
  for (const char* file :
       {"dataset.yaml", "poses.csv", "robot.yaml", "corrected.v2", "corrected-validation.v2", "errors.csv"}) {
    EXPECT_FALSE(job.text(std::string("prepared/") + file).empty()) << file;
  }
  const Ended diagnosed =
      run("demecal", {"diagnose", job.path("prepared/dataset.yaml"), "--declare", "registration,joint_offset",
                      "--candidates", "gain", "--out", job.path("model")});
  ASSERT_EQ(diagnosed.code, 0) << diagnosed.err;
  const Ended evaluated =
      run("demecal", {"evaluate", job.path("model/model.yaml"), job.path("prepared/dataset.yaml"), "--json"});
  ASSERT_EQ(evaluated.code, 0) << evaluated.err;
  const Ended json = prepare(kShipped, job.path("again"), {"--json", "--frame", "best_fit"});
  ASSERT_EQ(json.code, 0) << json.err;
  const Json statistic = Json::parse(json.out);
  EXPECT_EQ(statistic["frame"], "best_fit");
  EXPECT_EQ(statistic["sets"]["calibration"]["poses"], 24);
  const Json errors = Json::parse(evaluated.out)["error_mm"]["calibration"];
  EXPECT_LT(errors["rms"], statistic["sets"]["calibration"]["best_fit"]["rms"]);
}

TEST(Prepare, WritesNothingWhereSomethingIsWrong) {
  const SmallJob job;
  std::ofstream(job.path("broken.yaml")) << "# broken\ndemecal_preparation: 1\nrobots: none\n";
  const Ended broken = prepare(job.path("broken.yaml"), job.path("broken"));
  EXPECT_EQ(broken.code, 11);
  EXPECT_NE(broken.err.find("broken.yaml:3: 'robots': is no key; the nearest is 'robot'"), std::string::npos)
      << broken.err;
  EXPECT_FALSE(std::filesystem::exists(job.path("broken")));
  EXPECT_EQ(prepare(kShipped, job.path("frame"), {"--frame", "flange"}).code, 10);
}

/// The poses of a set of a simulated data set in their order, as if their joints had been logged while the arm, which
/// comes from `before`, went from one to the next and stood a second at each; halfway to every seventh it rests.
class LoggedPoses {
 public:
  explicit LoggedPoses(const std::string& poses) {
    std::istringstream text(poses);
    table_ = read_csv(text, "poses.csv");
    for (std::size_t joint = 1; joint <= 6; ++joint)
      columns_.push_back(*table_.find("q" + std::to_string(joint) + "_deg"));
  }

  std::string log(const std::set<std::string>& sets) {
    text_ = "time_s,joint_1,joint_2,joint_3,joint_4,joint_5,joint_6\n";
    time_s_ = 0.0;
    std::size_t count = 0;
    for (const CsvRow& row : table_.rows) {
      std::vector<double> joints;
      for (const std::size_t column : columns_) joints.push_back(std::stod(row.fields[column]));
      if (sets.contains(row.fields[*table_.find("set")])) {
        if (at_.empty()) at_ = joints;
        if (++count % 7 == 0) rest_halfway(joints);
        move(joints, 1.5);
        stand(1.0);
      }
      at_ = joints;
    }
    return text_;
  }

 private:
  void rest_halfway(const std::vector<double>& to) {
    std::vector<double> half = to;
    for (std::size_t i = 0; i < half.size(); ++i) half[i] = 0.5 * (at_[i] + to[i]);
    move(half, 1.0);
    stand(0.8);
  }
  void move(const std::vector<double>& to, double duration_s) {
    const std::vector<double> from = at_;
    for (double passed_s = 0.0; passed_s < duration_s; passed_s += kStep_s) {
      const double share = 0.5 - 0.5 * std::cos(std::numbers::pi * passed_s / duration_s);
      for (std::size_t i = 0; i < to.size(); ++i) at_[i] = from[i] + (to[i] - from[i]) * share;
      row();
    }
    at_ = to;
  }
  void stand(double duration_s) {
    for (double passed_s = 0.0; passed_s < duration_s; passed_s += kStep_s) row();
  }
  void row() {
    text_ += number_text(time_s_);
    for (const double joint : at_) text_ += "," + number_text(joint + 1e-3 * random_.normal());
    text_ += "\n";
    time_s_ += kStep_s;
  }

  static constexpr double kStep_s = 0.02;
  CsvTable table_;
  std::vector<std::size_t> columns_;
  std::vector<double> at_;
  std::string text_;
  double time_s_ = 0.0;
  RandomStream random_{4141};
};

TEST(Prepare, FindsTheContactsOfRecordingsSoThatTheCauseBehindThemIsNamed) {
  const SmallJob job;
  const std::string scenario = std::string(DEMECAL_SOURCE_DIR) + "/configs/scenarios/sockets.yaml";
  ASSERT_EQ(run("demecal", {"simulate", scenario, "--out", job.path("touched")}).code, 0);
  LoggedPoses poses(job.text("touched/poses.csv"));
  std::ofstream(job.path("touched/log.csv")) << poses.log({"calibration", "validation"});
  std::ofstream(job.path("touched/accept.csv")) << poses.log({"accept"});
  std::ofstream(job.path("touched/prep.yaml"))
      << "demecal_preparation: 1\nrobot: robot.yaml\nlog:\n  files: [log.csv, {file: accept.csv, set: accept}]\n"
         "  distances: [{between: [A, B], mm: 50, sigma_mm: 0.02}, {between: [C, D], mm: 50, sigma_mm: 0.02}]\n";
  const Ended prepared = prepare(job.path("touched/prep.yaml"), job.path("prepared"), {"--json"});
  ASSERT_EQ(prepared.code, 0) << prepared.err;
  const Json found = Json::parse(prepared.out);
  EXPECT_EQ(found["standstills"]["touches"], 108);
  EXPECT_EQ(found["standstills"]["too_short"], 0);
  ASSERT_EQ(found["contacts"].size(), 6u);
  const Ended diagnosed =
      run("demecal", {"diagnose", job.path("prepared/dataset.yaml"), "--declare", "tool,joint_offset,geometry",
                      "--candidates", "backlash,gain,compliance", "--out", job.path("model")});
  ASSERT_EQ(diagnosed.code, 0) << diagnosed.err;
  const Json report = Json::parse(job.text("model/report.json"));
  EXPECT_EQ(report["rounds"][0]["effect"]["kind"], "backlash");
  EXPECT_EQ(report["rounds"][0]["effect"]["joint"], 2);
  EXPECT_LT(report["error_mm"]["after"]["accept"]["rms"], 0.15);

  const std::string robot = job.path("touched/robot.yaml"), log = job.path("touched/log.csv");
  const Ended direct = run("demecal", {"prepare", "--log", log, "--robot", robot, "--out", job.path("direct")});
  ASSERT_EQ(direct.code, 0) << direct.err;
  EXPECT_NE(direct.out.find("log: 84 poses at 4 contacts"), std::string::npos) << direct.out;
  EXPECT_EQ(run("demecal", {"prepare", "--log", log, "--out", job.path("no-robot")}).code, 10);
  EXPECT_EQ(run("demecal", {"prepare", "--out", job.path("nothing")}).code, 10);
  EXPECT_EQ(prepare(job.path("touched/prep.yaml"), job.path("frame"), {"--frame", "best_fit"}).code, 10);
}

}  // namespace
}  // namespace demecal

#include <array>

#include "../config/sample_files.hpp"
#include "../config/temporary_folder.hpp"
#include "config/job_file.hpp"
#include "config/model_file.hpp"
#include "config/scenario_file.hpp"
#include "data_files/data_set_file.hpp"
#include "data_files/robot_file.hpp"
#include "drafting/preparation_file.hpp"
#include "drafting/templates.hpp"
#include "errors/input_error.hpp"
#include "targets.hpp"

namespace demecal::fuzz {
namespace {

const TemporaryFolder& folder() {
  static const TemporaryFolder one;
  return one;
}

/// Files may be refused in words.
template <class Load>
std::function<void(std::string_view)> reader(const std::string& name, Load load) {
  return [name, load](std::string_view bytes) {
    folder().write("robot.yaml", kRobotText);
    try {
      load(folder().write(name, std::string(bytes)));
    } catch (const InputError&) {
    }
  };
}

constexpr std::string_view kNextFile = "\n# next file\n";

/// Writes files that follow each other in the bytes.
void write_files(std::string_view bytes, const std::vector<std::string>& names) {
  folder().write("robot.yaml", kRobotText);
  for (const std::string& name : names) {
    const std::size_t size = std::min(bytes.size(), bytes.find(kNextFile));
    folder().write(name, std::string(bytes.substr(0, size)));
    bytes.remove_prefix(std::min(bytes.size(), size + kNextFile.size()));
  }
}

void read_data_set(std::string_view bytes) {
  write_files(bytes, {"dataset.yaml", "robot.yaml", "poses.csv"});
  try {
    load_data_set(folder().path() / "dataset.yaml");
  } catch (const InputError&) {
  }
}

const std::vector<std::string> kPreparation{"preparation.yaml", "calibration.csv", "calibration.v2", "validation.csv",
                                            "validation.v2",    "local-frame.csv", "local-frame.v2"};

void read_preparation(std::string_view bytes) {
  write_files(bytes, kPreparation);
  try {
    load_preparation(folder().path() / kPreparation.front());
  } catch (const InputError&) {
  }
}

void read_matrices(const std::filesystem::path& path) {
  Algebra algebra;
  load_matrices(algebra, path);
}

void read_urdf(const std::filesystem::path& path) {
  const ImportedRobot imported = import_urdf({path, std::nullopt, std::nullopt, folder().path() / "imported.yaml"});
  load_robot(folder().write("imported.yaml", imported.text));
}

void read_model(const std::filesystem::path& path) {
  const CalibratedModel model = load_model(path);
  load_model(folder().write("again.yaml", model_text(model)));
}

std::string shipped(const std::string& path) {
  return read_file(std::string(DEMECAL_SOURCE_DIR) + "/" + path);
}

std::string shipped_preparation() {
  std::string all = shipped("configs/preparation/puma761-cords.yaml");
  const std::string robot = "../robots/puma761.yaml";
  all.replace(all.find(robot), robot.size(), "robot.yaml");
  for (std::size_t i = 1; i < kPreparation.size(); ++i)
    all += std::string(kNextFile) + shipped("configs/preparation/" + kPreparation[i]);
  return all;
}

/// Joined by the times of day of one table, which passes midnight.
const std::string kJoinedByTime =
                      "demecal_dataset: 1\nrobot: robot.yaml\nposes:\n"
                      "  - {file: poses.csv, columns: {joints: [q1_deg, q2_mm], time: t}}\n"
                      "  - {file: poses.csv, columns: {position: [x_mm, y_mm, z_mm], time: t}}\n"
                      "join: {by: time, within_s: 5}\n",
                  kOverMidnight =
                      "t;q1_deg;q2_mm;x_mm;y_mm;z_mm\n11:59:59.5 PM;1;2;3;4;5,5\n"
                      "12:00:10 AM;2;3;4;5;6,5\n";

}  // namespace

std::vector<Target> file_targets() {
  const std::string files = kDataSetText + std::string(kNextFile) + kRobotText + std::string(kNextFile) + kPosesText,
                    joined =
                        kJoinedByTime + std::string(kNextFile) + kRobotText + std::string(kNextFile) + kOverMidnight;
  return {{"robot", {kRobotText, shipped("configs/robots/ur10.yaml")}, reader("one.yaml", load_robot)},
          {"job", {kJobText, shipped("configs/jobs/demo.yaml")}, reader("job.yaml", load_job)},
          {"data_set", {files, joined}, read_data_set},
          {"scenario", {kScenarioText, shipped("configs/scenarios/demo.yaml")}, reader("scenario.yaml", load_scenario)},
          {"preparation", {shipped_preparation()}, read_preparation},
          {"frames",
           {"demecal_frames: 1\nframes: {1: {xyz_mm: [1, 2, 3], abc_deg: [4, 5, 6]}}\n"
            "tools: {grip: {xyz_mm: [0, 0, 150], quaternion_wxyz: [1, 0, 0, 0]}}\n"},
           reader("frames.yaml", load_frames)},
          {"matrices", {shipped("configs/matrices/puma761.yaml")}, reader("matrices.yaml", read_matrices)},
          {"grid", {shipped("configs/grids/search.yaml")}, reader("grid.yaml", load_grid)},
          {"urdf",
           {shipped("tests/fuzz/seeds/arm.urdf"), shipped("tests/fuzz/seeds/arm.sdf")},
           reader("arm.urdf", read_urdf)},
          {"model",
           {shipped("tests/fuzz/seeds/model.yaml"), shipped("tests/fuzz/seeds/sharing-model.yaml")},
           reader("model.yaml", read_model)}};
}

}  // namespace demecal::fuzz

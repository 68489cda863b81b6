#include "small_job.hpp"

#include <stdlib.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "program.hpp"

namespace demecal {
namespace {

constexpr const char* kScenario = R"yaml(# A PUMA 761 with smooth joint errors
demecal_scenario: 1
name: small
robot: ROBOT
seed: 5
poses: {calibration: 40, validation: 30, accept: 10}
cuboid: {corner_mm: [432, 490, -675], size_mm: [844, 582, 1151], orientation_spread_deg: 25}
home: {q1_deg: 35, q2_deg: -35, q3_deg: 150, q4_deg: 0, q5_deg: -60, q6_deg: 0}
measurement:
  sensor_from_base: {translation_mm: [1850, -640, 420], rotation_deg: [4, -7, 115]}
  noise_mm: 0.05
errors:
  joint_errors:
    - {joint: 1, formula: "0.004 * SIN(2 * theta - 1.2)"}
    - {joint: 2, formula: "0.002 * COS(2 * theta + 0.3)"}
    - {joint: 3, formula: "0.0035 * SIN(2 * theta - 0.5)"}
)yaml";

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path) << text;
}

}  // namespace

SmallJob::SmallJob(int generations, int demes, const std::string& errors) {
  char name[] = "/tmp/demecal-job-XXXXXX";
  if (::mkdtemp(name) == nullptr) throw std::runtime_error("no scratch folder");
  folder_ = name;
  std::string scenario = kScenario;
  scenario.replace(scenario.find("ROBOT"), 5, std::string(DEMECAL_SOURCE_DIR) + "/configs/robots/puma761.yaml");
  scenario += errors;
  write(folder_ / "scenario.yaml", scenario);
  write(folder_ / "job.yaml",
        "# A short evolution\ndemecal_job: 1\ndata: data/dataset.yaml\nmethod: direct\nseed: 3\n"
        "model: {declared: [registration, joint_corrections]}\n"
        "gp: {population_size: 60, number_generations: " +
            std::to_string(generations) + "}\nislands: {per_joint: " + std::to_string(demes) +
            ", topology: ring, migration_interval: 5, migrants: 2}\n");
  const Ended simulated = run("demecal", {"simulate", path("scenario.yaml"), "--out", path("data")});
  if (simulated.code != 0) throw std::runtime_error("no data: " + simulated.err);
}

SmallJob::~SmallJob() {
  std::filesystem::remove_all(folder_);
}

std::string SmallJob::text(const std::string& name) const {
  std::ifstream file(folder_ / name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace demecal

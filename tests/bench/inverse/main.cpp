// How long the inverse that `export --format c` writes takes, and what it leaves: on a million random poses of arms
// with wrong links and uneven gears.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "data_files/robot_file.hpp"
#include "prediction/corrected_arm.hpp"
#include "random/random_stream.hpp"
#include "symbolic/code.hpp"

namespace {

using namespace demecal;

/// The arm as it might be calibrated: a millimetre and a milliradian in every link, three harmonics in every gear.
CorrectedRobot calibrated(const Robot& robot, RandomStream& random) {
  DataSet none;
  none.robot = robot;
  CorrectedRobot arm = nominal_robot(none);
  for (Joint& joint : arm.chain.joints) {
    joint.theta_rad += 1e-3 * random.normal();
    joint.alpha_rad += 1e-3 * random.normal();
    joint.a_m += 1e-3 * random.normal();
    joint.d_m += 1e-3 * random.normal();
  }
  for (int joint = 0; joint < robot.chain.size(); ++joint)
    for (const double ratio : {1.0, 2.0, 50.0})
      arm.effects.push_back({.kind = "gear_harmonic",
                             .joint = joint,
                             .settings = {{"ratio", ratio}},
                             .values = {1e-4 * random.normal(), 1e-4 * random.normal()}});
  return arm;
}

/// Draws joints and corrects them; then finds the joints at which the tool stands where the described arm's would.
/// Prints of either: seconds, how many were not reached, the largest residual of the others.
std::string driver(const Chain& chain, long poses) {
  std::string lower, upper;
  for (const Joint& joint : chain.joints) {
    lower += fmt::format("{:.17g},", joint.lower);
    upper += fmt::format("{:.17g},", joint.upper);
  }
  return fmt::format(R"code(
#include <stdio.h>
#include <time.h>
static unsigned long long state = 88172645463325252ULL;
static double drawn(void) {{
  state ^= state << 13; state ^= state >> 7; state ^= state << 17;
  return (double)(state >> 11)/9007199254740992.0;
}}
int main(void) {{
  static const double lower[] = {{{}}}, upper[] = {{{}}};
  const struct circumstances none = {{0}};
  long missed[2] = {{0, 0}};
  double largest[2] = {{0.0, 0.0}}, seconds[2] = {{0.0, 0.0}};
  for (long i = 0; i < {}; i += 1000) {{
    static double nominal[1000][N], goal[1000][16], command[1000][N];
    for (int k = 0; k < 1000; ++k) {{
      for (int j = 0; j < N; ++j) nominal[k][j] = lower[j] + (upper[j] - lower[j])*drawn();
      nominal_forward(&none, nominal[k], goal[k]);
    }}
    for (int way = 0; way < 2; ++way) {{
      for (int k = 0; k < 1000; ++k)
        for (int j = 0; j < N; ++j) command[k][j] = nominal[k][j];
      const clock_t begin = clock();
      for (int k = 0; k < 1000; ++k) {{
        const double left = way == 0 ? corrected(nominal[k], command[k]) : inverse(goal[k], command[k]);
        if (left > 1e-6) ++missed[way]; else if (left > largest[way]) largest[way] = left;
      }}
      seconds[way] += (double)(clock() - begin)/CLOCKS_PER_SEC;
    }}
  }}
  for (int way = 0; way < 2; ++way) printf("%.6f %ld %.3g\n", seconds[way], missed[way], largest[way]);
  return 0;
}}
)code",
                     lower, upper, poses);
}

}  // namespace

int main(int argc, char** argv) {
  bool json = false;
  long poses = 1000000;
  CLI::App app{"the exported inverse: microseconds, and what it leaves"};
  app.add_option("--poses", poses, "of each arm")->capture_default_str()->check(CLI::Range(1000L, 100000000L));
  app.add_flag("--json", json, "one JSON object a line");
  CLI11_PARSE(app, argc, argv);
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("demecal-inverse-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  if (!json)
    fmt::print("{:<24} {:<10} {:>8} {:>14} {:>22}\n", "arm", "function", "us", "not reached", "largest residual, um");
  for (const char* name : {"ur10", "kuka-kr6-r900-2", "staubli-tx2-60", "kuka-iiwa14"}) {
    const Robot robot = load_robot(std::string(DEMECAL_SOURCE_DIR) + "/configs/robots/" + name + ".yaml");
    RandomStream random{911};
    const CorrectedRobot arm = calibrated(robot, random);
    Algebra algebra;
    const Listing listing = listing_of(corrected_arm(algebra, arm, ""), arm, robot.name);
    const std::string code = code_of(listing, CodeLanguage::c) +
                             inverse_in_c(listing, described_listing(algebra, arm, arm.tool(""))) +
                             driver(robot.chain, poses);
    const std::string program = (folder / "inverse").string();
    std::ofstream(program + ".c") << code;
    if (std::system(fmt::format("cc -std=c99 -O2 -o {0} {0}.c -lm && {0} > {0}.txt", program).c_str()) != 0) return 21;
    std::ifstream figures(program + ".txt");
    for (const char* way : {"corrected", "inverse"}) {
      double seconds = 0.0, largest_m = 0.0;
      long missed = 0;
      figures >> seconds >> missed >> largest_m;
      const double each_us = 1e6 * seconds / static_cast<double>(poses);
      if (json) {
        fmt::print("{}\n", nlohmann::ordered_json{{"workload", "inverse"},
                                                  {"robot", robot.name},
                                                  {"function", way},
                                                  {"poses", poses},
                                                  {"us", each_us},
                                                  {"not_reached", missed},
                                                  {"largest_residual_um", 1e6 * largest_m}}
                               .dump());
      } else {
        fmt::print("{:<24} {:<10} {:>8.2f} {:>14} {:>22.4f}\n", robot.name, way, each_us, missed, 1e6 * largest_m);
      }
    }
  }
  std::filesystem::remove_all(folder);
  return 0;
}

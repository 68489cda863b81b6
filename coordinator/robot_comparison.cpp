#include "coordinator/robot_comparison.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>

#include "data_check/pendant.hpp"
#include "drafting/draft_data_set.hpp"
#include "errors/input_error.hpp"
#include "kinematics/units.hpp"

namespace demecal {
namespace {

void print_comparison_lines(const DataSet& data, const PendantComparison& comparison) {
  fmt::print("{}: {} poses read off the controller; the description is off by {:.3f} mm at most.\n", data.file,
             data.poses.size(), millimetres(*std::ranges::max_element(comparison.errors_m)));
  if (comparison.agrees) {
    fmt::print("It agrees with the controller{}\n",
               comparison.findings.empty() ? "." : ", as far as these poses tell:");
    for (const std::string& finding : comparison.findings) fmt::print("  {}\n", finding);
    return;
  }
  for (const std::string& finding : comparison.findings) fmt::print("  {}\n", finding);
  fmt::print("\n  {:12} {:>10}\n", "pose", "off by, mm");
  for (std::size_t i = 0; i < data.poses.size(); ++i)
    fmt::print("  {:12} {:10.3f}\n", data.poses[i].pose_id, millimetres(comparison.errors_m[i]));
}

std::string comparison_json(const DataSet& data, const PendantComparison& comparison) {
  nlohmann::ordered_json json{{"agrees", comparison.agrees},
                              {"explained", comparison.explained},
                              {"findings", comparison.findings},
                              {"poses", nlohmann::ordered_json::array()}};
  for (std::size_t i = 0; i < data.poses.size(); ++i)
    json["poses"].push_back({{"id", data.poses[i].pose_id}, {"off_by_mm", millimetres(comparison.errors_m[i])}});
  return json.dump();
}

}  // namespace

bool print_comparison(const std::string& poses_file, const Robot& robot, bool json) {
  const DataSet data = read_pendant_poses(poses_file, robot);
  if (data.poses.empty()) throw InputError({poses_file, 0}, "", "holds no poses");
  const PendantComparison comparison = compare_with_pendant(data);
  if (json) {
    fmt::print("{}\n", comparison_json(data, comparison));
  } else {
    print_comparison_lines(data, comparison);
  }
  return comparison.agrees;
}

}  // namespace demecal

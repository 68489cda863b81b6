#include <fmt/format.h>
#include <optional>
#include <string>

#include "data/data_set.hpp"
#include "data/payload.hpp"
#include "data_check/searches.hpp"
#include "trials/finding.hpp"

namespace demecal::inline data_check {

std::optional<Finding> find_implausible_payloads(const DataSet& data) {
  const double most_kg = most_payload_kg(data.robot);
  Finding finding{.kind = FindingKind::implausible_payload};
  const MeasuredPose* heaviest = nullptr;
  for (const MeasuredPose& pose : data.poses) {
    if (pose.payload_kg.value_or(0.0) <= most_kg) continue;
    finding.poses.push_back(pose.pose_id);
    if (heaviest == nullptr || *pose.payload_kg > *heaviest->payload_kg) heaviest = &pose;
  }
  if (heaviest == nullptr) return std::nullopt;
  finding.sentence = fmt::format(
      "{} said to carry up to {:.6g} kg (line {}{}), {}: are these g or lb? Name the column's unit as it is "
      "(`payload_g`), or correct the values: what yields under weight would be found wrong.",
      finding.poses.size() == 1 ? "One pose is" : fmt::format("{} poses are", finding.poses.size()),
      *heaviest->payload_kg, heaviest->line, name_beside_line(*heaviest), above_most_payload(data.robot));
  return finding;
}

}  // namespace demecal::inline data_check

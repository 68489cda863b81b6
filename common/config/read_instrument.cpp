#include "config/read_instrument.hpp"

#include "kinematics/units.hpp"

namespace demecal {
namespace {

Eigen::Vector3d non_negative3(const YamlNode& node) {
  const Eigen::Vector3d values = node.vector3();
  for (const YamlNode& value : node.children) value.non_negative();
  return values;
}

Eigen::Vector3d positive3(const YamlNode& node) {
  const Eigen::Vector3d values = node.vector3();
  for (const YamlNode& value : node.children) value.positive();
  return values;
}

CordCorners read_triangle(const YamlNode& node) {
  node.with_keys({"ab", "bc", "ca"});
  const CordTriangle triangle{metres(node.at("ab").positive()), metres(node.at("bc").positive()),
                              metres(node.at("ca").positive())};
  const auto corners = cord_corners(triangle);
  if (!corners) {
    node.fail(
        node.at("ab").scalar + ", " + node.at("bc").scalar + ", " + node.at("ca").scalar,
        "must be the sides of a triangle that is not as flat as a line: each shorter than the other two together");
  }
  return *corners;
}

void read_encoders(const YamlNode& node, CordInstrument& cords) {
  node.with_keys({"bar_mm", "bar_counts", "counts_per_mm", "zero_counts"});
  const YamlNode* direct = node.find("counts_per_mm");
  const YamlNode* bar = node.find("bar_mm");
  if ((direct != nullptr) == (bar != nullptr)) {
    node.fail("", "must give either bar_mm and bar_counts or counts_per_mm");
  }
  if (direct != nullptr) {
    if (const YamlNode* counts = node.find("bar_counts")) counts->fail("", "belongs to bar_mm, which is not given");
    cords.counts_per_m = 1e3 * positive3(*direct);
  } else {
    cords.counts_per_m = positive3(node.at("bar_counts")) / metres(bar->positive());
  }
  if (const YamlNode* zero = node.find("zero_counts")) cords.zero_counts = zero->vector3();
}

CordInstrument read_cords(const YamlNode& node) {
  node.with_keys({"triangle_mm", "top_cords_mm", "encoders", "side", "standard_error_mm"});
  CordInstrument cords;
  cords.corners = read_triangle(node.at("triangle_mm"));
  if (const YamlNode* top = node.find("top_cords_mm")) cords.top_cords_m = metres(1.0) * non_negative3(*top);
  if (const YamlNode* encoders = node.find("encoders")) read_encoders(*encoders, cords);
  if (const YamlNode* error = node.find("standard_error_mm")) cords.standard_error_m = metres(error->positive());
  cords.side = node.at("side").one_of<PlaneSide>({{"above", PlaneSide::above}, {"below", PlaneSide::below}});
  return cords;
}

}  // namespace

std::optional<CordInstrument> read_instrument(const YamlNode& node) {
  if (node.kind == YamlNode::Kind::scalar) {
    if (node.scalar != "points") node.fail("must be `points` or a map with the key `cords`");
    return std::nullopt;
  }
  return read_cords(node.with_keys({"cords"}).at("cords"));
}

}  // namespace demecal

#include "data_files/link_inertias.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "data/text.hpp"

namespace demecal::inline data_files {

std::optional<Eigen::Matrix3d> read_link_inertia(const YamlNode& link) {
  const YamlNode* const node = link.find("inertia_kgm2");
  if (node == nullptr) return std::nullopt;
  constexpr std::size_t kElements = 6;
  if (node->kind != YamlNode::Kind::list || node->children.size() != kElements)
    node->fail("must be 6 numbers, [ixx, ixy, ixz, iyy, iyz, izz] about the centre of mass in kg m^2");
  std::array<double, kElements> elements{};
  std::ranges::copy(node->numbers(), elements.begin());
  const Eigen::Matrix3d inertia_kgm2 = symmetric_matrix(elements);
  if (link.at("mass_kg").number() == 0.0 && !inertia_kgm2.isZero(0.0))
    node->fail("belongs to a link whose mass_kg is 0: state its mass, or leave the inertia out");
  constexpr double kMost_kgm2 = 1e5;  // of the largest arms, 1e4
  if (inertia_kgm2.cwiseAbs().maxCoeff() > kMost_kgm2)
    node->fail("must not exceed " + number_text(kMost_kgm2) + ", more than any arm's: it is in kg m^2");
  if (const std::string fault = fault_of_inertia(inertia_kgm2); !fault.empty()) node->fail(fault);
  return inertia_kgm2;
}

LinkInertias load_link_inertias(const std::filesystem::path& path) {
  const YamlNode file = read_yaml(path);
  LinkInertias inertias;
  if (const YamlNode* const links = file.find("links")) {
    for (const YamlNode& link : links->list()) inertias.push_back(read_link_inertia(link));
  }
  const auto stated = [](const auto& inertia) { return inertia.has_value(); };
  return std::ranges::any_of(inertias, stated) ? inertias : LinkInertias{};
}

}  // namespace demecal::inline data_files

#include "languages/controller_data.hpp"

#include <Eigen/Geometry>

#include "data/text.hpp"

namespace demecal::inline languages {
namespace {

KnownFrame kept(const std::map<std::string, Eigen::Isometry3d>& frames, std::string_view key, const std::string& name) {
  const auto found = frames.find(lower_case(key));
  if (found != frames.end()) return {name, found->second, ""};
  return {name, Eigen::Isometry3d::Identity(), name + " is given neither in this program nor by --frames"};
}

}  // namespace

KnownFrame ControllerData::frame(std::string_view key, const std::string& name) const {
  return kept(frames, key, name);
}

KnownFrame ControllerData::tool(std::string_view key, const std::string& name) const {
  return kept(tools, key, name);
}

}  // namespace demecal::inline languages

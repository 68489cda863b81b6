// The frames of an SDF's model: links, joints and frames by their names, each stated in another one.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinematics/drawn_arm.hpp"
#include "urdf/xml.hpp"
#include "urdf/xml_values.hpp"

namespace demecal::inline urdf {

inline constexpr const char* kModelFrame = "__model__";

/// What a <pose> states.
struct SdfPose {
  Origin origin;
  std::string relative_to;  ///< empty: not stated
};

/// The pose that the element holds; where it holds none, that of the frame it is relative to.
SdfPose read_pose(const XmlValues& values, const XmlElement& element);

struct SdfFrame {
  Origin origin{};
  std::string relative_to = kModelFrame;  ///< the frame that the origin is stated in
  std::string attached_to{};              ///< the frame that it moves with; empty: it is a link
  std::size_t line = 0;
};

class SdfFrames {
 public:
  explicit SdfFrames(std::string file, std::size_t line);

  /// The link that the model's own frame moves with.
  void attach_model_to(const std::string& link) { frames_.at(kModelFrame).attached_to = link; }
  void add(const std::string& name, SdfFrame frame);

  /// Throws InputError where a frame that others name is not there, or frames are stated in or attached to themselves.
  /// What follows may be asked for afterwards only.
  void check() const;
  bool contains(const std::string& name) const { return frames_.contains(name); }
  const SdfFrame& frame(const std::string& name) const { return frames_.at(name); }
  /// The link that a frame moves with.
  const std::string& link_of(const std::string& name) const;
  /// Of one frame in another, the numbers as they are written where they need no calculation.
  Origin origin_in(const std::string& base, const std::string& name) const;

  /// Throws InputError with the nearest name where the model has no such frame.
  void require(const std::string& name, std::size_t line) const;

 private:
  void check_ends(const std::string& name, std::string SdfFrame::*next, const char* rule) const;
  std::vector<const SdfFrame*> up_from(const std::string& name) const;

  std::string file_;
  std::map<std::string, SdfFrame> frames_;
};

}  // namespace demecal::inline urdf

#include "html/arm_picture.hpp"

#include <fmt/format.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "html/chart.hpp"
#include "html/markup.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"

namespace demecal::inline html {
namespace {

constexpr double kView_px = 440.0, kMargin_px = 36.0, kTitle_px = 56.0;

/// A direction to look from: what points right and what points up in the picture.
struct View {
  const char* title;
  Eigen::Vector3d right, up;
};

std::array<View, 4> views() {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(), z = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d right = (x + y).normalized();
  const Eigen::Vector3d from = Eigen::Vector3d(1.0, -1.0, 0.8).normalized();
  return {{{"from the side: x right, z up", x, z},
           {"from the front: y right, z up", y, z},
           {"from above: x right, y up", x, y},
           {"obliquely", right, from.cross(right)}}};
}

/// The points of an arm that a picture shows, m, base frame.
struct ArmPoints {
  std::vector<Eigen::Isometry3d> joints;  ///< z along the axis
  Eigen::Isometry3d flange;
  Eigen::Vector3d tool;

  std::vector<Eigen::Vector3d> line() const {
    std::vector<Eigen::Vector3d> points{Eigen::Vector3d::Zero()};
    for (const Eigen::Isometry3d& joint : joints) points.push_back(joint.translation());
    points.push_back(flange.translation());
    return points;
  }
};

ArmPoints points_of(const Chain& chain, const JointVector& joints) {
  const PlaceMotions none = PlaceMotions::Zero(6, chain.size() + 1);
  const DisplacedKinematics arm = differential_kinematics(chain, joints, chain.tool_m, none);
  ArmPoints shape;
  for (int i = 0; i < chain.size(); ++i) shape.joints.push_back(arm.places[static_cast<std::size_t>(i)]);
  shape.flange = arm.kinematics.flange;
  shape.tool = shape.flange * chain.tool_m;
  return shape;
}

/// One scale and one middle for all views.
struct Extent {
  Eigen::Vector3d middle;
  double px_per_m;
  double half_m;  ///< of what is shown, each way
};

Extent extent_of(const ArmPoints& shape) {
  constexpr double kLeast_m = 0.05, kRoom = 1.15;
  Eigen::AlignedBox3d box(Eigen::Vector3d::Zero());
  for (const Eigen::Vector3d& point : shape.line()) box.extend(point);
  box.extend(shape.tool);
  const double half_m = kRoom * std::max(kLeast_m, 0.5 * box.diagonal().norm());
  return {box.center(), (0.5 * kView_px - kMargin_px) / half_m, half_m};
}

class ViewDrawing {
 public:
  ViewDrawing(const View& view, const Extent& extent) : view_(view), extent_(extent) {}

  std::string drawn(const ArmPoints& shape, const Chain& chain) const {
    std::string text = fmt::format("<rect class=\"frame\" width=\"{0}\" height=\"{0}\"/>\n", kView_px);
    text += grid() + base_axes(axis_m());
    std::string line;
    for (const Eigen::Vector3d& point : shape.line()) {
      const auto [x, y] = at(point);
      line += fmt::format("{}{:.1f},{:.1f}", line.empty() ? "" : " ", x, y);
    }
    text += "<polyline class=\"link\" points=\"" + line + "\"/>\n";
    text += segment("to-tool", shape.flange.translation(), shape.tool);
    for (std::size_t i = 0; i < shape.joints.size(); ++i) text += joint(shape, chain, i);
    const auto [x, y] = at(shape.tool);
    text += fmt::format("<circle class=\"tool-point\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\"/>\n", x, y);
    text += fmt::format("<text class=\"title\" x=\"10\" y=\"20\">{}</text>\n", view_.title);
    return text;
  }

 private:
  PicturePoint at(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d off = point - extent_.middle;
    return {0.5 * kView_px + extent_.px_per_m * view_.right.dot(off),
            0.5 * kView_px - extent_.px_per_m * view_.up.dot(off)};
  }

  double axis_m() const { return 0.12 * extent_.half_m; }

  std::string segment(const char* css_class, const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
    const auto [x1, y1] = at(from);
    const auto [x2, y2] = at(to);
    return fmt::format("<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n", css_class, x1,
                       y1, x2, y2);
  }

  /// A bar along the joint's axis, as long whichever way it points in space, and its number beside it.
  std::string joint(const ArmPoints& shape, const Chain& chain, std::size_t i) const {
    const Eigen::Isometry3d& place = shape.joints[i];
    const Eigen::Vector3d along = axis_m() * place.linear().col(2);
    const bool turns = is_revolute(chain.joints[i]);
    std::string text = segment(turns ? "axis" : "slide", place.translation() - along, place.translation() + along);
    const auto [x, y] = at(place.translation());
    text += fmt::format("<circle class=\"joint\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\"/>\n", x, y);
    int same = 0;  // joints at one place are written in a row
    for (std::size_t k = 0; k < i; ++k) {
      const auto [other_x, other_y] = at(shape.joints[k].translation());
      if (std::hypot(other_x - x, other_y - y) < 12.0) ++same;
    }
    return text + fmt::format("<text class=\"number\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", x + 8.0 + 13.0 * same,
                              y - 7.0, i + 1);
  }

  /// Lines at round millimetres, where the view looks along an axis of the base.
  std::string grid() const {
    if (view_.right.cwiseAbs().maxCoeff() < 1.0 - 1e-9) return {};
    std::string text;
    for (const bool upright : {true, false}) {
      const Eigen::Vector3d& direction = upright ? view_.right : view_.up;
      const double middle_mm = millimetres(direction.dot(extent_.middle)), half_mm = millimetres(extent_.half_m);
      const Axis axis{middle_mm - half_mm, middle_mm + half_mm, 0.0, 1.0, false, false};
      for (const double value_mm : ticks(axis, 5)) {
        const double off_px = extent_.px_per_m * metres(value_mm - middle_mm);
        const double px = 0.5 * kView_px + (upright ? off_px : -off_px);
        text += upright ? fmt::format(
                              "<line class=\"grid\" x1=\"{0:.1f}\" y1=\"30\" x2=\"{0:.1f}\" y2=\"{1}\"/>\n<text "
                              "class=\"tick\" x=\"{0:.1f}\" y=\"{2}\" text-anchor=\"middle\">{3}</text>\n",
                              px, kView_px - 20.0, kView_px - 7.0, tick_text(value_mm))
                        : fmt::format(
                              "<line class=\"grid\" x1=\"40\" y1=\"{0:.1f}\" x2=\"{1}\" y2=\"{0:.1f}\"/>\n<text "
                              "class=\"tick\" x=\"36\" y=\"{2:.1f}\" text-anchor=\"end\">{3}</text>\n",
                              px, kView_px - 8.0, px + 4.0, tick_text(value_mm));
      }
    }
    return text;
  }

  std::string base_axes(double length_m) const {
    constexpr std::array<const char*, 3> kNames{"x", "y", "z"};
    std::string text;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d end = length_m * Eigen::Vector3d::Unit(axis);
      const char* const name = kNames.at(static_cast<std::size_t>(axis));
      text += segment(fmt::format("base-{}", name).c_str(), Eigen::Vector3d::Zero(), end);
    }
    return text;
  }

  const View& view_;
  const Extent& extent_;
};

constexpr const char* kPictureStyle =
    "text{font:13px sans-serif;fill:#222}.title{font-weight:bold}.tick{font-size:11px;fill:#666}"
    ".frame{fill:#fff;stroke:#bbb}.grid{stroke:#e4e4e4}.link{fill:none;stroke:#52667a;stroke-width:7;stroke-linecap:"
    "round;"
    "stroke-linejoin:round}.to-tool{stroke:#52667a;stroke-width:2;stroke-dasharray:5 "
    "3}.axis{stroke:#d9822b;stroke-width:4}"
    ".slide{stroke:#7a4fb5;stroke-width:4;stroke-dasharray:6 3}.joint{fill:#fff;stroke:#222;stroke-width:1.5}"
    ".number{font-weight:bold}.tool-point{fill:none;stroke:#c0392b;stroke-width:2}.base-x{stroke:#c0392b;stroke-width:"
    "2}"
    ".base-y{stroke:#2e8b57;stroke-width:2}.base-z{stroke:#2c5fa8;stroke-width:2}";

}  // namespace

std::string arm_picture(const Robot& robot, const JointVector& joints) {
  const ArmPoints shape = points_of(robot.chain, joints);
  const Extent extent = extent_of(shape);
  std::string at;
  for (int i = 0; i < robot.chain.size(); ++i) {
    const bool turns = is_revolute(robot.chain.joints[static_cast<std::size_t>(i)]);
    at += fmt::format("{}{:.4g} {}", i == 0 ? "" : ", ", turns ? degrees(joints[i]) : millimetres(joints[i]),
                      turns ? "deg" : "mm");
  }
  const double width = 2.0 * kView_px + 30.0, height = 2.0 * kView_px + kTitle_px + 20.0;
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" role=\"img\">\n"
      "<title>{2}</title>\n<style>{3}</style>\n<rect width=\"100%\" height=\"100%\" fill=\"#fafafa\"/>\n"
      "<text class=\"title\" x=\"10\" y=\"22\">{2}</text>\n"
      "<text x=\"10\" y=\"42\">at {4}; mm in the base frame; bars: axes, dashed ones slide; ring: tool point</text>\n",
      width, height, escaped(robot.name), kPictureStyle, at);
  const std::array<View, 4> all = views();
  for (std::size_t i = 0; i < all.size(); ++i) {
    text += fmt::format("<g transform=\"translate({},{})\">\n", 10.0 + (kView_px + 10.0) * static_cast<double>(i % 2),
                        kTitle_px + (kView_px + 10.0) * static_cast<double>(i / 2));
    text += ViewDrawing(all[i], extent).drawn(shape, robot.chain) + "</g>\n";
  }
  return text + "</svg>\n";
}

}  // namespace demecal::inline html

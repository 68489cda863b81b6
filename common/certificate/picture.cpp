#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "acceptance/certificate.hpp"
#include "certificate/documents.hpp"
#include "kinematics/units.hpp"

namespace demecal::inline certificate {
namespace {

constexpr double kPictureWidth = 330.0, kPictureHeight = 250.0, kPictureMargin = 26.0;
constexpr std::size_t kMostPoints = 600;

/// Two of the three axes, as a picture shows them.
struct Side {
  const char* title;
  int right, up;
};
constexpr std::array<Side, 2> kSides{{{"from above (x, y)", 0, 1}, {"from the side (x, z)", 0, 2}}};

class SideView {
 public:
  SideView(const CertifiedView& view, const Side& side) : side_(side) {
    for (const Eigen::Vector3d& point : view.arm) widen(point);
    for (const auto& [point, error] : view.points_m) widen(point);
    const Eigen::Vector2d size = (upper_ - lower_).cwiseMax(1e-6);
    scale_ =
        std::min((kPictureWidth - 2.0 * kPictureMargin) / size.x(), (kPictureHeight - 2.0 * kPictureMargin) / size.y());
  }

  /// Where a point stands in the picture, px.
  Eigen::Vector2d operator()(const Eigen::Vector3d& point) const {
    const Eigen::Vector2d middle = 0.5 * (lower_ + upper_);
    return {0.5 * kPictureWidth + scale_ * (point[side_.right] - middle.x()),
            0.5 * kPictureHeight - scale_ * (point[side_.up] - middle.y())};
  }

  double metres_of(double px) const { return px / scale_; }

 private:
  void widen(const Eigen::Vector3d& point) {
    const Eigen::Vector2d flat(point[side_.right], point[side_.up]);
    lower_ = lower_.cwiseMin(flat);
    upper_ = upper_.cwiseMax(flat);
  }

  Side side_;
  double scale_ = 1.0;
  Eigen::Vector2d lower_ = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d upper_ = -lower_;
};

/// Within half the tolerance, within it, beyond it; told apart by shape of the edge too.
std::string point_mark(const Eigen::Vector2d& at, double error_m, double tolerance_m) {
  const bool beyond = error_m > tolerance_m;
  const char* const colour = beyond ? "#b3382c" : error_m > 0.5 * tolerance_m ? "#d98324" : "#1c7a4a";
  return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"{}/>\n", at.x(), at.y(),
                     beyond ? "3" : "2", colour, beyond ? " stroke=\"#000000\" stroke-width=\"0.8\"" : "");
}

/// A line of round length.
std::string scale_bar(const SideView& place) {
  const double most_mm = millimetres(place.metres_of(0.3 * kPictureWidth));
  double length_mm = std::pow(10.0, std::floor(std::log10(most_mm)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * length_mm <= most_mm) {
      length_mm *= factor;
      break;
    }
  }
  const double px = metres(length_mm) / place.metres_of(1.0);
  return fmt::format(
      "<path d=\"M10 {0} h{1:.1f}\" stroke=\"#1b232b\" stroke-width=\"1.5\"/><text x=\"{2:.1f}\" y=\"{3}\" "
      "font-size=\"10\" fill=\"#1b232b\">{4:.10g} mm</text>\n",
      kPictureHeight - 8.0, px, 16.0 + px, kPictureHeight - 4.0, length_mm);
}

std::string side_view(const CertifiedView& view, const Side& side, double tolerance_m) {
  const SideView place(view, side);
  std::string marks, line;
  for (const Eigen::Vector3d& point : view.arm) {
    const Eigen::Vector2d at = place(point);
    line += fmt::format("{}{:.1f},{:.1f}", line.empty() ? "" : " ", at.x(), at.y());
    marks += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"#5c6873\"/>\n", at.x(), at.y());
  }
  const std::size_t step = 1 + (view.points_m.size() - 1) / kMostPoints;
  std::string points;
  for (std::size_t i = 0; i < view.points_m.size(); i += step)
    points += point_mark(place(view.points_m[i].first), view.points_m[i].second, tolerance_m);
  return fmt::format(
             "<svg width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" role=\"img\" aria-label=\"{2}\" "
             "font-family=\"sans-serif\">\n"
             "<rect x=\"0.5\" y=\"0.5\" width=\"{3}\" height=\"{4}\" fill=\"none\" stroke=\"#b8c0c7\"/>\n"
             "<polyline points=\"{5}\" fill=\"none\" stroke=\"#8b98a4\" stroke-width=\"5\" stroke-linejoin=\"round\"/>"
             "\n",
             kPictureWidth, kPictureHeight, side.title, kPictureWidth - 1.0, kPictureHeight - 1.0, line) +
         marks + points + scale_bar(place) +
         fmt::format("<text x=\"10\" y=\"15\" font-size=\"10\" fill=\"#1b232b\">{}</text>\n</svg>\n", side.title);
}

}  // namespace

std::string volume_picture(const CertifiedView& view, double tolerance_m) {
  if (view.points_m.empty()) return {};
  std::string cells;
  for (const Side& side : kSides) cells += "<td>" + side_view(view, side, tolerance_m) + "</td>";
  return "<table class=\"views\"><tr>" + cells +
         "</tr></table>\n<p class=\"small\">Judged positions and the arm at one of them, in the frame of the "
         "measurements. "
         "Green: within half the tolerance; orange: within it; red with an edge: beyond it.</p>\n";
}

}  // namespace demecal::inline certificate

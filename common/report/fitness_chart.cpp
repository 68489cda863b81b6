#include "report/fitness_chart.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "report/chart_frame.hpp"

namespace demecal {
namespace {

/// As many line styles as the page's style sheet tells apart.
constexpr std::size_t kStyles = 6;

const FitnessCurves& curves_of(const FitnessHistory& history, std::uint64_t joint) {
  static const FitnessCurves none;
  const auto found = history.joints.find(joint);
  return found == history.joints.end() ? none : found->second;
}

double last_generation(const FitnessCurves& curves) {
  double last = 0.0;
  for (const auto& [island, points] : curves) {
    for (const FitnessPoint& point : points) last = std::max(last, point.generation);
  }
  return last;
}

std::vector<PicturePoint> placed(const LineChart& chart, const std::vector<FitnessPoint>& points) {
  std::vector<PicturePoint> places;
  for (const FitnessPoint& point : points) places.emplace_back(chart.x(point.generation), chart.y(point.best));
  return places;
}

std::string island_marks(const LineChart& chart, std::uint64_t island, const std::vector<FitnessPoint>& points) {
  if (points.empty()) return {};
  const std::string style = fmt::format("island i{}", (island - 1) % kStyles);
  const std::vector<PicturePoint> places = placed(chart, points);
  // The dot at the end also shows islands of a single row.
  return polyline(places, style, fmt::format("island {}", island)) +
         fmt::format("<circle class=\"{}\" cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"2.6\"/>\n", style, places.back().first,
                     places.back().second);
}

}  // namespace

std::string fitness_chart(const FitnessHistory& history, std::uint64_t joint) {
  const FitnessCurves& curves = curves_of(history, joint);
  constexpr double kMargin = 1.15;
  LineChart chart = line_chart(0.0, std::max(1.0, last_generation(curves)), history.lowest / kMargin,
                               history.highest * kMargin, true);
  chart.x.to_px -= 4.0;  // room for the dots at the ends
  chart.x_title = "generation";
  chart.y_title = "best fitness";
  chart.label = fmt::format("Best fitness of the islands of joint {} over the generations", joint);
  std::string marks;
  for (const auto& [island, points] : curves) marks += island_marks(chart, island, points);
  return marks.empty() ? marks : drawn(chart, marks);
}

std::string fitness_caption(const FitnessHistory& history, std::uint64_t joint) {
  const FitnessPoint* best = nullptr;
  std::uint64_t best_island = 0;
  for (const auto& [island, points] : curves_of(history, joint)) {
    for (const FitnessPoint& point : points) {
      if (best != nullptr && point.best >= best->best) continue;
      best = &point;
      best_island = island;
    }
  }
  if (best == nullptr) return {};
  return fmt::format("best {:.4g} in generation {:.0f}, island {}", best->best, best->generation, best_island);
}

}  // namespace demecal

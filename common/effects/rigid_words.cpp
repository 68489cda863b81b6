#include "effects/rigid_words.hpp"

#include <array>

#include "effects/joint_words.hpp"

namespace demecal {
namespace {

constexpr std::array<const char*, 6> kAxes{"x", "y", "z", "rx", "ry", "rz"};

}  // namespace

std::vector<CoefficientLabel> rigid_labels(int count, const std::string& suffix, const std::string& per) {
  std::vector<CoefficientLabel> labels;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(count); ++axis) {
    const std::string unit = axis < 3 ? "m" : "rad";
    labels.push_back({std::string(kAxes[axis]) + '_' + unit + suffix, unit + per});
  }
  return labels;
}

void append_rigid_motions(int place, int count, double size, std::vector<UnitMotion>& motions) {
  if (size == 0.0) return;
  for (int axis = 0; axis < count; ++axis) motions.push_back({axis, place, axis, size});
}

std::string write_rigid_equations(const Effect& effect, const Robot& robot, int count, const std::string& symbol,
                                  const std::string& factor) {
  std::vector<Equation> equations;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(count); ++axis) {
    equations.push_back({symbol + kAxes[axis], {{axis, factor}}});
  }
  return write_equations(effect, robot, equations);
}

std::string triple_words(const Effect& effect, std::size_t first, double scale, const std::string& unit) {
  std::string text = "(";
  for (std::size_t i = 0; i < 3; ++i) text += (i == 0 ? "" : ", ") + number_words(scale * effect.value(first + i));
  return text + ") " + unit;
}

}  // namespace demecal

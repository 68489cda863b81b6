#include "diagnosis/candidates.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "effects/effect.hpp"
#include "expression/bound.hpp"
#include "expression/tree.hpp"
#include "kinematics/chain.hpp"
#include "primitives/primitive.hpp"

namespace demecal::inline diagnosis {
namespace {

Tree variable(int index) {
  return variable_tree(static_cast<std::uint8_t>(index));
}

Tree times(double factor, const Tree& tree) {
  return factor == 1.0 ? tree : apply(Primitive::multiply, constant_tree(factor), tree);
}

Tree product(const Tree& a, const Tree& b) {
  return apply(Primitive::multiply, a, b);
}

/// left + sign * factor * right
Tree sum(const Tree& left, double factor, const Tree& right) {
  return apply(factor < 0 ? Primitive::subtract : Primitive::add, left, times(std::abs(factor), right));
}

class Library {
 public:
  Library(const Robot& robot, const Evidence& evidence) : joints_(robot.chain.size()) {
    for (int joint = 0; joint < joints_; ++joint) {
      const Interval& range = evidence.joint_ranges[static_cast<std::size_t>(joint)];
      if (range.upper - range.lower > kLeastMotion) moving_.push_back(joint);
    }
    add_sums();
    add_products();
    if (evidence.masses) add_multiples(variable(joints_), {});
    if (evidence.approach) add_multiples(variable(joints_ + 1), evidence.masses ? variable(joints_) : Tree{});
    if (evidence.temperature) add_multiples(variable(joints_ + 2), evidence.masses ? variable(joints_) : Tree{});
  }

  const std::vector<Tree>& formulas() const { return formulas_; }
  /// Of waves of any phase.
  const std::vector<Tree>& angles() const { return angles_; }

 private:
  void add_waves(const Tree& angle) {
    formulas_.push_back(apply(Primitive::sine, angle));
    formulas_.push_back(apply(Primitive::cosine, angle));
    angles_.push_back(angle);
  }

  void add_sums() {
    for (std::size_t a = 0; a < moving_.size(); ++a) {
      for (std::size_t b = a + 1; b < moving_.size(); ++b) {
        for (const double m : {1.0, 2.0}) {
          for (const double n : {1.0, -1.0, 2.0, -2.0}) {
            add_waves(sum(times(m, variable(moving_[a])), n, variable(moving_[b])));
          }
        }
        for (std::size_t c = b + 1; c < moving_.size(); ++c) {
          for (const double n : {1.0, -1.0}) {
            const Tree two = sum(variable(moving_[a]), n, variable(moving_[b]));
            for (const double k : {1.0, -1.0}) add_waves(sum(two, k, variable(moving_[c])));
          }
        }
      }
    }
  }

  void add_products() {
    for (const int a : moving_) {
      for (const int b : moving_) {
        if (a <= b) formulas_.push_back(product(variable(a), variable(b)));
        for (const double n : {1.0, 2.0}) {
          const Tree angle = times(n, variable(b));
          formulas_.push_back(product(variable(a), apply(Primitive::sine, angle)));
          formulas_.push_back(product(variable(a), apply(Primitive::cosine, angle)));
        }
      }
    }
  }

  /// What a circumstance multiplies: itself (if it is not a sign), joint values and their waves, and `other`.
  void add_multiples(const Tree& circumstance, const Tree& other) {
    if (other.empty()) {
      formulas_.push_back(product(circumstance, circumstance));
    } else {
      formulas_.push_back(product(circumstance, other));
    }
    for (const int a : moving_) {
      formulas_.push_back(product(circumstance, variable(a)));
      formulas_.push_back(product(circumstance, apply(Primitive::sine, variable(a))));
      formulas_.push_back(product(circumstance, apply(Primitive::cosine, variable(a))));
    }
  }

  int joints_;
  std::vector<int> moving_;
  std::vector<Tree> formulas_, angles_;
};

Effect symbolic(int joint, const Tree& formula, const char* form, const Evidence& evidence) {
  Effect effect = symbolic_effect(joint, form);
  effect.formula = formula;
  if (evidence.temperature) effect.settings["reference_celsius"] = evidence.mean_temperature_celsius;
  return effect;
}

}  // namespace

std::vector<Effect> formula_library(const Robot& robot, const Evidence& evidence) {
  const Library library(robot, evidence);
  std::vector<Effect> effects;
  for (int joint = 0; joint < robot.chain.size(); ++joint) {
    if (!is_revolute(robot.chain, joint)) continue;
    for (const Tree& formula : library.formulas()) effects.push_back(symbolic(joint, formula, "", evidence));
    for (const Tree& angle : library.angles()) effects.push_back(symbolic(joint, angle, "wave", evidence));
  }
  return effects;
}

}  // namespace demecal::inline diagnosis

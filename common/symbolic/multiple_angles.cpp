#include "symbolic/multiple_angles.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "symbolic/calculus.hpp"

namespace demecal::inline symbolic {
namespace {

constexpr double kMostMultiple = 1000.0;  // beyond it steps cost what a call does, and are off by 1e-13

bool is_sine_or_cosine(const ExpressionNode& term) {
  return term.kind == ExpressionKind::function &&
         (term.function == Function::sine || term.function == Function::cosine);
}

struct Multiple {
  Expression angle;
  int times;
};

/// What the argument is a whole multiple of.
Multiple multiple_of(Expression argument) {
  const bool scaled = argument->kind == ExpressionKind::sum && argument->value == 0.0 && argument->parts.size() == 1;
  if (!scaled) return {argument, 1};
  const auto& [angle, factor] = argument->parts[0];
  const bool whole = factor == std::round(factor) && factor >= 2.0 && factor <= kMostMultiple;
  return whole ? Multiple{angle, static_cast<int>(factor)} : Multiple{argument, 1};
}

/// The steps of one angle, each made when it is asked for.
class AngleSteps {
 public:
  AngleSteps(std::string angle, Steps& steps) : angle_(std::move(angle)), steps_(steps) {}

  std::string cosine(int times) { return step("cos", times); }
  std::string sine(int times) { return step("sin", times); }

 private:
  std::string step(const std::string& function, int times) {
    std::string name = function + (times == 1 ? "" : std::to_string(times)) + '_' + angle_;
    if (!known_.contains(name)) {
      const std::string value = value_of(function == "cos", function, times);
      known_.insert(name);
      steps_.assignments.emplace_back(name, value);
    }
    return name;
  }
  std::string value_of(bool is_cosine, const std::string& function, int times) {
    if (times == 1) return function + '(' + angle_ + ')';
    if (times % 2 == 0) {
      const std::string s = sine(times / 2);
      return is_cosine ? "1.0 - 2.0*" + s + '*' + s : "2.0*" + s + '*' + cosine(times / 2);
    }
    const std::string c = cosine(times - 1), s = sine(times - 1), c1 = cosine(1), s1 = sine(1);
    return is_cosine ? c + '*' + c1 + " - " + s + '*' + s1 : s + '*' + c1 + " + " + c + '*' + s1;
  }

  std::string angle_;
  Steps& steps_;
  std::set<std::string> known_;
};

/// Writes expressions anew with names for the waves of angles that have several.
class WaveNames {
 public:
  WaveNames(const std::vector<Expression>& expressions, const ExpressionPrinter& printer, Steps& steps) {
    std::map<std::uint32_t, std::set<int>> times;
    std::vector<Expression> angles;
    for (const Expression term : terms_of(expressions)) {
      if (!is_sine_or_cosine(*term)) continue;
      const Multiple multiple = multiple_of(term->parts[0].first);
      if (times[multiple.angle->id].empty()) angles.push_back(multiple.angle);
      times[multiple.angle->id].insert(multiple.times);
    }
    for (const Expression angle : angles) {
      const auto terms = terms_of({&angle, 1});
      const bool nested = std::ranges::any_of(terms, [](Expression term) { return is_sine_or_cosine(*term); });
      if (nested || times[angle->id].size() < 2) continue;
      std::string name = angle->name;
      if (angle->kind != ExpressionKind::symbol) {
        name = "angle" + std::to_string(steps_of_.size() + 1);
        steps.assignments.emplace_back(name, printer(angle));
      }
      steps_of_.emplace(angle->id, AngleSteps(name, steps));
    }
  }

  Expression renamed(Expression expression) {
    const auto known = known_.find(expression->id);
    if (known != known_.end()) return known->second;
    const Expression value = written(expression);
    known_.emplace(expression->id, value);
    return value;
  }

 private:
  Expression written(Expression expression) {
    Algebra& algebra = expression.algebra();
    if (is_sine_or_cosine(*expression)) {
      const Multiple multiple = multiple_of(expression->parts[0].first);
      const auto found = steps_of_.find(multiple.angle->id);
      if (found != steps_of_.end())
        return algebra.symbol(expression->function == Function::cosine ? found->second.cosine(multiple.times)
                                                                       : found->second.sine(multiple.times));
    }
    std::vector<Part> parts;
    std::vector<Expression> arguments;
    for (const auto& [part, amount] : expression->parts) {
      parts.emplace_back(renamed(part), amount);
      arguments.push_back(parts.back().first);
    }
    if (parts == expression->parts) return expression;
    if (expression->kind == ExpressionKind::sum) return algebra.sum(parts, expression->value);
    if (expression->kind == ExpressionKind::product) return algebra.product(parts);
    if (expression->function != Function::formula) return algebra.function(expression->function, arguments);
    return algebra.formula(expression->name, algebra.tree_of(expression->name), arguments);
  }

  std::map<std::uint32_t, AngleSteps> steps_of_;
  std::map<std::uint32_t, Expression> known_;
};

}  // namespace

Steps plan_steps_with_multiples(const std::vector<Expression>& expressions, const ExpressionPrinter& printer) {
  Steps steps;
  WaveNames names(expressions, printer, steps);
  std::vector<Expression> renamed;
  for (const Expression expression : expressions) renamed.push_back(names.renamed(expression));
  Steps others = plan_steps(renamed, printer);
  steps.assignments.insert(steps.assignments.end(), others.assignments.begin(), others.assignments.end());
  steps.names = std::move(others.names);
  steps.results = std::move(others.results);
  return steps;
}

}  // namespace demecal::inline symbolic

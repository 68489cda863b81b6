#include <algorithm>
#include <cstddef>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "symbolic/algebra.hpp"
#include "symbolic/calculus.hpp"
#include "symbolic/code.hpp"
#include "symbolic/inverse_solver.hpp"
#include "symbolic/multiple_angles.hpp"
#include "symbolic/parse_expression.hpp"
#include "symbolic/printing.hpp"
#include "symbolic/support_functions.hpp"

namespace demecal::inline symbolic {
namespace {

/// The functions of one arm that Newton's steps call.
class ArmFunctions {
 public:
  explicit ArmFunctions(const Listing& arm) : arm_(arm), pose_(elements(arm.pose)), all_(pose_) {}

  /// The pose as a function of the joints alone.
  std::string nominal_forward();
  /// The pose and how commands move it.
  std::string linearize();

 private:
  /// Of the symbols that the expressions refer to, what stands for them in the arguments.
  std::string symbols_read() const;
  std::string pose_written(const Steps& steps) const {
    std::ostringstream out;
    for (const auto& [name, value] : steps.assignments) out << "  const double " << name << " = " << value << ";\n";
    for (std::size_t i = 0; i < pose_.size(); ++i) out << "  pose[" << i << "] = " << steps.results[i] << ";\n";
    return out.str();
  }
  /// Functions that other languages have, and that the listing itself does not call.
  std::string further_support_functions() const;

  const Listing& arm_;
  std::vector<Expression> pose_, all_;
  ExpressionPrinter printer_{CodeLanguage::c};
};

std::string ArmFunctions::symbols_read() const {
  std::set<std::string> used;
  for (const Expression term : terms_of(all_))
    if (term->kind == ExpressionKind::symbol) used.insert(term->name);
  std::ostringstream out;
  for (const char* name : {kPayload, kWarming})
    if (used.contains(name)) out << "  const double " << name << " = at->" << name << ";\n";
  for (std::size_t i = 0; i < arm_.actual.size(); ++i) {
    const auto joint = static_cast<int>(i + 1);
    const std::string q = "q[" + std::to_string(i) + ']', h = 'h' + std::to_string(joint) + '(' + q;
    const bool as_commanded = arm_.actual[i]->kind == ExpressionKind::symbol;
    const auto read = [&](const std::string& name, const std::string& value) {
      if (used.contains(name)) out << "  const double " << name << " = " << value << ";\n";
    };
    read(approach_symbol(joint), "at->approach[" + std::to_string(i) + ']');
    read(commanded_joint(joint), q);
    read(actual_joint(joint), as_commanded ? q : h + ')');
    read(actual_rate(joint), '(' + h + " + STEP) - " + actual_joint(joint) + ")/STEP");
  }
  return out.str();
}

std::string ArmFunctions::further_support_functions() const {
  std::vector<Expression> written = pose_;
  written.insert(written.end(), arm_.actual.begin(), arm_.actual.end());
  written.insert(written.end(), arm_.also.begin(), arm_.also.end());
  const std::set<Function> there = functions_in(written), called = functions_in(all_);
  std::string all;
  for (const SupportFunction& support : support_functions()) {
    const std::string text = support.c;
    if (called.contains(support.function) && !there.contains(support.function) && !text.empty()) all += text + '\n';
  }
  return all;
}

std::string ArmFunctions::nominal_forward() {
  return "static void nominal_forward(const struct circumstances* at, const double q[N], double pose[16]) {\n  "
         "(void)at;\n" +
         symbols_read() + pose_written(plan_steps_with_multiples(pose_, printer_)) + "}\n\n";
}

std::string ArmFunctions::linearize() {
  const std::size_t n = arm_.axes.size();
  for (const MovingAxis& axis : arm_.axes) {
    all_.insert(all_.end(), axis.direction.begin(), axis.direction.end());
    all_.insert(all_.end(), axis.to_next.begin(), axis.to_next.end());
    all_.push_back(axis.rate);
  }
  const Steps steps = plan_steps_with_multiples(all_, printer_);
  auto result = steps.results.begin() + static_cast<std::ptrdiff_t>(pose_.size());
  std::ostringstream directions, ways, rates, slides, coupled;
  bool all_turn = true;
  const auto vector = [&] {
    const std::string text = '{' + result[0] + ", " + result[1] + ", " + result[2] + '}';
    result += 3;
    return text;
  };
  for (std::size_t k = 0; k < n; ++k) {
    const char* end = k + 1 < n ? ",\n    " : "};\n";
    directions << vector() << end;
    ways << vector() << end;
    rates << *result++ << end;
    slides << (arm_.axes[k].turns ? 0 : 1) << (k + 1 < n ? ", " : "};\n");
    all_turn = all_turn && arm_.axes[k].turns;
    for (const auto& [from, rate] : arm_.axes[k].coupled)
      coupled << "  for (int i = 0; i < 6; ++i) jacobian[i][" << from << "] += " << printer_.number(rate)
              << "*jacobian[i][" << k << "]/rate[" << k << "];\n";
  }
  std::ostringstream out;
  out << further_support_functions()
      << "/* The arm's pose as of forward, and its derivatives by the commands as of pose_error: from where the axes "
         "of\n"
         "   joints stand and how fast joints follow commands. That other effects change on the way is left out. */\n"
      << "static void linearize(const struct circumstances* at, const double q[N], double pose[16],\n"
      << "                      double jacobian[6][N]) {\n  (void)at;\n"
      << symbols_read() << pose_written(steps) << "  const double axis[N][3] = {\n    " << directions.str()
      << "  const double to_next[N][3] = {\n    " << ways.str() << "  const double rate[N] = {\n    " << rates.str()
      << (all_turn ? "" : "  static const int slides[N] = {" + slides.str())
      << "  double lever[3] = {0.0, 0.0, 0.0};\n"
         "  for (int k = N - 1; k >= 0; --k) {\n"
         "    for (int i = 0; i < 3; ++i) lever[i] += to_next[k][i];\n"
         "    jacobian[0][k] = rate[k]*(axis[k][1]*lever[2] - axis[k][2]*lever[1]);\n"
         "    jacobian[1][k] = rate[k]*(axis[k][2]*lever[0] - axis[k][0]*lever[2]);\n"
         "    jacobian[2][k] = rate[k]*(axis[k][0]*lever[1] - axis[k][1]*lever[0]);\n"
         "    for (int i = 0; i < 3; ++i) jacobian[3 + i][k] = LEVER*rate[k]*axis[k][i];\n";
  if (!all_turn)
    out << "    if (!slides[k]) continue;\n"
           "    for (int i = 0; i < 3; ++i) {\n"
           "      jacobian[i][k] = rate[k]*axis[k][i];\n"
           "      jacobian[3 + i][k] = 0.0;\n"
           "    }\n";
  out << "  }\n" << coupled.str() << "}\n\n";
  return out.str();
}

}  // namespace

std::string inverse_in_c(const Listing& arm, const Listing& nominal) {
  return "\n#define N " + std::to_string(nominal.actual.size()) + '\n' + inverse_constants_in_c() +
         ArmFunctions(nominal).nominal_forward() + ArmFunctions(arm).linearize() + reach_in_c() +
         bounded_inverse_in_c(nominal.actual.size());
}

}  // namespace demecal::inline symbolic

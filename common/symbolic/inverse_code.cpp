#include <algorithm>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

#include "symbolic/algebra.hpp"
#include "symbolic/calculus.hpp"
#include "symbolic/code.hpp"
#include "symbolic/inverse_solver.hpp"
#include "symbolic/parse_expression.hpp"
#include "symbolic/printing.hpp"

namespace demecal::inline symbolic {
namespace {

/// The pose of the described arm as a function of the joints alone.
std::string nominal_forward(const Listing& nominal) {
  const ExpressionPrinter printer(CodeLanguage::c);
  const std::vector<Expression> pose = elements(nominal.pose);
  const auto uses = [&](const std::string& symbol) {
    return std::ranges::any_of(
        terms_of(pose), [&](Expression term) { return term->kind == ExpressionKind::symbol && term->name == symbol; });
  };
  std::ostringstream out;
  out << "static void nominal_forward(const struct circumstances* at, const double q[N], double pose[16]) {\n  "
         "(void)at;\n";
  for (std::size_t i = 0; i < nominal.actual.size(); ++i) {
    const auto joint = static_cast<int>(i + 1);
    for (const std::string& symbol : {commanded_joint(joint), actual_joint(joint)})
      if (uses(symbol)) out << "  const double " << symbol << " = q[" << i << "];\n";
  }
  const Steps steps = plan_steps(pose, printer);
  for (const auto& [name, value] : steps.assignments) out << "  const double " << name << " = " << value << ";\n";
  for (std::size_t i = 0; i < pose.size(); ++i) out << "  pose[" << i << "] = " << steps.results[i] << ";\n";
  out << "}\n\n";
  return out.str();
}

}  // namespace

std::string inverse_in_c(const Listing& nominal) {
  return "\n#define N " + std::to_string(nominal.actual.size()) + '\n' + inverse_constants_in_c() +
         nominal_forward(nominal) + reach_in_c() + bounded_inverse_in_c(nominal.actual.size());
}

}  // namespace demecal::inline symbolic

#include "symbolic/code.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <set>
#include <sstream>
#include <utility>

#include "symbolic/calculus.hpp"
#include "symbolic/multiple_angles.hpp"
#include "symbolic/printing.hpp"
#include "symbolic/support_functions.hpp"

namespace demecal::inline symbolic {
namespace {

/// Names of a formula's variables: theta of one, x1 .. xk of more.
std::vector<std::string> variables_of(const ExpressionNode& formula) {
  if (formula.parts.size() == 1) return {"theta"};
  std::vector<std::string> names;
  for (std::size_t i = 1; i <= formula.parts.size(); ++i) names.push_back('x' + std::to_string(i));
  return names;
}

std::string comma_separated(const std::vector<std::string>& texts, const std::string& before = "") {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : ", ") + before + text;
  return all;
}

class CodeFile {
 public:
  CodeFile(const Listing& listing, CodeLanguage language)
      : listing_(listing), printer_(language), pose_(elements(listing.pose)) {
    everything_ = pose_;
    everything_.insert(everything_.end(), listing.actual.begin(), listing.actual.end());
    everything_.insert(everything_.end(), listing.also.begin(), listing.also.end());
  }

  std::string text() { return remarks("") + equations(); }
  std::string c();
  std::string python();
  std::string matlab();

 private:
  std::size_t joints() const { return listing_.actual.size(); }
  std::string number_of(std::size_t i) const { return std::to_string(i + 1); }

  /// Names are other people's text: none ends its line of comment, and what stands behind it would be code.
  std::string remarks(const std::string& mark) const {
    std::string all;
    for (std::string line : listing_.remarks) {
      std::ranges::replace_if(
          line, [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
      all += mark + line + '\n';
    }
    return all + '\n';
  }
  std::string support_functions_in(const char* SupportFunction::*language) const {
    const std::set<Function> called = functions_in(everything_);
    std::string all;
    for (const SupportFunction& support : support_functions()) {
      const std::string text = support.*language;
      if (called.contains(support.function) && !text.empty()) all += text + '\n';
    }
    return all;
  }
  /// Evolved formulas that are called, each once, in the order in which they were made.
  std::vector<Expression> formulas() const {
    std::set<std::string> names;
    std::vector<Expression> found;
    for (const Expression term : terms_of(everything_)) {
      const bool formula = term->kind == ExpressionKind::function && term->function == Function::formula;
      if (formula && names.insert(term->name).second) found.push_back(term);
    }
    return found;
  }
  std::string formula_text(Expression formula) const {
    return printer_.formula(formula.algebra().tree_of(formula->name), variables_of(*formula));
  }
  bool pose_uses(const std::string& symbol) const {
    return std::ranges::any_of(
        terms_of(pose_), [&](Expression term) { return term->kind == ExpressionKind::symbol && term->name == symbol; });
  }
  bool has_circumstances() const { return listing_.reference_celsius.has_value(); }
  std::string circumstances_in_c() const;
  /// Names of the circumstances that the pose refers to, and where the language has them.
  std::string circumstances(const std::string& before, const std::string& scalars, const std::string& signs,
                            const std::string& after, int first) const;
  /// Assignments of steps, each with what stands before and after it.
  static std::string assignments(const Steps& steps, const std::string& before, const std::string& after) {
    std::string all;
    for (const auto& [name, value] : steps.assignments) all += before + name + " = " + value + after;
    return all;
  }
  std::string equations();

  const Listing& listing_;
  ExpressionPrinter printer_;
  std::vector<Expression> pose_, everything_;
};

std::string CodeFile::equations() {
  std::ostringstream out;
  for (const Expression formula : formulas()) {
    out << formula->name << '(' << comma_separated(variables_of(*formula)) << ") = " << formula_text(formula) << '\n';
  }
  const Steps joints = plan_steps(listing_.actual, printer_, "s");
  out << assignments(joints, "", "\n");
  for (std::size_t i = 0; i < this->joints(); ++i) {
    out << actual_joint(static_cast<int>(i + 1)) << " = h" << i + 1 << '(' << commanded_joint(static_cast<int>(i + 1))
        << ") = " << joints.results[i] << '\n';
  }
  const Steps steps = plan_steps(pose_, printer_);
  out << '\n' << assignments(steps, "", "\n") << '\n';
  for (std::size_t i = 0; i < 12; ++i) {
    out << "pose(" << i / 4 + 1 << ',' << i % 4 + 1 << ") = " << steps.results[i] << '\n';
  }
  return out.str();
}

std::string CodeFile::circumstances(const std::string& before, const std::string& scalars, const std::string& signs,
                                    const std::string& after, int first) const {
  std::string all;
  for (const char* name : {kPayload, kWarming})
    if (!scalars.empty() && pose_uses(name)) all.append(before).append(name).append(" = " + scalars + name + after);
  for (std::size_t i = 0; i < joints(); ++i) {
    const std::string name = approach_symbol(static_cast<int>(i + 1));
    const auto index = std::to_string(static_cast<int>(i) + first);
    if (pose_uses(name)) all += before + name + " = " + signs + index + (first == 0 ? "]" : ")") + after;
  }
  return all;
}

std::string CodeFile::circumstances_in_c() const {
  std::ostringstream out;
  out << "/* What the pose depends on beside the joints. All of it 0: nothing carried, no warmer, last motions not "
         "known. */\n"
      << "struct circumstances {\n  double payload_kg; /* carried at the tool point as described */\n"
      << "  double warming_kelvin; /* above " << printer_.number(*listing_.reference_celsius) << " degC */\n"
      << "  double approach[" << joints()
      << "]; /* the sign of each joint's last motion, 1 or -1; 0: not known, the middle is taken */\n};\n\n";
  return out.str();
}

std::string CodeFile::c() {
  std::ostringstream out;
  out << remarks("// ") << "#include <math.h>\n\n" << support_functions_in(&SupportFunction::c);
  for (const Expression formula : formulas()) {
    out << "static double " << formula->name << '(' << comma_separated(variables_of(*formula), "double ")
        << ") {\n  return " << formula_text(formula) << ";\n}\n\n";
  }
  for (std::size_t i = 0; i < joints(); ++i) {
    const Steps steps = plan_steps({listing_.actual[i]}, printer_);
    out << "double h" << number_of(i) << "(double q" << number_of(i) << ") {\n"
        << assignments(steps, "  const double ", ";\n") << "  return " << steps.results[0] << ";\n}\n\n";
  }
  const std::string arguments = "const double q[" + std::to_string(joints()) + "], double pose[16]) {\n";
  if (has_circumstances()) {
    const std::string read = circumstances("  const double ", "at->", "at->approach[", ";\n", 0);
    out << circumstances_in_c() << "void forward_at(const struct circumstances* at, " << arguments
        << (read.empty() ? "  (void)at;\n" : read);
  } else {
    out << "void forward(" << arguments;
  }
  for (std::size_t i = 0; i < joints(); ++i) {
    const std::string number = number_of(i), index = std::to_string(i);
    if (pose_uses('q' + number)) out << "  const double q" << number << " = q[" << index << "];\n";
    if (pose_uses("actual" + number))
      out << "  const double actual" << number << " = h" << number << "(q[" << index << "]);\n";
  }
  const Steps steps = plan_steps_with_multiples(pose_, printer_);
  out << assignments(steps, "  const double ", ";\n");
  for (std::size_t i = 0; i < pose_.size(); ++i) out << "  pose[" << i << "] = " << steps.results[i] << ";\n";
  out << "}\n";
  if (has_circumstances())
    out << "\nvoid forward(" << arguments
        << "  const struct circumstances none = {0};\n  forward_at(&none, q, pose);\n}\n";
  return out.str();
}

std::string CodeFile::python() {
  std::ostringstream out;
  out << remarks("# ") << "import math\n\n\n";
  std::string support_functions = support_functions_in(&SupportFunction::python);
  for (std::size_t at = 0; (at = support_functions.find("\n\n", at)) != std::string::npos; at += 3)
    support_functions.insert(at, "\n");
  out << support_functions;
  for (const Expression formula : formulas()) {
    out << "def " << formula->name << '(' << comma_separated(variables_of(*formula)) << "):\n    return "
        << formula_text(formula) << "\n\n\n";
  }
  for (std::size_t i = 0; i < joints(); ++i) {
    const Steps steps = plan_steps({listing_.actual[i]}, printer_);
    out << "def h" << number_of(i) << "(q" << number_of(i) << "):\n"
        << assignments(steps, "    ", "\n") << "    return " << steps.results[0] << "\n\n\n";
  }
  out << "def forward(q" << (has_circumstances() ? ", payload_kg=0.0, warming_kelvin=0.0, approach=None" : "")
      << "):\n";
  const std::string signs = circumstances("    ", "", "approach[", "\n", 0);
  if (!signs.empty()) out << "    approach = approach or [0.0]*" << joints() << '\n' << signs;
  for (std::size_t i = 0; i < joints(); ++i) {
    const std::string number = number_of(i), index = std::to_string(i);
    if (pose_uses('q' + number)) out << "    q" << number << " = q[" << index << "]\n";
    if (pose_uses("actual" + number)) out << "    actual" << number << " = h" << number << "(q[" << index << "])\n";
  }
  const Steps steps = plan_steps(pose_, printer_);
  out << assignments(steps, "    ", "\n") << "    return [\n";
  for (std::size_t row = 0; row < 4; ++row) {
    const auto first = steps.results.begin() + static_cast<std::ptrdiff_t>(4 * row);
    out << "        [" << comma_separated({first, first + 4}) << "],\n";
  }
  out << "    ]\n";
  return out.str();
}

std::string CodeFile::matlab() {
  std::ostringstream out;
  out << "function [pose, h" << (listing_.with_radius ? ", radius95" : "") << "] = forward(q"
      << (has_circumstances() ? ", payload_kg, warming_kelvin, approach" : "") << ")\n"
      << remarks("% ");
  if (has_circumstances()) {
    const std::string zeros = "zeros(1, " + std::to_string(joints()) + ")";
    const std::vector<std::pair<std::string, std::string>> defaults{
        {kPayload, "0"}, {kWarming, "0"}, {"approach", zeros}};
    for (std::size_t i = 0; i < defaults.size(); ++i)
      out << "  if nargin < " << i + 2 << "\n    " << defaults[i].first << " = " << defaults[i].second << ";\n  end\n";
    out << circumstances("  ", "", "approach(", ";\n", 1);
  }
  std::vector<std::string> actual;
  for (std::size_t i = 0; i < joints(); ++i) {
    const std::string number = number_of(i);
    if (pose_uses('q' + number)) out << "  q" << number << " = q(" << number << ");\n";
    out << "  actual" << number << " = h" << number << "(q(" << number << "));\n";
    actual.push_back("actual" + number);
  }
  const Steps steps = plan_steps(pose_, printer_);
  out << assignments(steps, "  ", ";\n") << "  pose = zeros(4, 4);\n";
  for (std::size_t i = 0; i < pose_.size(); ++i) {
    out << "  pose(" << i / 4 + 1 << ", " << i % 4 + 1 << ") = " << steps.results[i] << ";\n";
  }
  out << "  h = [" << comma_separated(actual) << "];\n";
  if (listing_.with_radius)
    out << "  if nargout > 2\n    radius95 = radius_of(q, payload_kg, warming_kelvin, approach, nargin > 2);\n  end\n";
  out << "end\n\n";
  for (std::size_t i = 0; i < joints(); ++i) {
    const Steps of_joint = plan_steps({listing_.actual[i]}, printer_);
    out << "function x = h" << number_of(i) << "(q" << number_of(i) << ")\n"
        << assignments(of_joint, "  ", ";\n") << "  x = " << of_joint.results[0] << ";\nend\n\n";
  }
  for (const Expression formula : formulas()) {
    out << "function x = " << formula->name << '(' << comma_separated(variables_of(*formula))
        << ")\n  x = " << formula_text(formula) << ";\nend\n\n";
  }
  out << support_functions_in(&SupportFunction::matlab);
  return out.str();
}

}  // namespace

std::string commanded_joint(int joint) {
  return 'q' + std::to_string(joint);
}
std::string actual_joint(int joint) {
  return "actual" + std::to_string(joint);
}
std::string approach_symbol(int joint) {
  return "approach" + std::to_string(joint);
}

Listing derivative(const Listing& listing, int joint) {
  Listing result = listing;
  const std::string commanded = commanded_joint(joint), actual = actual_joint(joint);
  const Expression follows = derivative(listing.actual[static_cast<std::size_t>(joint - 1)], commanded);
  for (auto& row : result.pose) {
    for (Expression& element : row) element = derivative(element, commanded) + derivative(element, actual) * follows;
  }
  result.remarks.push_back("Written is its derivative by " + commanded + ", per rad or m.");
  return result;
}

std::string code_of(const Listing& listing, CodeLanguage language) {
  CodeFile file(listing, language);
  switch (language) {
    case CodeLanguage::c:
      return file.c();
    case CodeLanguage::python:
      return file.python();
    case CodeLanguage::matlab:
      return file.matlab();
    case CodeLanguage::text:
      break;
  }
  return file.text();
}

}  // namespace demecal::inline symbolic

#include "symbolic/radius_code.hpp"

#include <algorithm>
#include <cstddef>
#include <set>
#include <sstream>

#include "symbolic/calculus.hpp"
#include "symbolic/printing.hpp"

namespace demecal::inline symbolic {
namespace {

constexpr const char* kRadiusRemarks[] = {
    "The radius, m, that holds the real tool point 95 % of the time about where a corrected command sends it (k = 2),",
    "as demecal's library and apply have it: by the covariance of the model's numbers and by its own error, without",
    "measurement noise and without what is not known of where the base stands, and widened by judgement where joints,",
    "payload or temperature are outside of what was measured, and there by what the joints' corrections may be off by.",
    "It is of the robot's own tool. Not in it: what a command leaves uncorrected (see corrected), sides of approach",
    "and payloads that are not known, and how the arm ages."};

class RadiusWriter {
 public:
  RadiusWriter(const RadiusListing& radius, const Listing& listing, CodeLanguage language)
      : radius_(radius), listing_(listing), printer_(language), expressions_(radius.expressions()) {
    for (const Expression term : terms_of(expressions_))
      if (term->kind == ExpressionKind::symbol) used_.insert(term->name);
    for (const std::vector<double>& row : radius.factor) columns_ = std::max(columns_, row.size());
  }

  std::string c() const;
  std::string python() const;
  std::string matlab() const;

 private:
  std::size_t rows() const { return radius_.spread.size(); }
  std::string remarks(const std::string& mark) const {
    std::string all;
    for (const char* const line : kRadiusRemarks) all += mark + line + '\n';
    return all;
  }
  /// Each number of the factor's rows in their order.
  std::string numbers(const std::string& indent) const {
    std::string all;
    for (const std::vector<double>& row : radius_.factor) {
      std::string line = indent;
      for (const double number : row) line += printer_.number(number) + ", ";
      line.back() = '\n';
      all += line;
    }
    return all;
  }
  std::string lengths() const {
    std::string all;
    for (const std::vector<double>& row : radius_.factor) all += (all.empty() ? "" : ", ") + std::to_string(row.size());
    return all;
  }
  std::string symbols(const std::string& before, const std::string& owner, const std::string& after) const;
  Steps steps() const { return plan_steps(expressions_, printer_, "r"); }
  std::string warming(std::size_t end) const { return printer_.number((*radius_.warming)[end]); }

  const RadiusListing& radius_;
  const Listing& listing_;
  ExpressionPrinter printer_;
  std::vector<Expression> expressions_;
  std::set<std::string> used_{};
  std::size_t columns_ = 0;
};

/// What the expressions are of, from the arguments of the function.
std::string RadiusWriter::symbols(const std::string& before, const std::string& owner, const std::string& after) const {
  const bool matlab = printer_.language() == CodeLanguage::matlab;
  std::string all;
  const auto add = [&](const std::string& name, const std::string& value) {
    if (used_.contains(name) && name != value) all.append(before).append(name).append(" = ").append(value + after);
  };
  add(kPayload, owner + kPayload);
  add(kWarming, owner + kWarming);
  for (std::size_t i = 0; i < listing_.actual.size(); ++i) {
    const auto joint = static_cast<int>(i + 1);
    const std::string index = matlab ? "(" + std::to_string(i + 1) + ")" : "[" + std::to_string(i) + "]";
    add(approach_symbol(joint), owner + "approach" + index);
    add(commanded_joint(joint), "q" + index);
    add(actual_joint(joint), "h" + std::to_string(joint) + "(q" + index + ")");
  }
  return all;
}

std::string RadiusWriter::c() const {
  const std::string joints = std::to_string(listing_.actual.size());
  const std::string arguments = "const struct circumstances* at, const double q[" + joints + "]";
  const std::size_t n = rows();
  std::ostringstream out;
  out << "\n/* " << remarks("").substr(0, remarks("").size() - 1) << " */\n"
      << "enum { RADIUS_NUMBERS = " << n << ", RADIUS_COLUMNS = " << columns_ << " };\n"
      << "static const short radius_lengths[] = {" << lengths() << "};\n"
      << "static const double radius_factor[] = {\n"
      << numbers("  ") << "};\n\n"
      << "/* How the tool point moves with each number, where it is, and by what the radius is widened: by joints and\n"
      << "payload, by warmth, and by the square of what corrections may be off by. */\nstatic void radius_terms("
      << arguments << ", double spread[RADIUS_NUMBERS][3], double point[3], double widened[3]) {\n  (void)at;\n"
      << symbols("  const double ", "at->", ";\n");
  const Steps all = steps();
  for (const auto& [name, value] : all.assignments) out << "  const double " << name << " = " << value << ";\n";
  for (std::size_t i = 0; i < 3 * n; ++i)
    out << "  spread[" << i / 3 << "][" << i % 3 << "] = " << all.results[i] << ";\n";
  for (std::size_t i = 0; i < 3; ++i) out << "  point[" << i << "] = " << all.results[3 * n + i] << ";\n";
  for (std::size_t i = 0; i < 3; ++i) out << "  widened[" << i << "] = " << all.results[3 * n + 3 + i] << ";\n";
  out << "}\n\nstatic double radius_of(" << arguments << ", int temperature_stated) {\n"
      << "  double spread[RADIUS_NUMBERS][3], sums[RADIUS_COLUMNS][3] = {{0.0}}, point[3], widened[3];\n"
      << "  double square = " << printer_.number(radius_.square_m2) << ", unstated = 0.0;\n"
      << "  int k = 0;\n  radius_terms(at, q, spread, point, widened);\n"
      << "  for (int i = 0; i < RADIUS_NUMBERS; ++i)\n    for (int c = 0; c < radius_lengths[i]; ++c, ++k)\n"
      << "      for (int x = 0; x < 3; ++x) sums[c][x] += spread[i][x]*radius_factor[k];\n"
      << "  for (int c = 0; c < RADIUS_COLUMNS; ++c)\n"
      << "    for (int x = 0; x < 3; ++x) square += sums[c][x]*sums[c][x];\n";
  if (radius_.warming)
    out << "  if (!temperature_stated) {\n    static const double ends[2] = {" << warming(0) << ", " << warming(1)
        << "};\n    for (int end = 0; end < 2; ++end) {\n      struct circumstances warm = *at;\n"
        << "      double moved[3], ignored[3], away = 0.0;\n      warm.warming_kelvin = ends[end];\n"
        << "      radius_terms(&warm, q, spread, moved, ignored);\n"
        << "      for (int x = 0; x < 3; ++x) away += (moved[x] - point[x])*(moved[x] - point[x]);\n"
        << "      if (sqrt(away) > unstated) unstated = sqrt(away);\n    }\n  }\n";
  out << "  const double times = (widened[0] + (temperature_stated ? widened[1] : 0.0))*"
      << printer_.number(radius_.quantile) << ";\n  return sqrt(times*times*square + widened[2]) + unstated;\n}\n\n"
      << "/* Under the circumstances that are stated. */\ndouble radius95_at(" << arguments
      << ") {\n  return radius_of(at, q, 1);\n}\n\n"
      << "/* With nothing carried, where nobody knows how warm the arm is: of all temperatures that were measured. */\n"
      << "double radius95(const double q[" << joints
      << "]) {\n  const struct circumstances none = {0};\n  return radius_of(&none, q, 0);\n}\n";
  return out.str();
}

std::string RadiusWriter::python() const {
  const std::size_t n = rows(), joints = listing_.actual.size();
  std::ostringstream out;
  out << "\n\n" << remarks("# ") << "_RADIUS_FACTOR = (\n";
  for (const std::vector<double>& row : radius_.factor) {
    out << "    (";
    for (const double number : row) out << printer_.number(number) << ", ";
    out << "),\n";
  }
  out << ")\n\n\ndef _radius_terms(q, payload_kg, warming_kelvin, approach):\n" << symbols("    ", "", "\n");
  const Steps all = steps();
  for (const auto& [name, value] : all.assignments) out << "    " << name << " = " << value << '\n';
  const auto triple = [&](std::size_t first) {
    return "(" + all.results[first] + ", " + all.results[first + 1] + ", " + all.results[first + 2] + ")";
  };
  out << "    return (\n        (\n";
  for (std::size_t i = 0; i < n; ++i) out << "            " << triple(3 * i) << ",\n";
  out << "        ),\n        " << triple(3 * n) << ",\n        " << all.results[3 * n + 3] << ",\n        "
      << all.results[3 * n + 4] << ",\n        " << all.results[3 * n + 5] << ",\n    )\n\n\n"
      << "def radius95(q, payload_kg=0.0, warming_kelvin=None, approach=None):\n"
      << "    # warming_kelvin None: nobody knows how warm the arm is, and the radius is of all that was measured.\n"
      << "    approach = approach or [0.0]*" << joints << '\n'
      << "    stated = 0.0 if warming_kelvin is None else warming_kelvin\n"
      << "    spread, point, widened, by_warming, held_square = _radius_terms(q, payload_kg, stated, approach)\n"
      << "    sums = [[0.0]*3 for _ in range(" << columns_ << ")]\n"
      << "    for moves, row in zip(spread, _RADIUS_FACTOR):\n        for column, factor in enumerate(row):\n"
      << "            for x in range(3):\n                sums[column][x] += moves[x]*factor\n"
      << "    square = " << printer_.number(radius_.square_m2) << " + sum(s*s for column in sums for s in column)\n"
      << "    unstated = 0.0\n";
  if (radius_.warming)
    out << "    if warming_kelvin is None:\n        for end in (" << warming(0) << ", " << warming(1)
        << "):\n            moved = _radius_terms(q, payload_kg, end, approach)[1]\n"
        << "            unstated = max(unstated, math.sqrt(sum((a - b)**2 for a, b in zip(moved, point))))\n";
  out << "    if warming_kelvin is not None:\n        widened += by_warming\n    times = widened*"
      << printer_.number(radius_.quantile) << "\n    return math.sqrt(times*times*square + held_square) + unstated\n";
  return out.str();
}

std::string RadiusWriter::matlab() const {
  const std::size_t n = rows();
  std::ostringstream out;
  out << "\nfunction r = radius_of(q, payload_kg, warming_kelvin, approach, temperature_stated)\n"
      << remarks("% ") << "  lengths = [" << lengths() << "];\n  factor = [ ...\n";
  for (const std::vector<double>& row : radius_.factor) {
    out << "    ";
    for (const double number : row) out << printer_.number(number) << ", ";
    out << "...\n";
  }
  out << "  ];\n  [spread, point, widened] = radius_terms(q, payload_kg, warming_kelvin, approach);\n"
      << "  sums = zeros(" << columns_ << ", 3);\n  k = 0;\n  for i = 1:" << n
      << "\n    for c = 1:lengths(i)\n      k = k + 1;\n      sums(c, :) = sums(c, :) + spread(i, :)*factor(k);\n"
      << "    end\n  end\n  unstated = 0;\n  if temperature_stated\n    widened(1) = widened(1) + widened(2);\n";
  if (radius_.warming)
    out << "  else\n    for warm = [" << warming(0) << ", " << warming(1)
        << "]\n      [~, moved] = radius_terms(q, payload_kg, warm, approach);\n"
        << "      unstated = max(unstated, norm(moved - point));\n    end\n";
  out << "  end\n  times = widened(1)*" << printer_.number(radius_.quantile) << ";\n  r = sqrt(times^2*("
      << printer_.number(radius_.square_m2) << " + sum(sum(sums.^2))) + widened(3)) + unstated;\nend\n\n"
      << "function [spread, point, widened] = radius_terms(q, payload_kg, warming_kelvin, approach)\n"
      << symbols("  ", "", ";\n");
  const Steps all = steps();
  for (const auto& [name, value] : all.assignments) out << "  " << name << " = " << value << ";\n";
  out << "  spread = zeros(" << n << ", 3);\n";
  for (std::size_t i = 0; i < 3 * n; ++i)
    out << "  spread(" << i / 3 + 1 << ", " << i % 3 + 1 << ") = " << all.results[i] << ";\n";
  out << "  point = [" << all.results[3 * n] << ", " << all.results[3 * n + 1] << ", " << all.results[3 * n + 2]
      << "];\n  widened = [" << all.results[3 * n + 3] << ", " << all.results[3 * n + 4] << ", "
      << all.results[3 * n + 5] << "];\nend\n";
  return out.str();
}

}  // namespace

std::vector<Expression> RadiusListing::expressions() const {
  std::vector<Expression> all;
  for (const std::array<Expression, 3>& moves : spread) all.insert(all.end(), moves.begin(), moves.end());
  all.insert(all.end(), point.begin(), point.end());
  all.push_back(widened);
  all.push_back(widened_by_warming);
  all.push_back(held_square_m2);
  return all;
}

std::string radius_code(const RadiusListing& radius, const Listing& listing, CodeLanguage language) {
  if (radius.spread.empty() || !listing.reference_celsius) return {};
  const RadiusWriter writer(radius, listing, language);
  if (language == CodeLanguage::c) return writer.c();
  if (language == CodeLanguage::python) return writer.python();
  return language == CodeLanguage::matlab ? writer.matlab() : std::string();
}

}  // namespace demecal::inline symbolic

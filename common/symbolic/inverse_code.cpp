#include <algorithm>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

#include "symbolic/algebra.hpp"
#include "symbolic/calculus.hpp"
#include "symbolic/code.hpp"
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
  out << "static void nominal_forward(const double q[N], double pose[16]) {\n";
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

// Newton's steps with the described arm's Jacobian, which is cheap: a calibrated arm's differs from it by thousandths,
// so that every step takes away all but thousandths of the error, but near singular postures, where its own Jacobian
// takes over. Turns weigh as a lever of LEVER metres. Damping keeps steps bounded
// where the Jacobian is singular.
constexpr const char* kSolver =
    R"code(/* What takes the tool from `pose` to `goal`: metres, and turns times LEVER; exact to second order of the turn. */
static void pose_error(const double goal[16], const double pose[16], double error[6]) {
  error[0] = goal[3] - pose[3];
  error[1] = goal[7] - pose[7];
  error[2] = goal[11] - pose[11];
  error[3] = error[4] = error[5] = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double *p = pose + k, *g = goal + k;
    error[3] += 0.5*LEVER*(p[4]*g[8] - p[8]*g[4]);
    error[4] += 0.5*LEVER*(p[8]*g[0] - p[0]*g[8]);
    error[5] += 0.5*LEVER*(p[0]*g[4] - p[4]*g[0]);
  }
}

/* The lower triangle of a root of J'J + damping, of an arm at joints q. */
static void factorize(void (*arm)(const double[N], double[16]), const double q[N], double jacobian[6][N],
                      double root[N][N]) {
  double here[16], there[16], moved[N], column[6], trace = 0.0;
  arm(q, here);
  for (int k = 0; k < N; ++k) {
    for (int i = 0; i < N; ++i) moved[i] = q[i];
    moved[k] += STEP;
    arm(moved, there);
    pose_error(there, here, column);
    for (int i = 0; i < 6; ++i) jacobian[i][k] = column[i]/STEP;
  }
  for (int r = 0; r < N; ++r) {
    for (int c = 0; c <= r; ++c) {
      root[r][c] = 0.0;
      for (int i = 0; i < 6; ++i) root[r][c] += jacobian[i][r]*jacobian[i][c];
    }
    trace += root[r][r];
  }
  for (int r = 0; r < N; ++r) root[r][r] += DAMPING*trace;
  for (int c = 0; c < N; ++c) {
    for (int k = 0; k < c; ++k) root[c][c] -= root[c][k]*root[c][k];
    root[c][c] = sqrt(root[c][c] > 0.0 ? root[c][c] : DAMPING*trace);
    for (int r = c + 1; r < N; ++r) {
      for (int k = 0; k < c; ++k) root[r][c] -= root[r][k]*root[c][k];
      root[r][c] /= root[c][c];
    }
  }
}

/* Joints to command so that the calibrated tool stands at `goal` (row by row, as of forward): `q` holds joints nearby
   and is overwritten. At most 32 steps, no memory is allocated. Returns how far the tool then is from the goal, in m,
   turns counted at a lever of a quarter of a metre: above 1e-6 it was not reached. */
double inverse(const double goal[16], double q[N]) {
  double jacobian[6][N], root[N][N], pose[16], error[6], step[N], left = 0.0, before = 1e300;
  for (int round = 0; round <= 32; ++round) {
    double square = 0.0, largest = 0.0;
    forward(q, pose);
    pose_error(goal, pose, error);
    for (int i = 0; i < 6; ++i) square += error[i]*error[i];
    left = sqrt(square);
    if (left < 1e-10 || round == 32) break;
    if (round % 8 == 0) {
      if (left > 0.9*before) break; /* beyond its reach */
      before = left;
    }
    if (round == 0) factorize(nominal_forward, q, jacobian, root);
    if (round > 3 && round % 2 == 0) factorize(forward, q, jacobian, root);
    for (int r = 0; r < N; ++r) {
      step[r] = 0.0;
      for (int i = 0; i < 6; ++i) step[r] += jacobian[i][r]*error[i];
      for (int k = 0; k < r; ++k) step[r] -= root[r][k]*step[k];
      step[r] /= root[r][r];
    }
    for (int r = N - 1; r >= 0; --r) {
      for (int k = r + 1; k < N; ++k) step[r] -= root[k][r]*step[k];
      step[r] /= root[r][r];
      if (fabs(step[r]) > largest) largest = fabs(step[r]);
    }
    for (int r = 0; r < N; ++r) q[r] += largest > 0.1 ? 0.1/largest*step[r] : step[r];
  }
  return left;
}

/* Joints to command so that the calibrated tool stands where the arm and the tool as they are described, in the same
   base, would stand at `nominal`. Returns as inverse does. */
double corrected(const double nominal[N], double command[N]) {
  double goal[16];
  nominal_forward(nominal, goal);
  for (int i = 0; i < N; ++i) command[i] = nominal[i];
  return inverse(goal, command);
}
)code";

}  // namespace

std::string inverse_in_c(const Listing& nominal) {
  return "\n#define N " + std::to_string(nominal.actual.size()) +
         "\n#define LEVER 0.25\n#define STEP 1e-5\n#define DAMPING 1e-13\n\n" + nominal_forward(nominal) + kSolver;
}

}  // namespace demecal::inline symbolic

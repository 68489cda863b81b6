#include <cstddef>
#include <string>

#include "symbolic/inverse_solver.hpp"

namespace demecal::inline symbolic {
namespace {

// Of six joints and more, as nearby_command() does it; the squares of singular values are those of J J'.
constexpr const char* kApproach =
    R"code(/* Diagonalizes a symmetric matrix by Jacobi's turns, by which the columns of `vectors` are turned too. */
static void diagonalize(double matrix[6][6], double vectors[6][6]) {
  for (int sweep = 0; sweep < 12; ++sweep) {
    double off = 0.0, trace = 0.0;
    for (int i = 0; i < 6; ++i) {
      trace += matrix[i][i];
      for (int k = 0; k < i; ++k) off += matrix[i][k]*matrix[i][k];
    }
    const double least = 1e-22*trace*trace;
    if (!(off > least)) break;
    for (int p = 0; p < 5; ++p) {
      for (int r = p + 1; r < 6; ++r) {
        if (matrix[p][r]*matrix[p][r] <= least/15.0) continue; /* one of 15 */
        const double ratio = 0.5*(matrix[r][r] - matrix[p][p])/matrix[p][r];
        const double t = (ratio < 0.0 ? -1.0 : 1.0)/(fabs(ratio) + sqrt(ratio*ratio + 1.0));
        const double c = 1.0/sqrt(t*t + 1.0), s = t*c;
        for (int i = 0; i < 6; ++i) {
          const double one = matrix[i][p], other = matrix[i][r];
          matrix[i][p] = c*one - s*other;
          matrix[i][r] = s*one + c*other;
        }
        for (int i = 0; i < 6; ++i) {
          const double one = matrix[p][i], other = matrix[r][i], v = vectors[i][p], w = vectors[i][r];
          matrix[p][i] = c*one - s*other;
          matrix[r][i] = s*one + c*other;
          vectors[i][p] = c*v - s*w;
          vectors[i][r] = s*v + c*w;
        }
      }
    }
  }
}

/* Newton's steps from q, which `first` belongs to, in the directions that the arm has not lost: those with singular
   values above LOST, positions counting over `length`. They are taken at q and two steps on, where they are nearly what
   they were, and hardly change from there. */
static void keep_to(const struct circumstances* at, const double goal[16], double length,
                    const struct linearization* first, double q[N]) {
  struct linearization here = *first;
  double jacobian[6][N], turned[6][N], square[6][6], vectors[6][6], error[6], along[6];
  for (int i = 0; i < 6; ++i)
    for (int k = 0; k < 6; ++k) vectors[i][k] = i == k ? 1.0 : 0.0;
  for (int round = 0; round < 16; ++round) {
    double moved = 0.0;
    if (round == 2) linearize_at(at, goal, q, &here);
    else if (round > 0) here.left = measure(at, goal, q, here.error);
    for (int i = 0; i < 6; ++i) error[i] = here.error[i]/(i < 3 ? length : LEVER);
    if (round == 0 || round == 2) {
      for (int i = 0; i < 6; ++i)
        for (int k = 0; k < N; ++k) jacobian[i][k] = here.jacobian[i][k]/(i < 3 ? length : LEVER);
      for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < N; ++j) {
          double sum = 0.0;
          for (int k = 0; k < 6; ++k) sum += vectors[k][i]*jacobian[k][j];
          turned[i][j] = sum;
        }
        for (int k = 0; k <= i; ++k) {
          double sum = 0.0;
          for (int j = 0; j < N; ++j) sum += turned[i][j]*turned[k][j];
          square[i][k] = square[k][i] = sum;
        }
      }
      diagonalize(square, vectors);
    }
    for (int i = 0; i < 6; ++i) along[i] = 0.0;
    for (int k = 0; k < 6; ++k) {
      double share = 0.0;
      if (square[k][k] <= LOST*LOST) continue;
      for (int i = 0; i < 6; ++i) share += vectors[i][k]*error[i];
      for (int i = 0; i < 6; ++i) along[i] += vectors[i][k]*share/square[k][k];
    }
    for (int k = 0; k < N; ++k) {
      double step = 0.0;
      for (int i = 0; i < 6; ++i) step += jacobian[i][k]*along[i];
      moved += step*step;
      q[k] += step;
    }
    if (!(moved > 1e-20)) break;
  }
}

/* The joints that bring the tool nearest to the goal in the directions that the arm has not lost, of position rather
   than of orientation; of both alike where that takes a joint farther than `far`. */
static void approach(const struct circumstances* at, const double goal[16], double far,
                     const struct linearization* first, double q[N]) {
  double start[N];
  for (int i = 0; i < N; ++i) start[i] = q[i];
  keep_to(at, goal, FIRST, first, q);
  if (largest_motion(q, start) <= far) return;
  for (int i = 0; i < N; ++i) q[i] = start[i];
  keep_to(at, goal, LENGTH, first, q);
}

)code";

// Of fewer joints, as damped_least_squares() does it.
constexpr const char* kApproachByFew =
    R"code(/* The derivatives of the pose `here` at joints q, by differences on both sides. */
static void differentiate(const struct circumstances* at, const double q[N], const double here[16],
                          double jacobian[6][N]) {
  double there[16], moved[N], after[6], before[6];
  for (int i = 0; i < N; ++i) moved[i] = q[i];
  for (int k = 0; k < N; ++k) {
    moved[k] = q[k] + STEP;
    forward_at(at, moved, there);
    pose_error(there, here, after);
    moved[k] = q[k] - STEP;
    forward_at(at, moved, there);
    pose_error(there, here, before);
    for (int i = 0; i < 6; ++i) jacobian[i][k] = 0.5*(after[i] - before[i])/STEP;
    moved[k] = q[k];
  }
}

/* What the nearest joints make least: errors, positions counting over FIRST, and CALM times the joints' motion. */
static double cost_of(const double goal[16], const double pose[16], const double q[N], const double start[N],
                      double error[6]) {
  double cost = 0.0;
  pose_error(goal, pose, error);
  for (int i = 0; i < 6; ++i) {
    error[i] /= i < 3 ? FIRST : LEVER;
    cost += error[i]*error[i];
  }
  for (int i = 0; i < N; ++i) cost += CALM*CALM*(q[i] - start[i])*(q[i] - start[i]);
  return cost;
}

/* The joints that bring the tool nearest to the goal, of position rather than of orientation: too few for both. */
static void approach(const struct circumstances* at, const double goal[16], double far,
                     const struct linearization* first, double q[N]) {
  double jacobian[6][N], root[N][N], pose[16], error[6], step[N], start[N], tried[N];
  (void)far;
  (void)first;
  for (int i = 0; i < N; ++i) start[i] = q[i];
  forward_at(at, q, pose);
  double cost = cost_of(goal, pose, q, start, error);
  for (int round = 0; round < 30; ++round) {
    double share = 1.0, lower = cost;
    differentiate(at, q, pose, jacobian);
    for (int i = 0; i < 6; ++i)
      for (int k = 0; k < N; ++k) jacobian[i][k] /= i < 3 ? FIRST : LEVER;
    factorize(jacobian, CALM*CALM, root);
    for (int k = 0; k < N; ++k) {
      step[k] = -CALM*CALM*(q[k] - start[k]);
      for (int i = 0; i < 6; ++i) step[k] += jacobian[i][k]*error[i];
    }
    substitute(root, step);
    for (; share > 1e-4; share *= 0.5) {
      for (int k = 0; k < N; ++k) tried[k] = q[k] + share*step[k];
      forward_at(at, tried, pose);
      lower = cost_of(goal, pose, tried, start, error);
      if (lower < cost) break;
    }
    if (!(lower < cost)) return;
    for (int k = 0; k < N; ++k) q[k] = tried[k];
    cost = lower;
  }
}

)code";

constexpr const char* kFunctions =
    R"code(/* Joints at which the tool is at the goal, none farther than `freely` and a few times the way from where it was, nor
   than `most`; where there are none, near singular joints or beyond the arm's reach, the nearest that there are. */
static double solve(const struct circumstances* at, const double goal[16], double freely, double most,
                    double q[N]) {
  struct linearization first;
  double start[N], error[6];
  for (int i = 0; i < N; ++i) start[i] = q[i];
  linearize_at(at, goal, start, &first);
  const double far = GAIN*angle_of(first.error) + freely;
  if (far < most) most = far;
  const double left = reach(at, goal, most, &first, q);
  if (left < 1e-6 && largest_motion(q, start) <= most) return left;
  for (int i = 0; i < N; ++i) q[i] = start[i];
  approach(at, goal, far, &first, q);
  return measure(at, goal, q, error);
}

/* Joints to command so that the calibrated tool stands at `goal` (row by row, as of forward): `q` holds joints nearby
   and is overwritten. Bounded steps, no memory is allocated. Returns how far the tool then is from the goal, in m, turns
   counted at a lever of a quarter of a metre: above 1e-6 the goal was not reached, and joints are those that bring the
   tool near to it without moving by more than 3 degrees and a few times the way there. */
double inverse_at(const struct circumstances* at, const double goal[16], double q[N]) {
  struct linearization first;
  double again[N];
  const double left = solve(at, goal, NEARBY, 1e300, q);
  if (left < 1e-10 || left > 1e-4) return left;
  for (int i = 0; i < N; ++i) again[i] = q[i];
  linearize_at(at, goal, q, &first);
  const double closer = reach(at, goal, NEARBY, &first, again);
  if (!(closer < left && largest_motion(again, q) <= NEARBY)) return left;
  for (int i = 0; i < N; ++i) q[i] = again[i];
  return closer;
}

/* Joints to command so that the calibrated tool stands where the arm and the tool as they are described, in the same
   base, would stand at `nominal`. Near singular joints what would move them by more than a few times the correction is
   left, of orientation rather than of position. Returns what is left, as inverse_at does. */
double corrected_at(const struct circumstances* at, const double nominal[N], double command[N]) {
  double goal[16];
  nominal_forward(at, nominal, goal);
  for (int i = 0; i < N; ++i) command[i] = nominal[i];
  return solve(at, goal, 2e-4, 0.5, command);
}

/* The same with all circumstances 0. */
double inverse(const double goal[16], double q[N]) {
  const struct circumstances none = {0};
  return inverse_at(&none, goal, q);
}
double corrected(const double nominal[N], double command[N]) {
  const struct circumstances none = {0};
  return corrected_at(&none, nominal, command);
}

/* Notes from which side a motion between two stops brings the joints; those that it does not move keep theirs. */
void note_motion(struct circumstances* at, const double from[N], const double to[N]) {
  for (int i = 0; i < N; ++i)
    if (fabs(to[i] - from[i]) > 1e-9) at->approach[i] = to[i] > from[i] ? 1.0 : -1.0;
}
)code";

}  // namespace

std::string bounded_inverse_in_c(std::size_t joints) {
  constexpr std::size_t kWhole = 6;
  return std::string(joints < kWhole ? kApproachByFew : kApproach) + kFunctions;
}

}  // namespace demecal::inline symbolic

#include "symbolic/inverse_solver.hpp"

#include <string>

namespace demecal::inline symbolic {
namespace {

// Newton's steps first, with the calibrated arm's own Jacobian; from where they take joints too far, near singular
// postures, again and damped so that steps stay within what joints may move. Turns weigh as a lever of LEVER metres.
constexpr const char* kReach =
    R"code(/* A turn of more than a right angle, which its sine does not tell: the angle times the axis, which the largest column
   of the turn's symmetric part shows, and `turn` (the sine times the axis) the side of. */
static void far_turn(const double goal[16], const double pose[16], double cosine, double turn[3]) {
  double axis[3], largest = 0.0, square = 0.0, side = 0.0;
  int column = 0;
  for (int i = 0; i < 3; ++i) {
    const double *p = pose + 4*i, *g = goal + 4*i;
    const double diagonal = p[0]*g[0] + p[1]*g[1] + p[2]*g[2] - cosine;
    if (diagonal > largest) column = i;
    if (diagonal > largest) largest = diagonal;
  }
  for (int i = 0; i < 3; ++i) {
    axis[i] = i == column ? -cosine : 0.0;
    for (int k = 0; k < 3; ++k)
      axis[i] += 0.5*(goal[4*i + k]*pose[4*column + k] + goal[4*column + k]*pose[4*i + k]);
    square += axis[i]*axis[i];
    side += axis[i]*turn[i];
  }
  const double sine = sqrt(turn[0]*turn[0] + turn[1]*turn[1] + turn[2]*turn[2]);
  const double scale = (side < 0.0 ? -1.0 : 1.0)*atan2(sine, cosine)/sqrt(square);
  for (int i = 0; i < 3; ++i) turn[i] = scale*axis[i];
}

/* What takes the tool from `pose` to `goal`: metres, and turns times LEVER, exact to second order of small ones. */
static void pose_error(const double goal[16], const double pose[16], double error[6]) {
  double turn[3] = {0.0, 0.0, 0.0}, cosine = -0.5;
  for (int k = 0; k < 3; ++k) {
    const double *p = pose + k, *g = goal + k;
    turn[0] += 0.5*(p[4]*g[8] - p[8]*g[4]);
    turn[1] += 0.5*(p[8]*g[0] - p[0]*g[8]);
    turn[2] += 0.5*(p[0]*g[4] - p[4]*g[0]);
    cosine += 0.5*(p[0]*g[0] + p[4]*g[4] + p[8]*g[8]);
  }
  if (cosine < 0.0) far_turn(goal, pose, cosine, turn);
  for (int i = 0; i < 3; ++i) {
    error[i] = goal[4*i + 3] - pose[4*i + 3];
    error[3 + i] = LEVER*turn[i];
  }
}

static double norm_of(const double error[6]) {
  double square = 0.0;
  for (int i = 0; i < 6; ++i) square += error[i]*error[i];
  return sqrt(square);
}

/* The way in rad, positions counting over LENGTH. */
static double angle_of(const double error[6]) {
  double square = 0.0;
  for (int i = 0; i < 3; ++i) square += error[i]*error[i]/(LENGTH*LENGTH) + error[3 + i]*error[3 + i]/(LEVER*LEVER);
  return sqrt(square);
}

/* How far the joint that moved most is from where it was. */
static double largest_motion(const double q[N], const double from[N]) {
  double largest = 0.0;
  for (int i = 0; i < N; ++i)
    if (!(fabs(q[i] - from[i]) <= largest)) largest = fabs(q[i] - from[i]);
  return largest;
}

/* How far the tool is from the goal at joints q, and what is missing. */
static double measure(const struct circumstances* at, const double goal[16], const double q[N], double error[6]) {
  double pose[16];
  forward_at(at, q, pose);
  pose_error(goal, pose, error);
  return norm_of(error);
}

/* The same with the derivatives there. */
struct linearization {
  double left, error[6], jacobian[6][N];
};

static void linearize_at(const struct circumstances* at, const double goal[16], const double q[N],
                         struct linearization* here) {
  double pose[16];
  linearize(at, q, pose, here->jacobian);
  pose_error(goal, pose, here->error);
  here->left = norm_of(here->error);
}

/* The lower triangle of a root of J'J + damping, with the inverses of its diagonal. */
static void factorize(double jacobian[6][N], double damping, double root[N][N]) {
  double trace = 0.0;
  for (int r = 0; r < N; ++r) {
    for (int c = 0; c <= r; ++c) {
      double sum = 0.0;
      for (int i = 0; i < 6; ++i) sum += jacobian[i][r]*jacobian[i][c];
      root[r][c] = sum;
    }
    trace += root[r][r];
  }
  for (int c = 0; c < N; ++c) {
    double square = root[c][c] + DAMPING*trace + damping;
    for (int k = 0; k < c; ++k) square -= root[c][k]*root[c][k];
    root[c][c] = 1.0/sqrt(square > 0.0 ? square : DAMPING*trace);
    for (int r = c + 1; r < N; ++r) {
      double sum = root[r][c];
      for (int k = 0; k < c; ++k) sum -= root[r][k]*root[c][k];
      root[r][c] = sum*root[c][c];
    }
  }
}

/* The step from its `downhill`: by the root's both triangles, in place. */
static void substitute(double root[N][N], double step[N]) {
  for (int r = 0; r < N; ++r) {
    double sum = step[r];
    for (int k = 0; k < r; ++k) sum -= root[r][k]*step[k];
    step[r] = sum*root[r][r];
  }
  for (int r = N - 1; r >= 0; --r) {
    double sum = step[r];
    for (int k = r + 1; k < N; ++k) sum -= root[k][r]*step[k];
    step[r] = sum*root[r][r];
  }
}

/* Moves joints by Newton's step, none by more than 0.1. */
static void take_step(double jacobian[6][N], double root[N][N], const double error[6], double q[N]) {
  double step[N], largest = 0.0;
  for (int r = 0; r < N; ++r) {
    step[r] = 0.0;
    for (int i = 0; i < 6; ++i) step[r] += jacobian[i][r]*error[i];
  }
  substitute(root, step);
  for (int r = 0; r < N; ++r)
    if (fabs(step[r]) > largest) largest = fabs(step[r]);
  for (int r = 0; r < N; ++r) q[r] += largest > 0.1 ? 0.1/largest*step[r] : step[r];
}

/* Newton's steps from q, which `first` belongs to, while no joint is farther than `most` from where it was: in 5 plain
   ones, or else damped. Behind a step from so near as CLOSE the derivatives are still right. */
static double reach(const struct circumstances* at, const double goal[16], double most,
                    const struct linearization* first, double q[N]) {
  struct linearization here = *first;
  double root[N][N], start[N], before = here.left;
  int damped = 0, known = 0;
  for (int i = 0; i < N; ++i) start[i] = q[i];
  for (int round = 0; round < 32 && here.left >= 1e-10; ++round) {
    if (!known) factorize(here.jacobian, damped ? 0.5*here.left*here.left/(most*most) : 0.0, root);
    take_step(here.jacobian, root, here.error, q);
    const double moved = largest_motion(q, start);
    if (!damped && (round == 5 || !(moved <= most))) {
      here = *first;
      for (int i = 0; i < N; ++i) q[i] = start[i];
      damped = 1;
      known = 0;
      round = 3;
      continue;
    }
    if (moved > 2.0*most) return INFINITY;
    known = here.left < CLOSE;
    if (known) here.left = measure(at, goal, q, here.error);
    else linearize_at(at, goal, q, &here);
    if (damped && round % 4 == 3) {
      if (here.left > 0.9*before) break; /* beyond its reach */
      before = here.left;
    }
  }
  return here.left;
}

)code";

}  // namespace

std::string inverse_constants_in_c() {
  return "#define LEVER 0.25\n#define STEP 1e-5\n#define CLOSE 1e-5\n#define DAMPING 1e-13\n#define LENGTH "
         "0.3\n#define FIRST 0.01\n"
         "#define LOST 0.125\n#define GAIN 3.0\n#define CALM 0.02\n#define NEARBY 0.05\n\n";
}

std::string reach_in_c() {
  return kReach;
}

}  // namespace demecal::inline symbolic

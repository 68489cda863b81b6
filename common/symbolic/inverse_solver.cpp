#include "symbolic/inverse_solver.hpp"

#include <string>

namespace demecal::inline symbolic {
namespace {

// Newton's steps first with the described arm's Jacobian, which is cheap: a calibrated arm's differs from it by
// thousandths, so that every step takes away all but thousandths of the error, but near singular postures, where its
// own Jacobian takes over, damped so that steps stay within what joints may move. Turns weigh as a lever of LEVER
// metres.
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

/* The derivatives of an arm's pose `here` at joints q, by differences; `central`: on both sides. */
static void differentiate(void (*arm)(const struct circumstances*, const double[N], double[16]),
                          const struct circumstances* at, const double q[N], const double here[16], int central,
                          double jacobian[6][N]) {
  double there[16], moved[N], column[6], before[6];
  for (int i = 0; i < N; ++i) moved[i] = q[i];
  for (int k = 0; k < N; ++k) {
    moved[k] = q[k] + STEP;
    arm(at, moved, there);
    pose_error(there, here, column);
    for (int i = 0; i < 6; ++i) jacobian[i][k] = column[i]/STEP;
    if (central) {
      moved[k] = q[k] - STEP;
      arm(at, moved, there);
      pose_error(there, here, before);
      for (int i = 0; i < 6; ++i) jacobian[i][k] = 0.5*(column[i] - before[i])/STEP;
    }
    moved[k] = q[k];
  }
}

/* The lower triangle of a root of J'J + damping. */
static void factorize(double jacobian[6][N], double damping, double root[N][N]) {
  double trace = 0.0;
  for (int r = 0; r < N; ++r) {
    for (int c = 0; c <= r; ++c) {
      root[r][c] = 0.0;
      for (int i = 0; i < 6; ++i) root[r][c] += jacobian[i][r]*jacobian[i][c];
    }
    trace += root[r][r];
  }
  for (int r = 0; r < N; ++r) root[r][r] += DAMPING*trace + damping;
  for (int c = 0; c < N; ++c) {
    for (int k = 0; k < c; ++k) root[c][c] -= root[c][k]*root[c][k];
    root[c][c] = sqrt(root[c][c] > 0.0 ? root[c][c] : DAMPING*trace);
    for (int r = c + 1; r < N; ++r) {
      for (int k = 0; k < c; ++k) root[r][c] -= root[r][k]*root[c][k];
      root[r][c] /= root[c][c];
    }
  }
}

/* The step from its `downhill`: by the root's both triangles, in place. */
static void substitute(double root[N][N], double step[N]) {
  for (int r = 0; r < N; ++r) {
    for (int k = 0; k < r; ++k) step[r] -= root[r][k]*step[k];
    step[r] /= root[r][r];
  }
  for (int r = N - 1; r >= 0; --r) {
    for (int k = r + 1; k < N; ++k) step[r] -= root[k][r]*step[k];
    step[r] /= root[r][r];
  }
}

/* Newton's steps from q, while no joint is farther than `most` from where it was. */
static double reach(const struct circumstances* at, const double goal[16], double most, double q[N]) {
  double jacobian[6][N], root[N][N], pose[16], error[6], step[N], start[N], left = 0.0, before = 1e300;
  for (int i = 0; i < N; ++i) start[i] = q[i];
  for (int round = 0; round <= 32; ++round) {
    double largest = 0.0;
    if (round == 4 && !(largest_motion(q, start) <= most))
      for (int i = 0; i < N; ++i) q[i] = start[i];
    forward_at(at, q, pose);
    pose_error(goal, pose, error);
    left = norm_of(error);
    if (left < 1e-10 || round == 32) break;
    if (round > 4 && largest_motion(q, start) > 4.0*most) break;
    if (round % 8 == 0) {
      if (left > 0.9*before) break; /* beyond its reach */
      before = left;
    }
    if (round == 0) {
      double nominal[16];
      nominal_forward(at, q, nominal);
      differentiate(nominal_forward, at, q, nominal, 0, jacobian);
      factorize(jacobian, 0.0, root);
    } else if (round > 3 && round % 2 == 0) {
      differentiate(forward_at, at, q, pose, 0, jacobian);
      factorize(jacobian, 0.25*left*left/(most*most), root);
    }
    for (int r = 0; r < N; ++r) {
      step[r] = 0.0;
      for (int i = 0; i < 6; ++i) step[r] += jacobian[i][r]*error[i];
    }
    substitute(root, step);
    for (int r = 0; r < N; ++r)
      if (fabs(step[r]) > largest) largest = fabs(step[r]);
    for (int r = 0; r < N; ++r) q[r] += largest > 0.1 ? 0.1/largest*step[r] : step[r];
  }
  return left;
}

)code";

}  // namespace

std::string inverse_constants_in_c() {
  return "#define LEVER 0.25\n#define STEP 1e-5\n#define DAMPING 1e-13\n#define LENGTH 0.3\n#define FIRST 0.01\n"
         "#define LOST 0.125\n#define GAIN 3.0\n#define CALM 0.02\n#define NEARBY 0.05\n\n";
}

std::string reach_in_c() {
  return kReach;
}

}  // namespace demecal::inline symbolic

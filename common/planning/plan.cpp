#include "planning/plan.hpp"

#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include "errors/input_error.hpp"
#include "kinematics/units.hpp"
#include "planning/assumptions.hpp"
#include "planning/candidates.hpp"
#include "planning/design_bound.hpp"
#include "planning/exchange.hpp"
#include "planning/sockets.hpp"
#include "planning/stops.hpp"
#include "random/random_purpose.hpp"
#include "random/random_stream.hpp"

namespace demecal::inline planning {
namespace {

constexpr int kUsualPoses = 40, kMostPoses = 400;
constexpr std::size_t kWorkspacePlaces = 250;  ///< of the workspace that errors are predicted at
constexpr int kExchangeRounds = 4, kReplacements = 4;

FeasibleSpace space_of(const PlanRequest& request) {
  WorkCell cell = request.cell     ? *request.cell
                  : request.places ? assumed_cell_of_sockets(request.robot)
                                   : assumed_cell(request.robot);
  if (request.places) cell.instrument.reset();
  std::vector<Eigen::Vector3d> targets_m;
  for (const auto& [target, target_m] : request.tools_m) targets_m.push_back(target_m);
  return {request.robot, std::move(cell), std::move(targets_m)};
}

/// The planning of one request, step by step.
class Planning {
 public:
  explicit Planning(const PlanRequest& request)
      : request_(request),
        space_(space_of(request)),
        model_(model_of(request, space_)),
        most_(request.poses        ? *request.poses
              : request.accuracy_m ? kMostPoses
                                   : kUsualPoses) {}

  Plan make() {
    request_.places ? draw_sockets() : draw();
    const Workspace workspace(model_, places_);
    Eigen::MatrixXd known = model_.information_of_lengths();
    if (request_.measured) known += model_.information_of(*request_.measured);
    const Design empty(stacked_rows(model_, candidates_), model_.rows_per_pose(), known, workspace.weight());
    const Design design = request_.accuracy_m ? smallest_reaching(empty) : of_size(empty, most_);
    RefinedPoses refined_poses = refined_design(design, known, workspace);
    if (request_.accuracy_m) use_fewer(empty, known, workspace, refined_poses);
    Plan settled = with_stops(refined_poses.poses);
    replace_blocked(settled, refined_poses, known, workspace);
    plan_ = std::move(settled);
    take(refined_poses, workspace);
    bound(refined_poses.poses, known, workspace);
    draw_curve(empty, workspace, refined_poses.poses.size());
    describe_assumptions(request_, space_, model_, plan_);
    return std::move(plan_);
  }

 private:
  Eigen::Index numbers() const { return static_cast<Eigen::Index>(model_.ids().size()); }
  RandomStream stream(std::uint64_t part) const {
    return RandomStream{request_.seed, number_of(RandomPurpose::planned_poses), part};
  }

  void draw() {
    const auto most = static_cast<std::size_t>(most_);
    const std::size_t wanted = candidates_for(model_, request_.accuracy_m ? 100 : most);
    DrawnPoses drawn = draw_poses(space_, wanted, stream(1));
    plan_.drawn = drawn.drawn;
    plan_.feasible = drawn.poses.size();
    plan_.refused = drawn.refused;
    plan_.refused[0] = 0;
    candidates_ = std::move(drawn.poses);
    const auto judging_poses = static_cast<std::size_t>(judging(request_, PoseSet::validation, most_) +
                                                        judging(request_, PoseSet::accept, most_));
    places_ = draw_poses(space_, std::max(kWorkspacePlaces, judging_poses), stream(2)).poses;
    const std::size_t needed = request_.accuracy_m ? static_cast<std::size_t>(fewest_poses(model_)) : most;
    if (candidates_.size() >= std::max<std::size_t>(needed, 4) && places_.size() >= judging_poses) return;
    const auto worst = static_cast<Obstruction>(std::ranges::max_element(plan_.refused) - plan_.refused.begin());
    const bool stated = request_.stated.contains(worst);
    const InputError::Where where =
        stated ? request_.stated.at(worst).where : InputError::Where{request_.robot.name, 0};
    throw InputError(
        where, std::to_string(plan_.feasible),
        fmt::format("of {} random poses are feasible, too few to choose {} from; most were refused since: "
                    "{}. Widen {}, or ask for fewer poses",
                    plan_.drawn, needed, to_string(worst), stated ? request_.stated.at(worst).key : "the cell"));
  }

  void draw_sockets() {
    places_ = draw_poses(space_, kWorkspacePlaces, stream(2)).poses;
    if (places_.empty())
      throw InputError({request_.robot.name, 0}, "0",
                       "random poses are feasible: nothing can be planned in this cell. Widen it");
    const int most = request_.accuracy_m ? kUsualPoses : most_;
    PlacedSockets placed =
        place_sockets(model_, space_, Workspace(model_, places_),
                      {*request_.places, most, candidates_for(model_, static_cast<std::size_t>(most))}, stream(1));
    model_ = InformationModel(std::move(placed.model));
    plan_.sockets = std::move(placed.sockets);
    plan_.lengths = std::move(placed.lengths);
    plan_.by_places = std::move(placed.by_places);
    plan_.drawn = plan_.feasible = placed.candidates.size();
    candidates_ = std::move(placed.candidates);
    validation_ = std::move(placed.validation);
    accept_ = std::move(placed.accept);
  }

  Design of_size(Design design, int poses) const {
    // A first pose at a socket tells nothing: chosen one by one, all would come to stand at few.
    const bool in_turn = request_.places.has_value();
    for (int i = 0; i < poses; ++i) {
      if (in_turn && static_cast<std::size_t>(i) < candidates_.size()) design.add(static_cast<std::size_t>(i));
      if (!in_turn) design.add_best();
    }
    design.exchange(kExchangeRounds);
    return design;
  }

  /// A few at each socket, so that further ones tell something.
  Design first_at_sockets(Design design) const {
    constexpr std::size_t kFirstEach = 3;
    const std::size_t first = std::min(kFirstEach * model_.model().sockets.size(), candidates_.size());
    for (std::size_t i = 0; i < first; ++i) design.add(i);
    return design;
  }

  /// The fewest poses, after exchanges, that are predicted to do; greedy choice needs a few more and says where to
  /// look.
  Design smallest_reaching(const Design& empty) const {
    const double enough_m2 = std::pow(*request_.accuracy_m, 2.0);
    Design greedy = first_at_sockets(empty);
    int poses = static_cast<int>(greedy.chosen().size());
    while (poses < kMostPoses && (poses < fewest_poses(model_) || greedy.square_m2() > enough_m2)) {
      if (!greedy.add_best()) break;
      ++poses;
    }
    if (greedy.square_m2() > enough_m2)
      throw InputError(
          {request_.robot.name, 0}, fmt::format("{:g} mm", millimetres(*request_.accuracy_m)),
          fmt::format("is not reached: {} poses are predicted to leave {:.3g} mm rms, with a measurement "
                      "noise of {:.3g} mm. Ask for less, or measure more precisely",
                      poses, millimetres(std::sqrt(greedy.square_m2())), millimetres(model_.model().noise_m)));
    greedy.exchange(kExchangeRounds);
    Design best = std::move(greedy);
    while (static_cast<int>(best.chosen().size()) > fewest_poses(model_)) {
      const int fewer =
          static_cast<int>(best.chosen().size()) - std::max(1, static_cast<int>(best.chosen().size()) / 20);
      Design smaller = of_size(empty, std::max(fewer, fewest_poses(model_)));
      if (smaller.square_m2() > enough_m2) break;
      best = std::move(smaller);
    }
    return best;
  }

  RefinedPoses refined_design(const Design& design, const Eigen::MatrixXd& known, const Workspace& workspace) const {
    std::vector<PlannedPose> chosen;
    for (const std::size_t i : design.chosen()) chosen.push_back(candidates_[i]);
    return refined(model_, space_, std::move(chosen), known, workspace.weight(), stream(5));
  }

  /// The fewest poses that do once they are refined, looked for by halving: further ones were needed on candidates.
  void use_fewer(const Design& empty, const Eigen::MatrixXd& known, const Workspace& workspace,
                 RefinedPoses& enough) const {
    constexpr double kLeastShare = 0.6;
    int least = static_cast<int>(kLeastShare * static_cast<double>(enough.poses.size()));
    least = std::max(least, fewest_poses(model_) - 1);
    while (static_cast<int>(enough.poses.size()) > least + 1) {
      const int between = (least + static_cast<int>(enough.poses.size())) / 2;
      RefinedPoses fewer = refined_design(of_size(empty, between), known, workspace);
      if (workspace.predicted(fewer.covariance).rms_m <= *request_.accuracy_m) {
        enough = std::move(fewer);
      } else {
        least = between;
      }
    }
  }

  void take(const RefinedPoses& refined_poses, const Workspace& workspace) {
    plan_.noise_m = model_.model().noise_m;
    plan_.effects = model_.model().effects;
    plan_.predicted = workspace.predicted(refined_poses.covariance);
    describe_numbers(model_, refined_poses.poses, refined_poses.covariance, plan_);
  }

  void bound(const std::vector<PlannedPose>& planned, const Eigen::MatrixXd& known, const Workspace& workspace) {
    std::vector<PlannedPose> poses = candidates_;
    poses.insert(poses.end(), planned.begin(), planned.end());
    plan_.bound_rms_m = std::sqrt(
        least_square_m2(model_, space_, std::move(poses), known, workspace.weight(), planned.size(), stream(6)));
  }

  void draw_curve(const Design& empty, const Workspace& workspace, std::size_t chosen) {
    constexpr int kRandomDraws = 5, kPoints = 8;
    const int last = std::min(static_cast<int>(candidates_.size()), std::max(60, 2 * static_cast<int>(chosen)));
    Design greedy = first_at_sockets(empty);
    RandomStream random = stream(4);
    const int step = std::max(1, last / kPoints);
    double refinement = 1.0;  // what the plan has over as many poses chosen one by one
    for (int poses = static_cast<int>(greedy.chosen().size()) + 1; poses <= last; ++poses) {
      if (!greedy.add_best()) break;
      const bool shown = poses == static_cast<int>(chosen) || (poses >= fewest_poses(model_) && poses % step == 0);
      if (!shown) continue;
      CurvePoint point{poses, workspace.predicted(greedy.covariance()), 0.0};
      for (int i = 0; i < kRandomDraws; ++i) {
        Design drawn = empty;
        std::vector<std::size_t> all(empty.candidates());
        std::iota(all.begin(), all.end(), std::size_t{0});
        for (int k = 0; k < poses; ++k) {
          std::swap(all[static_cast<std::size_t>(k)],
                    all[static_cast<std::size_t>(k) + random.index(all.size() - static_cast<std::size_t>(k))]);
          drawn.add(all[static_cast<std::size_t>(k)]);
        }
        point.random_rms_m += std::sqrt(drawn.square_m2()) / kRandomDraws;
      }
      if (poses == static_cast<int>(chosen)) {
        plan_.random_rms_m = point.random_rms_m;
        refinement = plan_.predicted.rms_m / point.planned.rms_m;
      }
      plan_.curve.push_back(point);
    }
    for (CurvePoint& point : plan_.curve) {
      PredictedError& error = point.planned;
      error = {refinement * error.rms_m, refinement * error.mean_m, refinement * error.p95_m};
      if (point.poses == static_cast<int>(chosen)) error = plan_.predicted;
    }
  }

  Plan with_stops(const std::vector<PlannedPose>& chosen) const {
    std::vector<PlannedStop> stops;
    for (const PlannedPose& pose : chosen) stops.push_back({{}, PoseSet::calibration, pose});
    const int calibration = static_cast<int>(stops.size());
    const auto validation = static_cast<std::size_t>(judging(request_, PoseSet::validation, calibration));
    const auto accept = static_cast<std::size_t>(judging(request_, PoseSet::accept, calibration));
    if (request_.places) {
      const std::size_t fitted = model_.model().sockets.size();
      add_stops(validation_, at_sockets(request_.validation, validation, fitted), PoseSet::validation, stops);
      add_stops(accept_, at_sockets(request_.accept, accept, plan_.sockets.size() - fitted), PoseSet::accept, stops);
    } else {
      const std::span<const PlannedPose> places(places_);
      add_stops(places, validation, PoseSet::validation, stops);
      add_stops(places.subspan(validation), accept, PoseSet::accept, stops);
    }
    Plan plan = plan_;
    order_stops(space_, request_.measured, std::move(stops), stream(3), plan);
    return plan;
  }

  /// Others in the place of poses that no way leads to: of those that calibrate the candidates that tell most beside
  /// the rest, where these tell as much, of those that judge the next random ones; as far as more are reached so.
  void replace_blocked(Plan& plan, RefinedPoses& calibration, const Eigen::MatrixXd& known,
                       const Workspace& workspace) {
    const double enough_m = request_.accuracy_m.value_or(workspace.predicted(calibration.covariance).rms_m);
    Plan tried = plan;
    RefinedPoses others = calibration;
    std::vector<PlannedPose> left = candidates_;
    for (std::uint64_t round = 0; round < kReplacements && !tried.way.blocked.empty(); ++round) {
      places_ = poses_but(std::move(places_), tried.stops, tried.way.blocked);
      left = poses_but(std::move(left), tried.stops, tried.way.blocked);
      const std::vector<PlannedPose> kept = poses_but(others.poses, tried.stops, tried.way.blocked);
      if (kept.size() < others.poses.size()) {
        RefinedPoses next = completed(model_, kept, others.poses.size() - kept.size(), left, known, workspace.weight());
        next = refined(model_, space_, std::move(next.poses), known, workspace.weight(), stream(7 + round));
        if (workspace.predicted(next.covariance).rms_m <= enough_m) others = std::move(next);
      }
      tried = with_stops(others.poses);
      if (tried.way.blocked.size() >= plan.way.blocked.size()) continue;
      plan = tried;
      calibration = others;
    }
  }

  const PlanRequest& request_;
  FeasibleSpace space_;
  InformationModel model_;
  int most_;
  std::vector<PlannedPose> candidates_, places_;
  std::vector<PlannedPose> validation_, accept_;  ///< where sockets are touched
  Plan plan_;
};

}  // namespace

Plan make_plan(const PlanRequest& request) {
  return Planning(request).make();
}

}  // namespace demecal::inline planning

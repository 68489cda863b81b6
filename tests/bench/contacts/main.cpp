// What sockets tell of an arm beside a tracker: the tool's error over the workspace, whether undeclared causes and
// wrong sockets are named, and whether radii hold.
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <vector>

#include "../run_cases.hpp"
#include "contact_case.hpp"
#include "kinematics/units.hpp"
#include "mistaken_case.hpp"

namespace {

using namespace demecal;
using namespace demecal::bench;

double median(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  std::ranges::sort(values);
  return values[values.size() / 2];
}

struct Sum {
  std::string arm{};
  int cases = 0, failed = 0, with_false = 0, wrong_named = 0, injected = 0, named = 0, in_class = 0;
  long places = 0, within = 0;
  std::vector<double> touched_mm{}, over_tracked{}, found_over_predicted{};

  void add(const ContactFigures& one) {
    ++cases;
    failed += one.failed ? 1 : 0;
    if (one.failed) return;
    with_false += one.false_effects > 0 ? 1 : 0;
    wrong_named += one.wrong_socket_named ? 1 : 0;
    places += one.places;
    within += one.within;
    touched_mm.push_back(one.touched_mm);
    over_tracked.push_back(one.touched_mm / one.tracked_mm);
    found_over_predicted.push_back(one.touched_mm / one.predicted_mm);
    if (one.injected.empty()) return;
    ++injected;
    named += one.named ? 1 : 0;
    in_class += one.in_class ? 1 : 0;
  }
  static double share(double part, double all) { return all > 0 ? part / all : std::nan(""); }
  void print(bool json) const {
    const double good = cases - failed;
    const double coverage = share(static_cast<double>(within), static_cast<double>(places));
    if (json) {
      fmt::print("{}\n", nlohmann::ordered_json{{"arm", arm},
                                                {"cases", cases},
                                                {"failed", failed},
                                                {"rms_mm", median(touched_mm)},
                                                {"over_tracker", median(over_tracked)},
                                                {"found_over_predicted", median(found_over_predicted)},
                                                {"coverage", coverage},
                                                {"false_effects", share(with_false, good)},
                                                {"wrong_sockets_named", share(wrong_named, good)},
                                                {"injected", injected},
                                                {"named", share(named, injected)},
                                                {"in_class", share(in_class, injected)}}
                             .dump());
    } else {
      fmt::print("{:24}{:6}{:8.3f}{:10.2f}{:11.2f}{:10.3f}{:8.3f}{:8.3f}{:10}{:8.3f}{:10.3f}\n", arm, cases,
                 median(touched_mm), median(over_tracked), median(found_over_predicted), coverage,
                 share(with_false, good), share(wrong_named, good), injected, share(named, injected),
                 share(in_class, injected));
    }
  }
};

void write(const std::vector<ContactFigures>& cases, bool json) {
  std::vector<Sum> sums{{.arm = "all"}};
  for (const ContactFigures& one : cases) {
    auto own = std::ranges::find(sums, one.arm, &Sum::arm);
    if (own == sums.end()) own = sums.insert(sums.end(), {.arm = one.arm});
    own->add(one);
    sums.front().add(one);
  }
  if (!json)
    fmt::print("{:24}{:>6}{:>8}{:>10}{:>11}{:>10}{:>8}{:>8}{:>10}{:>8}{:>10}\n", "", "cases", "mm", "/ tracker",
               "/ foretold", "coverage", "false", "socket", "injected", "named", "in class");
  for (const Sum& sum : sums) sum.print(json);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Arms that touch sockets 60 times at two places (0.05 mm of play) and nothing else: the tool's rms error over "
      "the "
      "workspace, over that of as many tracker poses (wanted at most 1.5) and over what the model foretells; radii "
      "that "
      "hold (wanted .93 to .97); clean arms to which something is added (at most .05); poses in a wrong socket that "
      "are "
      "named (wanted all); undeclared causes of twice the limit that are named (wanted .85)."};
  int count = 60, threads = 2;
  double length_mm = 50.0;
  bool json = false, each = false, on_plate = false;
  app.add_option("--cases", count, "simulated arms")->capture_default_str()->check(CLI::PositiveNumber);
  app.add_option("--length-mm", length_mm, "between the two sockets of a place, known to 0.02 mm")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_flag("--plate", on_plate, "all four sockets of both places are on one plate: all lengths between them known");
  app.add_option("--threads", threads, "cases at a time; figures do not depend on it")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_flag("--json", json, "one JSON object a line instead of the table");
  app.add_flag("--each", each, "also one line a case on standard error");
  CLI11_PARSE(app, argc, argv);
  std::vector<SocketArm> arms;
  for (const Robot& robot : mistaken_arms(DEMECAL_SOURCE_DIR "/configs/robots"))
    arms.push_back(socket_arm(robot, metres(length_mm), on_plate));
  std::vector<ContactFigures> cases(static_cast<std::size_t>(count));
  const auto run = [&](std::size_t number) { cases[number] = run_contact_case(static_cast<int>(number), arms); };
  run_cases(cases.size(), threads, run, [&](std::size_t number) {
    if (!each) return;
    const ContactFigures& one = cases[number];
    std::cerr << fmt::format(
        "{} {}: {:.3f} mm, tracker {:.3f}, foretold {:.3f}; {} of {} within; {} false; socket {}; {} {}{}\n", number,
        one.arm, one.touched_mm, one.tracked_mm, one.predicted_mm, one.within, one.places, one.false_effects,
        one.wrong_socket_named, one.injected.empty() ? "nothing" : one.injected,
        one.named      ? "named"
        : one.in_class ? "in class"
                       : "missed",
        one.failed ? " FAILED" : "");
  });
  write(cases, json);
  return 0;
}

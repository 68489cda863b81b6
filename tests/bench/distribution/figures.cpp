#include "figures.hpp"

#include <fmt/ostream.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

namespace demecal::bench {
namespace {

constexpr double kMany = 1000.0;

double per_island_and_epoch(std::size_t count, const DistributionFigures& run) {
  return static_cast<double>(count) / static_cast<double>(run.islands * run.epochs);
}

void write_bound(std::ostream& out, const char* name, double value, bool kept, const char* bound) {
  fmt::print(out, "{:<52}{:>9.3f}   {:<8} {}\n", name, value, bound, kept ? "kept" : "MISSED");
}

}  // namespace

SpeedUp speed_up(std::vector<DistributionFigures> one, std::vector<DistributionFigures> two) {
  std::vector<double> ratios, allowed;
  for (std::size_t i = 0; i < one.size(); ++i) {
    ratios.push_back(one[i].wall_s / two[i].wall_s);
    const double half_of_all_s = 0.5 * (two[i].worker_s + two[i].coordinator_s);
    const double least_s = std::max(two[i].busiest_worker_s, half_of_all_s);
    allowed.push_back(least_s > 0.0 ? one[i].worker_s / least_s : 0.0);
  }
  std::ranges::sort(ratios);
  std::ranges::sort(allowed);
  const std::size_t middle = ratios.size() / 2;
  return {ratios[middle], ratios.front(), ratios.back(), allowed[middle], std::move(one), std::move(two)};
}

namespace {

/// Of one of the figures of runs, in ms.
double median_ms(const std::vector<DistributionFigures>& runs, double (*figure_s)(const DistributionFigures&)) {
  std::vector<double> values;
  for (const DistributionFigures& run : runs) values.push_back(1e3 * figure_s(run));
  std::ranges::sort(values);
  return values[values.size() / 2];
}

constexpr auto kBreeding = [](const DistributionFigures& run) { return run.breeding_s; };
constexpr auto kRest = [](const DistributionFigures& run) { return run.worker_s - run.breeding_s; };
constexpr auto kCoordinator = [](const DistributionFigures& run) { return run.coordinator_s; };

}  // namespace

double middleware_share(const std::vector<DistributionFigures>& runs) {
  double total_s = 0.0, breeding_s = 0.0;
  for (const DistributionFigures& run : runs) {
    total_s += run.worker_s + run.coordinator_s;
    breeding_s += run.breeding_s;
  }
  return 1.0 - breeding_s / total_s;
}

double Sleeping::coordinator_s_per_checkpoint() const {
  return run.coordinator_s / static_cast<double>(run.islands * run.epochs);
}

double Sleeping::settled_epoch_s() const {
  std::vector<double> epochs;
  for (std::size_t i = 2; i < run.reached_s.size(); ++i) epochs.push_back(run.reached_s[i] - run.reached_s[i - 1]);
  if (epochs.empty()) return epoch_s();
  std::ranges::sort(epochs);
  return epochs[epochs.size() / 2];
}

double Sleeping::worker_s_per_checkpoint() const {
  return run.worker_s / static_cast<double>(run.islands * run.epochs);
}

CostModel Distribution::model() const {
  std::vector<EpochTime> times;
  for (const Sleeping& one : sleeping) {
    times.push_back({static_cast<double>(one.run.islands), one.epoch_s() - one.work_s});
  }
  return fit(times);
}

void write_table(std::ostream& out, const Distribution& all) {
  const SpeedUp& pairs = all.speed_up;
  const DistributionFigures& last = pairs.two.back();
  fmt::print(out, "Table 6-1's run, {} islands, {} pairs of one and two workers\n", last.islands, pairs.one.size());
  write_bound(out, "speed-up of two workers, median of pairs", pairs.median, pairs.median >= 1.9, ">= 1.9");
  fmt::print(out, "{:<52}{:>9.3f} to {:.3f}\n", "  of the pairs", pairs.least, pairs.greatest);
  write_bound(out, "  that processor time alone allows", pairs.allowed, pairs.allowed >= 1.9, ">= 1.9");
  const double share = middleware_share(pairs.two);
  write_bound(out, "share of processor time that does not breed", share, share <= 0.03, "<= 0.03");
  for (const auto& [workers, runs] : {std::pair("one worker", &pairs.one), std::pair("two workers", &pairs.two)})
    fmt::print(out, "  {:<50}{:>9.1f} ms breed, {:.1f} ms workers besides, {:.1f} ms coordinator\n", workers,
               median_ms(*runs, kBreeding), median_ms(*runs, kRest), median_ms(*runs, kCoordinator));
  fmt::print(out, "{:<52}{:>9.1f}\n", "messages per island and epoch",
             per_island_and_epoch(last.traffic.messages, last));
  fmt::print(out, "{:<52}{:>9.0f}\n", "bytes per island and epoch", per_island_and_epoch(last.traffic.bytes, last));
  fmt::print(out, "{:<52}{:>9.4f}\n", "share of a core that an idle worker takes", last.idle_worker_share);
  if (all.sleeping.empty()) return;
  fmt::print(out, "\nislands that sleep for {:.2f} s an epoch, and say as much as others\n", all.sleeping[0].work_s);
  fmt::print(out, "{:>8}{:>14}{:>10}{:>26}\n", "islands", "s per epoch", "ideal", "coordinator ms/checkpoint");
  for (const Sleeping& one : all.sleeping) {
    fmt::print(out, "{:>8}{:>14.3f}{:>10.3f}{:>26.3f}\n", one.run.islands, one.epoch_s(), one.work_s,
               1e3 * one.coordinator_s_per_checkpoint());
  }
  const CostModel model = all.model();
  fmt::print(out, "an epoch takes {:.1f} ms + {:.3f} ms per island beyond its work; {:.0f} islands: {:.0f} ms\n",
             1e3 * model.fixed_s, 1e3 * model.per_island_s, kMany, 1e3 * model.at(kMany));
}

Sleeping median_of(std::vector<Sleeping> runs) {
  std::ranges::sort(runs, {}, &Sleeping::epoch_s);
  return runs[runs.size() / 2];
}

void write_hosts_table(std::ostream& out, int hosts, const std::vector<Sleeping>& runs) {
  fmt::print(out, "{} worker processes, each in a network namespace of its own; islands sleep for {:.2f} s an epoch\n",
             hosts, runs.at(0).work_s);
  fmt::print(out, "{:>8}{:>14}{:>12}{:>12}{:>16}{:>34}\n", "islands", "s per epoch", "efficiency", ">= 0.9",
             "s once settled", "ms/island/epoch workers, coord.");
  for (const Sleeping& one : runs) {
    fmt::print(out, "{:>8}{:>14.3f}{:>12.3f}{:>12}{:>16.3f}{:>22.2f}{:>12.2f}\n", one.run.islands, one.epoch_s(),
               one.efficiency(), one.efficiency() >= 0.9 ? "kept" : "MISSED", one.settled_epoch_s(),
               1e3 * one.worker_s_per_checkpoint(), 1e3 * one.coordinator_s_per_checkpoint());
  }
}

void write_hosts_json(std::ostream& out, int hosts, const std::vector<Sleeping>& runs) {
  for (const Sleeping& one : runs) {
    out << nlohmann::ordered_json{{"hosts", hosts},
                                  {"islands", one.run.islands},
                                  {"epoch_s", one.epoch_s()},
                                  {"ideal_epoch_s", one.work_s},
                                  {"efficiency", one.efficiency()},
                                  {"settled_epoch_s", one.settled_epoch_s()},
                                  {"worker_ms_per_checkpoint", 1e3 * one.worker_s_per_checkpoint()},
                                  {"coordinator_ms_per_checkpoint", 1e3 * one.coordinator_s_per_checkpoint()}}
               .dump()
        << '\n';
  }
}

void write_json(std::ostream& out, const Distribution& all) {
  using Json = nlohmann::ordered_json;
  const SpeedUp& pairs = all.speed_up;
  const DistributionFigures& last = pairs.two.back();
  out << Json{{"workers", 2},
              {"speed_up", pairs.median},
              {"allowed_speed_up", pairs.allowed},
              {"breeding_ms", median_ms(pairs.two, kBreeding)},
              {"workers_besides_ms", median_ms(pairs.two, kRest)},
              {"coordinator_ms", median_ms(pairs.two, kCoordinator)},
              {"middleware_cpu_share", middleware_share(pairs.two)},
              {"messages_per_island_epoch", per_island_and_epoch(last.traffic.messages, last)},
              {"bytes_per_island_epoch", per_island_and_epoch(last.traffic.bytes, last)},
              {"idle_worker_cpu_share", last.idle_worker_share}}
             .dump()
      << '\n';
  for (const Sleeping& one : all.sleeping) {
    out << Json{{"islands", one.run.islands},
                {"epoch_s", one.epoch_s()},
                {"ideal_epoch_s", one.work_s},
                {"coordinator_ms_per_checkpoint", 1e3 * one.coordinator_s_per_checkpoint()}}
               .dump()
        << '\n';
  }
  if (all.sleeping.size() < 2) return;
  const CostModel model = all.model();
  out << Json{{"islands", kMany},
              {"fixed_ms", 1e3 * model.fixed_s},
              {"per_island_ms", 1e3 * model.per_island_s},
              {"extrapolated_epoch_beyond_work_s", model.at(kMany)}}
             .dump()
      << '\n';
}

}  // namespace demecal::bench

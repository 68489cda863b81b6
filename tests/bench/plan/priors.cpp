#include "priors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "config/model_file.hpp"
#include "data_files/data_set_file.hpp"
#include "fitting/stations.hpp"
#include "prediction/measurement.hpp"
#include "random/distributions.hpp"
#include "random/random_stream.hpp"
#include "workflows/workflows.hpp"

namespace demecal::bench {
namespace {

constexpr int kDrawnPoses[] = {20, 100};

std::filesystem::path series_file(const char* letter) {
  return std::filesystem::path(DEMECAL_SOURCE_DIR) / "../shared/data/ur10-leica" /
         fmt::format("series-{}.yaml", letter);
}

CalibratedModel diagnosed(const DataSet& data) {
  Job job;
  job.name = "bench";
  job.method = Method::diagnose;
  job.explanations.variations = 0;
  job.declared = declared_by_default(data);
  return diagnose(data, job, std::nullopt, {}).result.model;
}

NamedModel model_of_series(const char* letter) {
  return {fmt::format("series {}", letter), diagnosed(load_data_set(series_file(letter)))};
}

/// The accept poses, and as many of those for calibration as are asked for.
DataSet drawn_from(const DataSet& whole, int count, RandomStream random) {
  std::vector<std::size_t> left = poses_of(whole, PoseSet::calibration), kept = poses_of(whole, PoseSet::accept);
  for (int i = 0; i < count && !left.empty(); ++i) {
    const std::size_t at = random.index(left.size());
    kept.push_back(left[at]);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
  }
  std::ranges::sort(kept);
  DataSet data = whole;
  data.poses.clear();
  for (const std::size_t pose : kept) data.poses.push_back(whole.poses[pose]);
  return data;
}

/// Of one draw, mm.
struct Accepted {
  double updated_mm = 0.0, placed_mm = 0.0;
};

Accepted accepted_after(const NamedModel& old, const std::vector<NamedModel>& earlier, const DataSet& data) {
  Job job;
  job.name = "bench";
  job.method = Method::diagnose;
  job.declared = old.model.declared;
  job.declared.registration = job.declared.tool = true;
  const CalibrateResult result = update_model(data, job, old, {}, earlier);
  const std::vector<std::size_t> accept = poses_of(data, PoseSet::accept);
  return {error_figures(result.model.robot, data, accept).rms_mm, error_figures(result.before, data, accept).rms_mm};
}

void print_draws(const std::string& series, int poses, const std::vector<Accepted>& draws, bool json) {
  std::vector<double> updated_mm, placed_mm;
  int worse = 0;
  for (const Accepted& draw : draws) {
    updated_mm.push_back(draw.updated_mm);
    placed_mm.push_back(draw.placed_mm);
    if (draw.updated_mm > draw.placed_mm) ++worse;
  }
  const double least = std::ranges::min(updated_mm), most = std::ranges::max(updated_mm);
  if (json) {
    fmt::print("{}\n", nlohmann::ordered_json{{"workload", "prior"},
                                              {"series", series},
                                              {"poses", poses},
                                              {"draws", draws.size()},
                                              {"accept_rms_mm_least", least},
                                              {"accept_rms_mm_median", median(updated_mm)},
                                              {"accept_rms_mm_most", most},
                                              {"base_and_tool_rms_mm_median", median(placed_mm)},
                                              {"worse_than_base_and_tool", worse}}
                           .dump());
  } else {
    fmt::print("{:<12} {:>5} {:>6.3f} {:>7.3f} {:>6.3f} {:>14.3f} {:>3} of {:>3}\n", series, poses, least,
               median(updated_mm), most, median(placed_mm), worse, draws.size());
  }
  std::fflush(stdout);
}

/// Draws of poses of a series after `old`; what the line is called.
void bench_series(const char* letter, const std::string& name, const NamedModel& old,
                  const std::vector<NamedModel>& earlier, const PriorOptions& options) {
  const DataSet whole = load_data_set(series_file(letter));
  for (const int poses : kDrawnPoses) {
    std::vector<Accepted> draws;
    for (int draw = options.first_draw; draw < options.first_draw + options.draws; ++draw) {
      const RandomStream random{800, static_cast<std::uint64_t>(poses), static_cast<std::uint64_t>(draw)};
      draws.push_back(accepted_after(old, earlier, drawn_from(whole, poses, random)));
    }
    print_draws(name, poses, draws, options.json);
  }
}

}  // namespace

bool bench_priors(const PriorOptions& options) {
  for (const char* letter : {"a", "b", "c"}) {
    if (std::filesystem::exists(series_file(letter))) continue;
    fmt::print(stderr, "what an old model is worth was not measured: there is no {}\n",
               series_file(letter).lexically_normal().string());
    return false;
  }
  if (!options.json)
    fmt::print(
        "rms error on accept poses, mm, of an old model after few new poses\n{:<12} {:>5} {:>6} {:>7} {:>6} {:>14} "
        "{}\n",
        "series", "poses", "least", "median", "most", "base and tool", "worse than these");
  const auto old = [&] {
    return options.model.empty() ? model_of_series("a") : NamedModel{options.model, load_model(options.model)};
  };
  if (options.stations) {
    const DataSet both =
        joined_stations({load_data_set(series_file("a")), load_data_set(series_file("b"))}, StationTools::own);
    bench_series("c", "c by a with b", {"series A and B", diagnosed(both)}, {}, options);
  } else if (options.drift) {
    const NamedModel latest = model_of_series("b");
    bench_series("c", "c by b", latest, {}, options);
    bench_series("c", "c by b and a", latest, {old()}, options);
  } else {
    const NamedModel first = old();
    for (const char* letter : {"b", "c"}) bench_series(letter, letter, first, {}, options);
  }
  return true;
}

}  // namespace demecal::bench

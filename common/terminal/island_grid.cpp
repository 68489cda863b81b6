#include "terminal/monitor_page.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "evolution/archipelago.hpp"
#include "evolution/island.hpp"
#include "fitness/parameters.hpp"
#include "monitor/watched.hpp"
#include "protocol/messages.hpp"
#include "terminal/text.hpp"

namespace demecal::inline terminal {
namespace {

constexpr std::size_t kLabel = 7;      // "joint 1"
constexpr std::size_t kIslandGap = 3;  // between islands
constexpr std::size_t kMostBar = 16;

enum class Figure { generation, best, median, diversity, speed, sent, taken, waited, worker };
struct FigureColumn {
  Figure figure;
  const char* heading;
  std::size_t columns;
};
constexpr std::array<FigureColumn, 9> kFigures{{{Figure::generation, "gen", 5},
                                                {Figure::best, "best", 7},
                                                {Figure::median, "median", 7},
                                                {Figure::diversity, "diff", 4},
                                                {Figure::speed, "eval/s", 6},
                                                {Figure::sent, "sent", 5},
                                                {Figure::taken, "took", 5},
                                                {Figure::waited, "wait", 4},
                                                {Figure::worker, "by", 3}}};

/// How much of each island is shown.
struct Detail {
  std::size_t bar;
  std::vector<FigureColumn> figures;

  /// Of one island: its deme, its bar, its figures.
  std::size_t columns(std::size_t deme_columns) const {
    std::size_t sum = deme_columns + 1 + bar;
    for (const FigureColumn& figure : figures) sum += 1 + figure.columns;
    return sum;
  }
};

std::vector<Detail> details() {
  const auto chosen = [](std::initializer_list<std::size_t> places) {
    std::vector<FigureColumn> figures;
    for (const std::size_t place : places) figures.push_back(kFigures[place]);
    return figures;
  };
  return {{6, {kFigures.begin(), kFigures.end()}},
          {6, chosen({0, 1, 2, 3, 4, 8})},
          {5, chosen({0, 1, 8})},
          {4, chosen({1})},
          {4, {}}};
}

class Grid {
 public:
  Grid(const WatchedRun& run, const std::vector<const WatchedWorker*>& workers, const GridOptions& options)
      : run_(run),
        options_(options),
        deme_columns_(std::max<std::size_t>(2, std::to_string(demes()).size())),
        worker_columns_(std::max<std::size_t>(3, 1 + std::to_string(workers.size()).size())) {
    for (std::size_t i = 0; i < workers.size(); ++i) tags_[workers[i]->status.worker] = fmt::format("w{}", i + 1);
    choose_detail();
  }

  std::vector<std::string> lines() const;

 private:
  std::size_t demes() const { return run_.data.archipelago.demes_per_joint; }
  std::size_t joints() const { return run_.data.archipelago.joints.size(); }
  /// Islands side by side.
  std::size_t blocks(const Detail& detail) const {
    const std::size_t room = options_.columns > kLabel + 1 ? options_.columns - kLabel - 1 : 1;
    return std::clamp<std::size_t>((room + kIslandGap) / (detail.columns(deme_columns_) + kIslandGap), 1, demes());
  }
  std::size_t rows_per_joint(const Detail& detail) const { return (demes() + blocks(detail) - 1) / blocks(detail); }
  void choose_detail();
  std::string heading() const;
  std::string row(std::uint32_t joint, std::uint32_t first_deme) const;
  std::string cell(IslandKey key) const;
  std::string figure(const Progress& island, Figure which) const;
  double best_of(std::uint32_t joint) const;

  const WatchedRun& run_;
  const GridOptions& options_;
  std::size_t deme_columns_, worker_columns_;
  std::map<std::string, std::string> tags_;
  Detail detail_;
};

/// The most that fits in both directions; the least where nothing does.
void Grid::choose_detail() {
  for (Detail& detail : details()) {
    detail_ = std::move(detail);
    for (FigureColumn& column : detail_.figures)
      if (column.figure == Figure::worker) column.columns = worker_columns_;
    const bool is_narrow = kLabel + 1 + detail_.columns(deme_columns_) <= options_.columns;
    if (is_narrow && (options_.lines == 0 || 1 + joints() * rows_per_joint(detail_) <= options_.lines)) break;
  }
  const std::size_t side_by_side = blocks(detail_);
  const std::size_t taken = kLabel + 1 + side_by_side * (detail_.columns(deme_columns_) + kIslandGap) - kIslandGap;
  const std::size_t spare = options_.columns > taken ? (options_.columns - taken) / side_by_side : 0;
  detail_.bar += std::min(spare, kMostBar - detail_.bar);
}

std::string Grid::heading() const {
  std::string block = right_aligned("", deme_columns_) + " " + left_aligned("", detail_.bar);
  for (const FigureColumn& figure : detail_.figures) block += " " + right_aligned(figure.heading, figure.columns);
  std::string text = left_aligned("", kLabel);
  for (std::size_t i = 0; i < blocks(detail_); ++i) text += std::string(i == 0 ? 1 : kIslandGap, ' ') + block;
  return styled(text, TextStyle::faint, options_.colours);
}

double Grid::best_of(std::uint32_t joint) const {
  double best = std::numeric_limits<double>::infinity();
  for (const auto& [key, island] : run_.islands) {
    if (key.joint == joint) best = std::min(best, island.figures.best);
  }
  return best;
}

std::string Grid::figure(const Progress& island, Figure which) const {
  switch (which) {
    case Figure::generation:
      return island.generation < 100'000 ? std::to_string(island.generation) : short_count(island.generation);
    case Figure::best:
      return short_real(island.figures.best);
    case Figure::median:
      return short_real(island.figures.median);
    case Figure::diversity:
      return percent(island.figures.diversity);
    case Figure::speed:
      return short_count(island.evaluations_per_s);
    case Figure::sent:
      return short_count(static_cast<double>(island.migrants_sent));
    case Figure::taken:
      return short_count(static_cast<double>(island.migrants_taken));
    case Figure::waited:
      return percent(island.waited_share);
    case Figure::worker:
      break;
  }
  const auto tag = tags_.find(island.worker);
  return tag == tags_.end() ? "?" : tag->second;
}

std::string Grid::cell(IslandKey key) const {
  const auto found = run_.islands.find(key);
  const bool has_begun = found != run_.islands.end();
  const Progress island = has_begun ? found->second : Progress{};
  const double share = static_cast<double>(island.generation) / run_.data.parameters.number_generations;
  const BarParts bar = bar_parts(share, detail_.bar);
  const TextStyle ink = run_.has_finished(island) ? TextStyle::good : TextStyle::bar;
  std::string text =
      styled(right_aligned(std::to_string(key.deme + 1), deme_columns_), TextStyle::faint, options_.colours) + " " +
      styled(bar.full, ink, options_.colours) + styled(bar.empty, TextStyle::faint, options_.colours);
  for (const FigureColumn& column : detail_.figures) {
    const std::string shown = right_aligned(has_begun ? figure(island, column.figure) : "·", column.columns);
    const bool leads = column.figure == Figure::best && has_begun && island.figures.best == best_of(key.joint);
    text += " " + styled(shown, leads ? TextStyle::strong : TextStyle::plain, options_.colours);
  }
  return text;
}

std::string Grid::row(std::uint32_t joint, std::uint32_t first_deme) const {
  const std::string name = run_.data.breeds == Breeds::sets   ? "causes"
                           : run_.data.breeds == Breeds::work ? "work"
                                                              : fmt::format("joint{:>2}", joint + 1);
  std::string text = left_aligned(first_deme == 0 ? name : "", kLabel);
  const std::size_t end = std::min(demes(), first_deme + blocks(detail_));
  for (std::size_t deme = first_deme; deme < end; ++deme) {
    text += std::string(deme == first_deme ? 1 : kIslandGap, ' ') + cell({joint, static_cast<std::uint32_t>(deme)});
  }
  return text;
}

std::vector<std::string> Grid::lines() const {
  std::vector<std::string> lines{heading()};
  const std::size_t islands = joints() * demes(), rows = joints() * rows_per_joint(detail_);
  const bool fits = options_.lines == 0 || rows + 1 <= options_.lines;
  const std::size_t most = fits ? rows : std::max<std::size_t>(options_.lines, 3) - 2;  // a heading, a last line
  std::size_t shown = 0;
  for (const std::uint32_t joint : run_.data.archipelago.joints) {
    for (std::size_t deme = 0; deme < demes() && lines.size() <= most; deme += blocks(detail_)) {
      lines.push_back(row(joint, static_cast<std::uint32_t>(deme)));
      shown += std::min(blocks(detail_), demes() - deme);
    }
  }
  if (!fits) lines.push_back(fmt::format("and {} islands more", islands - shown));
  return lines;
}

}  // namespace

std::vector<std::string> island_grid(const WatchedRun& run, const std::vector<const WatchedWorker*>& workers,
                                     const GridOptions& options) {
  return Grid(run, workers, options).lines();
}

}  // namespace demecal::inline terminal

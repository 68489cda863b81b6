#include "config/job_file.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "data/certificate_fields.hpp"
#include "data_files/data_set_file.hpp"
#include "effect_sets/set_island.hpp"
#include "effects/effect.hpp"
#include "evolution/archipelago.hpp"
#include "fitting/stations.hpp"
#include "yaml/files.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline config {
namespace {

constexpr std::int64_t kMostDemes = 1000;
constexpr std::int64_t kMostEffects = 1000;
constexpr std::int64_t kMostVariations = 10'000'000;
constexpr std::int64_t kMostDistalRounds = 1000;
constexpr std::int64_t kHighestRatio = 10000;

IslandOptions read_islands(const YamlNode& node, int population_size) {
  node.with_keys(
      {"per_joint", "topology", "migration_interval", "migrants", "between_joints", "replacement", "spread"});
  IslandOptions islands;
  const auto count = [&](std::string_view key, std::uint32_t& value, std::int64_t lower, std::int64_t upper) {
    if (const YamlNode* found = node.find(key)) value = static_cast<std::uint32_t>(found->whole_number(lower, upper));
  };
  count("per_joint", islands.per_joint, 1, kMostDemes);
  count("migration_interval", islands.migration_interval, 1, std::numeric_limits<int>::max());
  count("migrants", islands.migrants, 0, population_size - 1);
  if (const YamlNode* topology = node.find("topology")) {
    islands.topology =
        topology->one_of<Topology>({{"none", Topology::none}, {"ring", Topology::ring}, {"full", Topology::full}});
  }
  if (const YamlNode* replacement = node.find("replacement")) {
    islands.replacement =
        replacement->one_of<Replacement>({{"worst", Replacement::worst}, {"random", Replacement::random}});
  }
  if (const YamlNode* spread = node.find("spread")) islands.spread = spread->number(0.0, 1.0);
  if (const YamlNode* between = node.find("between_joints")) islands.between_joints = between->boolean();
  return islands;
}

DistalOptions read_distal(const YamlNode& node) {
  node.with_keys({"form", "rounds", "amplitudes"});
  DistalOptions distal;
  if (const YamlNode* form = node.find("form")) {
    distal.form =
        form->one_of<DistalForm>({{"parallel", DistalForm::parallel}, {"sequential", DistalForm::sequential}});
  }
  if (const YamlNode* rounds = node.find("rounds")) {
    distal.rounds = static_cast<int>(rounds->whole_number(1, kMostDistalRounds));
  }
  if (const YamlNode* amplitudes = node.find("amplitudes")) {
    distal.amplitudes =
        amplitudes->one_of<Amplitudes>({{"as_evolved", Amplitudes::as_evolved}, {"fitted", Amplitudes::fitted}});
  }
  return distal;
}

TargetOptions read_targets(const YamlNode& root) {
  TargetOptions targets;
  if (const YamlNode* kind = root.find("targets"))
    targets.kind = kind->one_of<TargetKind>({{"exact", TargetKind::exact}, {"posterior", TargetKind::posterior}});
  if (const YamlNode* error = root.find("joint_error_mrad")) {
    targets.joint_error_rad = 1e-3 * error->positive();
    if (targets.kind == TargetKind::exact)
      error->fail("says nothing where targets are exact: leave one of the two out");
  }
  return targets;
}

std::vector<std::string> read_candidates(const YamlNode& list) {
  std::vector<std::string> candidates;
  for (const YamlNode& item : list.list()) {
    const auto kinds = effect_kinds();
    if (std::find(kinds.begin(), kinds.end(), item.text()) == kinds.end()) item.fail_choice(kinds);
    if (std::find(candidates.begin(), candidates.end(), item.text()) != candidates.end()) item.fail("is named twice");
    candidates.push_back(item.text());
  }
  return candidates;
}

ClosedLoopOptions read_closed_loop(const YamlNode& node) {
  node.with_keys({"max_effects", "family_error", "candidates", "highest_ratio", "ratios"});
  ClosedLoopOptions options;
  if (const YamlNode* most = node.find("max_effects")) {
    options.max_effects = static_cast<int>(most->whole_number(0, kMostEffects));
  }
  if (const YamlNode* error = node.find("family_error")) {
    options.family_error = error->positive();
    if (options.family_error >= 1.0) error->fail("must be below 1");
  }
  if (const YamlNode* candidates = node.find("candidates")) options.candidates = read_candidates(*candidates);
  if (const YamlNode* highest = node.find("highest_ratio")) {
    options.highest_ratio = static_cast<int>(highest->whole_number(0, kHighestRatio));
  }
  if (const YamlNode* ratios = node.find("ratios")) {
    for (const YamlNode& ratio : ratios->list()) options.ratios.push_back(ratio.positive());
  }
  return options;
}

/// A data set, or a list of them: one a station.
void read_data(const YamlNode& data, const std::filesystem::path& job_path, Job& job) {
  if (data.kind != YamlNode::Kind::list) {
    job.data_files = {resolve(job_path, data.text()).string()};
    return;
  }
  for (const YamlNode& station : data.list()) job.data_files.push_back(resolve(job_path, station.text()).string());
  if (job.data_files.empty()) data.fail("", "names no data set");
}

ExplanationSearch read_explanations(const YamlNode& node) {
  node.with_keys({"variations", "max_causes"});
  ExplanationSearch search;
  if (const YamlNode* variations = node.find("variations"))
    search.variations = static_cast<int>(variations->whole_number(0, kMostVariations));
  if (const YamlNode* most = node.find("max_causes"))
    search.most_causes = static_cast<std::size_t>(most->whole_number(1, kMostEffects));
  return search;
}

}  // namespace

Job load_job(const std::filesystem::path& path) {
  return read_job(read_yaml(path));
}

Job read_job(const YamlNode& root) {
  const std::filesystem::path path = root.file;
  root.with_version("job", 1).with_keys({"demecal_job", "data", "station_tools", "method", "seed", "model", "gp",
                                         "islands", "closed_loop", "explanations", "distal", "targets",
                                         "joint_error_mrad", "certificate"});
  Job job;
  job.name = path.stem().string();
  read_data(root.at("data"), path, job);
  if (const YamlNode* tools = root.find("station_tools"))
    job.station_tools = tools->one_of<StationTools>({{"own", StationTools::own}, {"shared", StationTools::shared}});
  if (const YamlNode* method = root.find("method")) {
    job.method = method->one_of<Method>({{"direct", Method::direct},
                                         {"distal", Method::distal},
                                         {"diagnose", Method::diagnose},
                                         {"structural", Method::structural}});
  }
  if (const YamlNode* seed = root.find("seed")) job.seed = seed->seed();
  if (const YamlNode* model = root.find("model")) {
    job.declared = read_declared(model->with_keys({"declared"}).at("declared"));
  }
  if (const YamlNode* gp = root.find("gp")) {
    job.gp = read_gp(*gp);
    job.corrections = read_correction_options(*gp);
  }
  if (const YamlNode* islands = root.find("islands")) job.islands = read_islands(*islands, job.gp.population_size);
  if (const YamlNode* loop = root.find("closed_loop")) job.closed_loop = read_closed_loop(*loop);
  if (const YamlNode* search = root.find("explanations")) job.explanations = read_explanations(*search);
  if (const YamlNode* distal = root.find("distal")) job.distal = read_distal(*distal);
  if (const YamlNode* certificate = root.find("certificate")) job.certificate = read_certificate(*certificate);
  job.targets = read_targets(root);
  if (!job.corrections.seeds.empty() && job.method == Method::distal && job.distal.form == DistalForm::sequential)
    root.at("gp").fail("", "has seed formulas, for which the sequential form of distal learning has no place");
  if (job.corrections.sharing.functions > 0 && job.method == Method::distal &&
      job.distal.form == DistalForm::sequential)
    root.at("gp").fail("",
                       "has shared functions: joints that learn one at a time, as in the sequential form of distal "
                       "learning, have none");
  return job;
}

std::span<const std::string> effect_kinds() {
  static const std::vector<std::string> kinds = [] {
    std::vector<std::string> words;
    for (const EffectLaw* law : catalogue()) words.emplace_back(law->kind());
    return words;
  }();
  return kinds;
}

DeclaredModel declared_model(std::span<const std::string> words) {
  DeclaredModel declared;
  for (const std::string& known : declared_words()) {
    declared.*declared_flag(known) = std::find(words.begin(), words.end(), known) != words.end();
  }
  return declared;
}

DeclaredModel read_declared(const YamlNode& list) {
  DeclaredModel declared;
  for (const YamlNode& item : list.list()) {
    bool DeclaredModel::*const flag = declared_flag(item.text());
    if (flag == nullptr) item.fail_choice(declared_words());
    if (declared.*flag) item.fail("is declared twice");
    declared.*flag = true;
  }
  return declared;
}

}  // namespace demecal::inline config

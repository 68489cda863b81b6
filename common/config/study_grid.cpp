#include "calibration/job.hpp"
#include "config/job_file.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "errors/input_error.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline config {
namespace {

constexpr std::size_t kMostCells = 10000;
constexpr std::array<std::string_view, 3> kSections{"gp", "islands", "distal"};

std::string value_text(const YamlNode& node) {
  if (node.kind == YamlNode::Kind::scalar) return node.scalar;
  const bool is_map = node.kind == YamlNode::Kind::map;
  std::string text;
  for (const YamlNode& child : node.children) {
    text += (text.empty() ? "" : ", ") + (is_map ? child.name + ": " : "") + value_text(child);
  }
  return is_map ? "{" + text + "}" : "[" + text + "]";
}

void check_values(const GridAxis& axis, const YamlNode& list) {
  if (axis.values.empty()) list.fail("", "must list the values to try");
  std::vector<std::string> seen;
  for (const YamlNode& value : axis.values) {
    const std::string text = value_text(value);
    if (std::find(seen.begin(), seen.end(), text) != seen.end()) value.fail(text, "stands twice");
    seen.push_back(text);
  }
}

bool is_varied(const std::string& key) {
  const auto names_one = [&](std::string_view section) {
    return key.size() > section.size() + 1 && key.starts_with(section) && key[section.size()] == '.';
  };
  return key == "method" || std::any_of(kSections.begin(), kSections.end(), names_one);
}

/// Options have no lines.
void forget_lines(YamlNode& node) {
  node.line = 0;
  for (YamlNode& child : node.children) forget_lines(child);
}

/// Gives a node the place in a job that `key` says, so that faults name it.
void move_to(YamlNode& node, const std::string& key) {
  node.key = key;
  for (std::size_t i = 0; i < node.children.size(); ++i) {
    YamlNode& child = node.children[i];
    move_to(child, node.kind == YamlNode::Kind::map ? key + "." + child.name : key + "[" + std::to_string(i + 1) + "]");
  }
}

/// The child of that name, made where the map has none.
YamlNode& child_or_new(YamlNode& map, const std::string& name, YamlNode::Kind kind) {
  if (const YamlNode* found = map.find(name))
    return map.children[static_cast<std::size_t>(found - map.children.data())];
  YamlNode child;
  child.file = map.file;
  child.line = map.line;
  child.key = name;
  child.name = name;
  child.kind = kind;
  return map.children.emplace_back(std::move(child));
}

void set_key(YamlNode& root, const std::string& key, YamlNode value) {
  const std::size_t dot = key.find('.');
  YamlNode& map = dot == std::string::npos ? root : child_or_new(root, key.substr(0, dot), YamlNode::Kind::map);
  move_to(value, key);
  value.name = dot == std::string::npos ? key : key.substr(dot + 1);
  child_or_new(map, value.name, YamlNode::Kind::nothing) = value;
}

std::string cell_text(const std::vector<GridAxis>& axes, const std::vector<std::string>& values) {
  std::string text;
  for (std::size_t i = 0; i < axes.size(); ++i) text += (i == 0 ? "" : ", ") + axes[i].key + " " + values[i];
  return text;
}

void check_axes(const std::vector<GridAxis>& axes) {
  std::size_t cells = 1;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const YamlNode& first = axes[i].values.front();
    const auto same = [&](const GridAxis& other) { return other.key == axes[i].key; };
    const auto end = axes.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::any_of(axes.begin(), end, same)) {
      throw InputError({first.file, first.line}, axes[i].key, "is varied twice: give its values in one place");
    }
    cells *= axes[i].values.size();
    if (cells > kMostCells) {
      throw InputError({first.file, first.line}, axes[i].key,
                       "makes more than " + std::to_string(kMostCells) + " cells of the grid");
    }
  }
}

/// Which value of each axis cell number `cell` has.
std::vector<std::size_t> places(const std::vector<GridAxis>& axes, std::size_t cell) {
  std::vector<std::size_t> chosen(axes.size());
  for (std::size_t i = axes.size(); i-- > 0;) {
    chosen[i] = cell % axes[i].values.size();
    cell /= axes[i].values.size();
  }
  return chosen;
}

GridCell make_cell(YamlNode root, const std::vector<GridAxis>& axes, const std::vector<std::size_t>& chosen) {
  GridCell cell;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const YamlNode& value = axes[i].values[chosen[i]];
    cell.values.push_back(value_text(value));
    set_key(root, axes[i].key, value);
  }
  try {
    cell.job = read_job(root);
  } catch (const InputError& error) {
    if (axes.empty()) throw;
    throw InputError(error.where(), error.value(),
                     error.rule() + " (in the cell with " + cell_text(axes, cell.values) + ")");
  }
  return cell;
}

}  // namespace

GridAxis read_axis(const std::string& option) {
  const std::string source = "--set " + option;
  const std::size_t equals = option.find('=');
  if (equals == std::string::npos) throw InputError({source, 0}, option, "must be KEY=VALUE,VALUE,...");
  const std::string key = option.substr(0, equals);
  if (!is_varied(key)) {
    throw InputError({source, 0}, key, "is nothing that a study varies: gp.KEY, islands.KEY, distal.KEY or method");
  }
  if (key == "gp.seed_models") throw InputError({source, 0}, key, "names files, which only a grid file can");
  YamlNode list = parse_yaml("[" + option.substr(equals + 1) + "]", source);
  forget_lines(list);
  move_to(list, key);
  GridAxis axis{key, list.list()};
  check_values(axis, list);
  return axis;
}

std::vector<GridAxis> load_grid(const std::filesystem::path& path) {
  const YamlNode root = read_yaml(path);
  root.with_version("grid", 1).with_keys({"demecal_grid", "method", kSections[0], kSections[1], kSections[2]});
  std::vector<GridAxis> axes;
  const auto add = [&](const YamlNode& node) {
    axes.push_back({node.key, node.list()});
    check_values(axes.back(), node);
  };
  for (const YamlNode& child : root.children) {
    if (child.name == "demecal_grid") continue;
    if (child.name == "method") {
      add(child);
      continue;
    }
    if (child.kind != YamlNode::Kind::map) child.fail("must be a map of keys and values");
    for (const YamlNode& parameter : child.children) add(parameter);
  }
  return axes;
}

std::vector<GridCell> grid_cells(const std::filesystem::path& job_file, const std::vector<GridAxis>& axes) {
  check_axes(axes);
  const YamlNode root = read_yaml(job_file);
  std::size_t count = 1;
  for (const GridAxis& axis : axes) count *= axis.values.size();
  std::vector<GridCell> cells;
  for (std::size_t i = 0; i < count; ++i) cells.push_back(make_cell(root, axes, places(axes, i)));
  return cells;
}

}  // namespace demecal::inline config

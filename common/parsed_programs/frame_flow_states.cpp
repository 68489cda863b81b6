#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <deque>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "parsed_programs/frame_flow.hpp"
#include "parsed_programs/program.hpp"

namespace demecal::inline parsed_programs {
namespace {

constexpr std::size_t kDifferingTool = 0, kDifferingFrame = 1;

bool same(const KnownFrame& one, const KnownFrame& other) {
  const bool stated = !one.name.empty();
  return stated != other.name.empty() && one.unknown == other.unknown && one.pose.isApprox(other.pose, 1e-12);
}

}  // namespace

void FrameFlow::join(const Value& other, std::size_t differing, Value& value) const {
  if (other.kind == Value::Kind::unreached) return;
  const std::size_t call = std::min(value.call, other.call);
  if (value.kind == Value::Kind::unreached) {
    value = other;
  } else if (value.kind != other.kind || (value.kind == Value::Kind::known && value.index != other.index &&
                                          !same(values_[value.index], values_[other.index]))) {
    value = {Value::Kind::known, differing, kNone};
  } else {
    value.index = std::min(value.index, other.index);
  }
  value.call = call;
}

bool FrameFlow::join(const State& other, State& state) const {
  const State before = state;
  join(other.tool, kDifferingTool, state.tool);
  join(other.frame, kDifferingFrame, state.frame);
  return !(state == before);
}

/// What `before` becomes by a routine, or a stretch of one, that ends with `change`.
FrameFlow::Value FrameFlow::after(const Value& before, const Value& change) {
  if (change.kind != Value::Kind::entry || before.kind == Value::Kind::unreached) return change;
  Value value = before;
  value.call = std::min(before.call, change.call);
  return value;
}

FrameFlow::State FrameFlow::begun(const State& state, const State& begin) {
  return {after(begin.tool, state.tool), after(begin.frame, state.frame)};
}

FrameFlow::State FrameFlow::out_of(const Node& node) const {
  State state = node.in;
  if (state.tool.kind == Value::Kind::unreached) return state;
  if (node.tool) state.tool = {Value::Kind::known, *node.tool, kNone};
  if (node.frame) state.frame = {Value::Kind::known, *node.frame, kNone};
  if (node.callee.empty()) return state;
  if (node.called != kNone) return begun(routines_[node.called].exit, state);
  if (!node.believed) return state;
  state.tool.call = std::min(state.tool.call, node.at);
  if (!frame_.empty()) state.frame.call = std::min(state.frame.call, node.at);
  return state;
}

std::set<std::size_t> FrameFlow::called_by(std::size_t routine) const {
  std::set<std::size_t> found{routine};
  std::vector<std::size_t> due{routine};
  while (!due.empty()) {
    const std::vector<std::size_t>& nodes = routines_[due.back()].nodes;
    due.pop_back();
    for (const std::size_t node : nodes) {
      if (nodes_[node].called != kNone && found.insert(nodes_[node].called).second) due.push_back(nodes_[node].called);
    }
  }
  return found;
}

/// Whether the routine, or one that it calls, sets it.
bool FrameFlow::sets(std::size_t routine, bool of_tool) const {
  return std::ranges::any_of(called_by(routine), [&](std::size_t one) {
    return of_tool ? routines_[one].sets_tool : routines_[one].sets_frame;
  });
}

/// Those that a call in `routine` may mean: the nearest around it, else its own file's, else the only one there is.
std::vector<std::size_t> FrameFlow::routines_named(const std::string& name, std::size_t routine) const {
  const auto named = by_name_.find(name);
  if (named == by_name_.end()) return {};
  const auto those = [&](const auto& is_meant) {
    std::vector<std::size_t> found;
    std::ranges::copy_if(named->second, std::back_inserter(found), is_meant);
    return found;
  };
  for (std::size_t scope = routine; scope != kNone; scope = routines_[scope].around) {
    const std::vector<std::size_t> near = those([&](std::size_t one) { return routines_[one].around == scope; });
    if (!near.empty()) return near;
  }
  const std::vector<std::size_t> own =
      those([&](std::size_t one) { return routines_[one].file == routines_[routine].file; });
  if (!own.empty()) return own;
  return named->second.size() == 1 ? named->second : std::vector<std::size_t>{};
}

void FrameFlow::resolve_calls() {
  std::vector<std::size_t> several;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const std::vector<std::size_t> meant = routines_named(nodes_[i].callee, nodes_[i].routine);
    if (meant.size() > 1) several.push_back(i);
    if (meant.size() != 1) continue;
    nodes_[i].called = meant.front();
    routines_[meant.front()].callers.insert(i);
  }
  for (const std::size_t i : several) {  // which of them is meant is not told
    for (const std::size_t one : routines_named(nodes_[i].callee, nodes_[i].routine)) {
      if (sets(one, true)) nodes_[i].tool = kDifferingTool;
      if (sets(one, false)) nodes_[i].frame = kDifferingFrame;
      routines_[one].callers.insert(i);
    }
  }
}

/// The last that is told at or before a byte; null where there is none.
const FrameFlow::Node* FrameFlow::node_at(std::size_t offset) const {
  const auto next = std::ranges::upper_bound(nodes_, offset, {}, &Node::at);
  return next == nodes_.begin() ? nullptr : &*std::prev(next);
}

bool FrameFlow::is_straight(std::size_t begin, std::size_t end) const {
  const Node *const first = node_at(begin), *const last = node_at(end);
  if (first == nullptr || last == nullptr || first > last) return false;
  const auto is_own = [&](const std::string& name) { return by_name_.contains(name); };
  if (std::ranges::any_of(at_any_time_, is_own)) return false;
  const auto index = [&](const Node* node) { return static_cast<std::size_t>(node - nodes_.data()); };
  for (std::size_t i = index(first); i < index(last); ++i) {
    if (nodes_[i].next != std::vector<std::size_t>{i + 1} || is_own(nodes_[i + 1].callee)) return false;
  }
  return std::ranges::none_of(nodes_, [&](const Node& node) {
    return std::ranges::any_of(node.next, [&](std::size_t next) {
      return next > index(first) && next <= index(last) && next != index(&node) + 1;
    });
  });
}

void FrameFlow::note_arrivals(Program& program) const {
  std::set<std::size_t> motions;
  for (const Target& target : program.targets) {
    motions.insert(target.order);
    motions.insert(target.further_motions.begin(), target.further_motions.end());
    for (const auto& [begin, place] : target.near_motions) motions.insert(begin);
  }
  motions.insert(program.joints_lost_at.begin(), program.joints_lost_at.end());
  for (const Node& node : nodes_) {
    Stretch stretch{node.at, node.next};
    for (const std::size_t routine : routines_named(node.callee, node.routine))
      stretch.calls.push_back(routines_[routine].entry);
    program.way.push_back(std::move(stretch));
  }
  for (const Routine& routine : routines_) {
    for (const std::size_t node : routine.exits) program.way[node].leaves = true;
  }
  std::set<std::size_t> moving;  // routines
  for (const std::size_t motion : motions) {
    if (const Node* node = node_at(motion)) moving.insert(node->routine);
  }
  const auto moves = [&](std::size_t routine) {
    const std::set<std::size_t> called = called_by(routine);
    return std::ranges::any_of(called, [&](std::size_t one) { return moving.contains(one); });
  };
  for (const Node& node : nodes_) {
    if (std::ranges::any_of(routines_named(node.callee, node.routine), moves))
      program.joints_lost_at.push_back(node.at);
  }
}

/// The states of all nodes, as far as they follow from those at the begin of their routines.
void FrameFlow::follow() {
  std::deque<std::size_t> due;
  for (const Routine& routine : routines_) {
    nodes_[routine.entry].in = {{Value::Kind::entry}, {Value::Kind::entry}};
    due.push_back(routine.entry);
  }
  while (!due.empty()) {
    const std::size_t at = due.front();
    due.pop_front();
    const State out = out_of(nodes_[at]);
    for (const std::size_t next : nodes_[at].next) {
      if (join(out, nodes_[next].in)) due.push_back(next);
    }
    Routine& routine = routines_[nodes_[at].routine];
    if (routine.exits.contains(at) && join(out, routine.exit))
      due.insert(due.end(), routine.callers.begin(), routine.callers.end());
  }
}

}  // namespace demecal::inline parsed_programs

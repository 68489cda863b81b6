#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <deque>
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

/// A name is that of its own file's routine, else that of the only one there is.
void FrameFlow::resolve_calls() {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const auto named = by_name_.find(nodes_[i].callee);
    if (named == by_name_.end()) continue;
    const std::size_t file = routines_[nodes_[i].routine].file;
    const auto own = std::ranges::find_if(named->second, [&](std::size_t one) { return routines_[one].file == file; });
    if (own == named->second.end() && named->second.size() > 1) continue;
    nodes_[i].called = own == named->second.end() ? named->second.front() : *own;
    routines_[nodes_[i].called].callers.insert(i);
  }
}

/// The last that is told at or before a byte; null where there is none.
const FrameFlow::Node* FrameFlow::node_at(std::size_t offset) const {
  const auto next = std::ranges::upper_bound(nodes_, offset, {}, &Node::at);
  return next == nodes_.begin() ? nullptr : &*std::prev(next);
}

void FrameFlow::end_at_routines(Program& program) const {
  std::set<std::size_t> moving;  // routines
  std::size_t first = kNone;
  const auto take_motion = [&](std::size_t offset) {
    first = std::min(first, offset);
    if (const Node* node = node_at(offset)) moving.insert(node->routine);
  };
  for (const Target& target : program.targets) {
    take_motion(target.order);
    std::ranges::for_each(target.further_motions, take_motion);
  }
  std::ranges::for_each(program.unknown_motions, take_motion);
  const auto moves = [&](std::size_t routine) {
    const std::set<std::size_t> called = called_by(routine);
    return std::ranges::any_of(called, [&](std::size_t one) { return moving.contains(one); });
  };
  std::size_t last = kNone;
  for (const Node& node : nodes_) {
    const bool another = last != kNone && node.routine != last;
    if (node.at > first && (another || (node.called != kNone && moves(node.called))))
      program.unknown_motions.push_back(node.at);
    last = node.routine;
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

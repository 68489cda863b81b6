#include "parsed_programs/frame_flow.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <deque>
#include <iterator>
#include <utility>

namespace demecal::inline parsed_programs {
namespace {

KnownFrame differing(const std::string& what) {
  return {what, Eigen::Isometry3d::Identity(), what + " depends on the path that the program takes here"};
}

}  // namespace

FrameFlow::FrameFlow(std::string tool, std::string frame)
    : tool_(std::move(tool)), frame_(std::move(frame)), values_{differing(tool_), differing(frame_)} {}

// What readers tell

std::size_t FrameFlow::add(std::size_t at) {
  if (routines_.empty()) begin_routine(0, "", 0);
  const std::size_t made = nodes_.size();
  for (const std::size_t before : current_) nodes_[before].next.push_back(made);
  nodes_.push_back({.at = at, .routine = present_});
  routines_[present_].nodes.push_back(made);
  current_ = {made};
  return made;
}

/// From the first of two at this byte, which is returned, other paths lead on than through what stands behind.
std::size_t FrameFlow::add_turn(std::size_t at) {
  const std::size_t node = add(at);
  add(at);
  return node;
}

void FrameFlow::end_routine() {
  if (routines_.empty()) return;
  Routine& routine = routines_[present_];
  for (const OpenBlock& block : blocks_) routine.exits.insert(block.ends.begin(), block.ends.end());
  blocks_.clear();
  routine.exits.insert(current_.begin(), current_.end());
  for (const auto& [from, name] : routine.jumps) {
    if (const auto to = routine.labels.find(name); to != routine.labels.end()) nodes_[from].next.push_back(to->second);
  }
  current_.clear();
}

void FrameFlow::start_routine(std::size_t at, const std::string& name, std::size_t file) {
  present_ = routines_.size();
  if (!name.empty()) by_name_[name].push_back(present_);
  routines_.push_back({.name = name, .file = file, .entry = nodes_.size()});
  add(at);
}

void FrameFlow::begin_routine(std::size_t at, const std::string& name, std::size_t file) {
  end_routine();
  start_routine(at, name, file);
}

void FrameFlow::open_routine(std::size_t at, const std::string& name, std::size_t file) {
  if (routines_.empty()) start_routine(0, "", file);
  interrupted_.push_back({present_, std::exchange(current_, {}), std::exchange(blocks_, {})});
  start_routine(at, name, file);
  routines_[present_].around = interrupted_.back().routine;
}

void FrameFlow::close_routine(std::size_t at) {
  if (interrupted_.empty()) return;
  end_routine();
  OpenRoutine outer = std::move(interrupted_.back());
  interrupted_.pop_back();
  present_ = outer.routine;
  current_ = std::move(outer.current);
  blocks_ = std::move(outer.blocks);
  add(at);
}

void FrameFlow::set_tool(std::size_t at, const KnownFrame& tool) {
  nodes_[add(at)].tool = values_.size();
  values_.push_back(tool);
  routines_[present_].sets_tool = true;
}

void FrameFlow::set_frame(std::size_t at, const KnownFrame& frame) {
  nodes_[add(at)].frame = values_.size();
  values_.push_back(frame);
  routines_[present_].sets_frame = true;
}

void FrameFlow::call(std::size_t at, const std::string& name, bool is_routine) {
  Node& node = nodes_[add(at)];
  node.callee = name;
  node.believed = is_routine;
}

void FrameFlow::open(std::size_t at, Block kind) {
  const std::size_t node = add_turn(at);
  blocks_.push_back({kind, node, node});
  if (kind == Block::selection) current_.clear();
}

void FrameFlow::alternative(std::size_t at, bool takes_all_left) {
  if (!blocks_.empty()) {
    OpenBlock& block = blocks_.back();
    block.ends.insert(block.ends.end(), current_.begin(), current_.end());
    block.complete = block.complete || takes_all_left;
    current_ = {block.skip};
  }
  add(at);
}

void FrameFlow::condition_ends(std::size_t at) {
  const std::size_t node = add_turn(at);
  if (!blocks_.empty()) blocks_.back().skip = node;
}

void FrameFlow::close(std::size_t at) {
  if (!blocks_.empty()) {
    OpenBlock block = std::move(blocks_.back());
    blocks_.pop_back();
    const bool loops = block.kind == Block::loop || block.kind == Block::repeated || block.kind == Block::endless;
    for (const std::size_t last : current_) {
      if (loops) nodes_[last].next.push_back(block.node);
    }
    if (block.kind == Block::loop || block.kind == Block::endless) current_.clear();
    if (block.kind == Block::loop || (!loops && !block.complete)) current_.push_back(block.skip);
    current_.insert(current_.end(), block.ends.begin(), block.ends.end());
  }
  add(at);
}

FrameFlow::OpenBlock* FrameFlow::innermost_loop() {
  const auto loop = std::find_if(blocks_.rbegin(), blocks_.rend(), [](const OpenBlock& block) {
    return block.kind != Block::branch && block.kind != Block::selection;
  });
  return loop == blocks_.rend() ? nullptr : &*loop;
}

void FrameFlow::leave_loop(std::size_t at) {
  const std::size_t node = add_turn(at);
  OpenBlock* loop = innermost_loop();
  if (loop == nullptr) return;
  loop->ends.push_back(node);
  current_.clear();
}

void FrameFlow::repeat_loop(std::size_t at) {
  const std::size_t node = add_turn(at);
  const OpenBlock* loop = innermost_loop();
  if (loop == nullptr) return;
  nodes_[node].next.push_back(loop->node);
  current_.clear();
}

void FrameFlow::leave_routine(std::size_t at) {
  const std::size_t node = add_turn(at);
  routines_[present_].exits.insert(node);
  current_.clear();
}

void FrameFlow::label(std::size_t at, const std::string& name) {
  const std::size_t node = add(at);
  routines_[present_].labels.try_emplace(name, node);
}

void FrameFlow::jump(std::size_t at, const std::string& name, bool always) {
  const std::size_t node = add_turn(at);
  routines_[present_].jumps.emplace_back(node, name);
  if (always) current_.clear();
}

// What follows from it

/// What a routine that nothing here calls begins with.
KnownFrame FrameFlow::initial(std::size_t routine, bool of_tool) const {
  const std::string& what = of_tool ? tool_ : frame_;
  const bool set =
      std::ranges::any_of(routines_, [&](const Routine& one) { return of_tool ? one.sets_tool : one.sets_frame; });
  if (!set) return {};
  const std::set<std::size_t> own =
      at_any_time_.contains(routines_[routine].name) ? std::set<std::size_t>{} : called_by(routine);
  bool here = false, elsewhere = false;
  for (std::size_t other = 0; other < routines_.size(); ++other) {
    if (here) break;
    if (!(of_tool ? routines_[other].sets_tool : routines_[other].sets_frame) || own.contains(other)) continue;
    (routines_[other].file == routines_[routine].file ? here : elsewhere) = true;
  }
  if (!here && !elsewhere) return {};
  return {what, Eigen::Isometry3d::Identity(),
          what + " is set in another " + (here ? "routine" : "file") + " of the program"};
}

/// Hands what callers hold to the routines that they call.
void FrameFlow::begin_called_routines() {
  std::deque<std::size_t> due;
  const auto begin = [&](std::size_t routine) {
    for (const bool of_tool : {true, false}) {
      values_.push_back(initial(routine, of_tool));
      (of_tool ? routines_[routine].begin.tool : routines_[routine].begin.frame) = {Value::Kind::known,
                                                                                    values_.size() - 1, kNone};
    }
    due.push_back(routine);
  };
  const auto hand_on = [&] {
    while (!due.empty()) {
      const Routine& routine = routines_[due.front()];
      due.pop_front();
      for (const std::size_t node : routine.nodes) {
        if (nodes_[node].called == kNone) continue;
        if (join(begun(nodes_[node].in, routine.begin), routines_[nodes_[node].called].begin))
          due.push_back(nodes_[node].called);
      }
    }
  };
  for (std::size_t i = 0; i < routines_.size(); ++i) {
    if (routines_[i].callers.empty()) begin(i);
  }
  hand_on();
  for (std::size_t i = 0; i < routines_.size(); ++i) {  // those that only call each other
    if (routines_[i].begin.tool.kind == Value::Kind::unreached) begin(i);
    hand_on();
  }
}

void FrameFlow::finish() {
  while (!interrupted_.empty()) close_routine(nodes_.back().at);
  end_routine();
  resolve_calls();
  follow();
  begin_called_routines();
}

KnownFrame FrameFlow::value_of(const Value& value, bool of_tool) const {
  const std::string& what = of_tool ? tool_ : frame_;
  for (const std::string& name : at_any_time_) {
    const auto named = by_name_.find(name);
    if (named == by_name_.end()) continue;
    if (std::ranges::any_of(named->second, [&](std::size_t one) { return sets(one, of_tool); }))
      return {what, Eigen::Isometry3d::Identity(), what + " is set by " + name + ", which may run at any time"};
  }
  if (value.kind == Value::Kind::known) return values_[value.index];
  return {what, Eigen::Isometry3d::Identity(), what + " is not known where no path leads to"};
}

FrameFlow::Held FrameFlow::at(std::size_t offset) const {
  if (node_at(offset) == nullptr) return {};
  const Node& node = *node_at(offset);
  const State state = begun(out_of(node), routines_[node.routine].begin);
  Held held;
  const KnownFrame tool = value_of(state.tool, true), frame = value_of(state.frame, false);
  if (!tool.name.empty()) demecal::set_tool(held.frames, tool);
  if (!frame.name.empty()) demecal::set_frame(held.frames, frame);
  const std::size_t call = std::min(state.tool.call, state.frame.call);
  if (call != kNone) held.call = call;
  return held;
}

std::set<std::size_t> FrameFlow::calls_elsewhere() const {
  std::set<std::size_t> found;
  for (const Node& node : nodes_) {
    if (node.believed && node.called == kNone) found.insert(node.at);
  }
  return found;
}

void note_calls_elsewhere(const ProgramText& text, const std::set<std::size_t>& calls,
                          const std::map<std::size_t, std::string>& names_of, Program& program,
                          const std::string& remedy) {
  constexpr std::size_t kNamed = 3;
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (const std::size_t at : calls) {
    const auto call = names_of.find(at);
    if (call != names_of.end() && seen.insert(call->second).second) names.push_back(call->second);
  }
  if (names.empty()) return;
  std::string list = names.front();
  for (std::size_t i = 1; i < std::min(names.size(), kNamed); ++i) list += ", " + names[i];
  if (names.size() > kNamed) list += " and " + std::to_string(names.size() - kNamed) + " more";
  const bool one = names.size() == 1;
  program.remarks.push_back({text.place(*calls.begin()), "",
                             list + (one ? " is" : " are") + " not in the files given, and " + (one ? "is" : "are") +
                                 " taken to leave tool, frame and the arm as they are; where that is not so, " +
                                 remedy});
}

}  // namespace demecal::inline parsed_programs

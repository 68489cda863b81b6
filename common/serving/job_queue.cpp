#include "serving/job_queue.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "errors/check.hpp"

namespace demecal::inline serving {
namespace {

constexpr std::size_t kLongestName = 64;
constexpr int kDone = 0, kInterrupted = 130;  // exit codes of `demecal`

constexpr std::array<std::pair<JobState, const char*>, 6> kJobStates{{{JobState::ready, "ready"},
                                                                      {JobState::waiting, "waiting"},
                                                                      {JobState::running, "running"},
                                                                      {JobState::done, "done"},
                                                                      {JobState::failed, "failed"},
                                                                      {JobState::interrupted, "interrupted"}}};

bool is_letter_or_digit(char letter) {
  return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') || (letter >= '0' && letter <= '9');
}

bool is_queued(JobState state) {
  return state == JobState::waiting || state == JobState::running;
}

}  // namespace

bool is_plain_name(std::string_view name) {
  if (name.empty() || name.size() > kLongestName || !is_letter_or_digit(name.front())) return false;
  return std::ranges::all_of(
      name, [](char letter) { return is_letter_or_digit(letter) || letter == '.' || letter == '_' || letter == '-'; });
}

std::string to_string(JobState state) {
  for (const auto& [known, word] : kJobStates) {
    if (known == state) return word;
  }
  DEMECAL_CHECK(false, "state=" << static_cast<int>(state));
  return {};
}

std::string record_text(const JobRecord& record) {
  nlohmann::ordered_json text{{"demecal_served_job", 1},
                              {"state", to_string(record.state)},
                              {"exit_code", record.exit_code},
                              {"began_s", record.began_s},
                              {"ended_s", record.ended_s}};
  return text.dump() + '\n';
}

JobRecord parse_record(const std::string& text) {
  const auto read = nlohmann::json::parse(text, nullptr, false);
  if (!read.is_object()) return {};
  JobRecord record;
  const auto state = read.find("state");
  for (const auto& [known, word] : kJobStates) {
    if (state != read.end() && *state == word) record.state = is_queued(known) ? JobState::interrupted : known;
  }
  const auto number = [&](const char* key) {
    const auto found = read.find(key);
    return found != read.end() && found->is_number_integer() ? found->get<std::int64_t>() : 0;
  };
  record.exit_code = static_cast<int>(number("exit_code"));
  record.began_s = number("began_s");
  record.ended_s = number("ended_s");
  return record;
}

void JobQueue::add(const JobId& id) {
  if (!is_plain_name(id.job))
    throw Refusal(Refusal::Kind::invalid,
                  "a job's name has up to 64 letters a to z, digits and . _ -, with a letter or digit first");
  if (records_.contains(id)) throw Refusal(Refusal::Kind::conflict, "there is a job " + id.job + " already");
  if (jobs_of(id.user).size() >= limits_.jobs_each)
    throw Refusal(Refusal::Kind::limit, "you have " + std::to_string(limits_.jobs_each) +
                                            " jobs, and no more are kept: remove one that you no longer need");
  records_[id] = {};
}

void JobQueue::remove(const JobId& id) {
  idle(id);
  records_.erase(id);
}

void JobQueue::change_files(const JobId& id) {
  idle(id).state = JobState::ready;
}

void JobQueue::ask_to_run(const JobId& id) {
  JobRecord& record = idle(id);
  const auto theirs = std::ranges::count(waiting_, id.user, &JobId::user);
  if (waiting_.size() >= limits_.waiting || static_cast<std::size_t>(theirs) >= limits_.waiting_each)
    throw Refusal(Refusal::Kind::limit, "too many jobs wait already: try again when some have run");
  record.state = JobState::waiting;
  waiting_.push_back(id);
}

bool JobQueue::ask_to_stop(const JobId& id) {
  const JobState state = record(id).state;
  if (state == JobState::running) return true;
  if (state != JobState::waiting)
    throw Refusal(Refusal::Kind::conflict, "the job " + id.job + " neither runs nor waits");
  std::erase(waiting_, id);
  records_.at(id).state = JobState::ready;
  return false;
}

std::optional<JobId> JobQueue::begin_next(std::int64_t now_s) {
  if (running_ || waiting_.empty()) return std::nullopt;
  running_ = waiting_.front();
  waiting_.pop_front();
  JobRecord& record = records_.at(*running_);
  record.state = JobState::running;
  record.began_s = now_s;
  record.ended_s = 0;
  return running_;
}

void JobQueue::end(int exit_code, std::int64_t now_s) {
  DEMECAL_CHECK(running_.has_value(), "exit_code=" << exit_code);
  JobRecord& record = records_.at(*running_);
  record.state = exit_code == kDone          ? JobState::done
                 : exit_code == kInterrupted ? JobState::interrupted
                                             : JobState::failed;
  record.exit_code = exit_code;
  record.ended_s = now_s;
  running_.reset();
}

const JobRecord& JobQueue::record(const JobId& id) const {
  const auto found = records_.find(id);
  if (found == records_.end()) throw Refusal(Refusal::Kind::unknown, "you have no such job");
  return found->second;
}

std::vector<std::string> JobQueue::jobs_of(const std::string& user) const {
  std::vector<std::string> jobs;
  for (auto one = records_.lower_bound({user, ""}); one != records_.end() && one->first.user == user; ++one)
    jobs.push_back(one->first.job);
  return jobs;
}

std::size_t JobQueue::before(const JobId& id) const {
  const auto place = std::ranges::find(waiting_, id);
  if (place == waiting_.end()) return 0;
  return static_cast<std::size_t>(place - waiting_.begin()) + (running_ ? 1 : 0);
}

/// The record of a job that neither runs nor waits.
JobRecord& JobQueue::idle(const JobId& id) {
  if (is_queued(record(id).state))
    throw Refusal(Refusal::Kind::conflict, "the job " + id.job + " runs or waits: stop it first");
  return records_.at(id);
}

}  // namespace demecal::inline serving

#include "coordinator/jobs/job_service.hpp"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>
#include <utility>

#include "errors/input_error.hpp"
#include "serving/job_files.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t kMostOfTerminal = 65536, kMostOfLastLine = 400, kMostOfReport = 32 << 20;

[[noreturn]] void refuse_unknown() {
  throw Refusal(Refusal::Kind::unknown, "there is nothing here");
}

int status_of(Refusal::Kind kind) {
  switch (kind) {
    case Refusal::Kind::unknown:
      return 404;
    case Refusal::Kind::conflict:
      return 409;
    case Refusal::Kind::limit:
      return 429;
    case Refusal::Kind::invalid:
      break;
  }
  return 422;
}

/// JSON of texts that may hold any bytes.
std::string json_body(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string last_line(const std::string& text) {
  const std::size_t end = text.find_last_not_of("\r\n \t");
  if (end == std::string::npos) return {};
  const std::size_t begin = text.find_last_of("\r\n", end);
  return text.substr(begin == std::string::npos ? 0 : begin + 1,
                     end - (begin == std::string::npos ? 0 : begin + 1) + 1);
}

Json files_json(const std::vector<ListedFile>& files) {
  Json list = Json::array();
  for (const ListedFile& file : files) list.push_back({{"name", file.name}, {"bytes", file.bytes}});
  return list;
}

std::string content_type(const std::string& name) {
  if (name.ends_with(".html")) return "text/html; charset=utf-8";
  if (name.ends_with(".json")) return "application/json";
  if (name.ends_with(".xml")) return "application/xml";
  if (name.ends_with(".pdf")) return "application/pdf";
  return "text/plain; charset=utf-8";
}

std::string require_tolerance(const std::string& text) {
  double tolerance_mm = 0.0;
  const char* const end = text.data() + text.size();
  const auto [stop, fault] = std::from_chars(text.data(), end, tolerance_mm, std::chars_format::fixed);
  if (fault != std::errc() || stop != end || !(tolerance_mm > 0.0 && tolerance_mm <= 1000.0))
    throw Refusal(Refusal::Kind::invalid, "tolerance_mm must be a number of mm above 0, up to 1000");
  return text;
}

}  // namespace

JobService::JobService(JobServiceOptions options)
    : options_(std::move(options)), folders_(options_.folder), lock_(folders_.lock()), queue_(options_.queue) {
  for (const JobId& id : folders_.jobs()) {
    try {
      folders_.remove_unfinished(id);
      queue_.restore(id, folders_.record(id));
    } catch (const std::system_error& error) {
      say(std::string(error.what()) + "; the job is left out");
    }
  }
}

void JobService::say(const std::string& trouble) {
  if (trouble != said_) std::fprintf(stderr, "%s\n", trouble.c_str());
  said_ = trouble;
}

void JobService::save_or_say(const JobId& id) {
  try {
    folders_.save(id, queue_.record(id));
    said_.clear();
  } catch (const std::system_error& error) {
    say(error.what());
  }
}

ServiceAnswer JobService::answer(const ServiceRequest& request) {
  try {
    return answer_checked(request);
  } catch (const Refusal& refusal) {
    return {.status = status_of(refusal.kind()), .body = refusal.what()};
  } catch (const InputError& error) {
    return {.status = 422, .body = error.what()};
  } catch (const std::system_error& error) {
    const bool is_full = error.code().value() == ENOSPC || error.code().value() == EDQUOT;
    return {.status = is_full ? 507 : 500, .body = is_full ? "the server's disk is full" : error.what()};
  }
}

ServiceAnswer JobService::answer_checked(const ServiceRequest& request) {
  const std::vector<std::string>& path = request.path;
  if (request.changes) {
    if (path.size() < 3 || path[0] != "jobs") refuse_unknown();
    change({request.user, path[1]}, request);
    return {.body = "{}\n"};
  }
  const std::lock_guard lock(mutex_);
  if (path.size() == 1 && path[0] == "jobs") return {.body = list(request.user)};
  if (path.size() == 1 && path[0] == "comparison") return {.body = comparison(request.user)};
  if (path.size() < 3 || path[0] != "jobs") refuse_unknown();
  const JobId id{request.user, path[1]};
  queue_.record(id);
  if (path.size() == 3 && path[2] == "terminal")
    return {.body = json_body({{"text", folders_.terminal(id, kMostOfTerminal)}})};
  if (path.size() == 4 && path[2] == "results") return result(id, request);
  refuse_unknown();
}

std::string JobService::list(const std::string& user) const {
  Json jobs = Json::array();
  for (const std::string& job : queue_.jobs_of(user)) {
    const JobId id{user, job};
    const JobRecord& record = queue_.record(id);
    jobs.push_back({{"name", job},
                    {"state", to_string(record.state)},
                    {"before", queue_.before(id)},
                    {"exit_code", record.exit_code},
                    {"began_s", record.began_s},
                    {"ended_s", record.ended_s},
                    {"goes_on", record.state == JobState::interrupted && folders_.can_go_on(id)},
                    {"said", last_line(folders_.terminal(id, kMostOfLastLine))},
                    {"files", files_json(folders_.inputs(id))},
                    {"results", files_json(folders_.results(id))}});
  }
  const Json limits{{"jobs", options_.queue.jobs_each},
                    {"files", options_.files_each},
                    {"bytes_of_job", options_.bytes_each},
                    {"bytes_of_yaml", options_.yaml_bytes}};
  return json_body({{"demecal_jobs", 1},
                    {"user", user},
                    {"signs_in", options_.signs_in},
                    {"limits", limits},
                    {"jobs", std::move(jobs)}});
}

std::string JobService::comparison(const std::string& user) const {
  std::vector<std::pair<std::string, std::string>> reports;
  for (const std::string& job : queue_.jobs_of(user)) {
    const JobId id{user, job};
    if (queue_.record(id).state != JobState::done) continue;
    reports.emplace_back(job, folders_.result(id, "report.json", kMostOfReport).value_or(""));
  }
  return comparison_text(reports);
}

ServiceAnswer JobService::result(const JobId& id, const ServiceRequest& request) const {
  const std::string& name = request.path[3];
  ServiceAnswer answer;
  answer.file = folders_.open_result(id, name);
  if (!answer.file) refuse_unknown();
  answer.type = content_type(name);
  answer.file_name = id.job + '-' + name;
  answer.is_shown = name.ends_with(".html") && !request.parameters.contains("save");
  return answer;
}

void JobService::change(const JobId& id, const ServiceRequest& request) {
  const std::vector<std::string>& path = request.path;
  if (path.size() == 4 && path[2] == "files") return put(id, path[3], request.body);
  const std::lock_guard lock(mutex_);
  if (path.size() == 5 && path[2] == "files" && path[4] == "remove") return remove_file(id, path[3]);
  if (path.size() != 3) refuse_unknown();
  if (path[2] == "make") {
    JobQueue changed = queue_;  // takes effect where all else went well
    changed.add(id);
    folders_.make(id);
    folders_.save(id, changed.record(id));
    queue_ = std::move(changed);
  } else if (path[2] == "remove") {
    queue_.remove(id);
    folders_.remove(id);
  } else if (path[2] == "run") {
    ask_to_run(id, request);
  } else if (path[2] == "stop") {
    const bool is_running = queue_.ask_to_stop(id);
    is_stopping_ = is_stopping_ || is_running;
    save_or_say(id);
  } else {
    refuse_unknown();
  }
}

void JobService::put(const JobId& id, const std::string& file, const std::string& bytes) {
  if (!is_plain_name(file))
    throw Refusal(Refusal::Kind::invalid,
                  "a file's name has up to 64 letters a to z, digits and . _ -, with a letter or digit first");
  if (is_yaml_name(file)) {
    if (bytes.size() > options_.yaml_bytes)
      throw Refusal(Refusal::Kind::limit, file + " is larger than a YAML file may be (1 MB)");
    check_named_files(parse_yaml(bytes, file), {});
  }
  const std::lock_guard lock(mutex_);
  queue_.record(id);
  std::uint64_t all_bytes = bytes.size();
  std::size_t files = 1;
  for (const ListedFile& other : folders_.inputs(id)) {
    if (other.name == file) continue;
    all_bytes += other.bytes;
    ++files;
  }
  if (files > options_.files_each)
    throw Refusal(Refusal::Kind::limit, "a job has at most " + std::to_string(options_.files_each) + " files");
  if (all_bytes > options_.bytes_each)
    throw Refusal(Refusal::Kind::limit,
                  "the files of a job have at most " + std::to_string(options_.bytes_each >> 20) + " MB");
  JobQueue changed = queue_;
  changed.change_files(id);
  folders_.save(id, changed.record(id));
  queue_ = std::move(changed);
  folders_.put_input(id, file, bytes);
}

/// Even where the new state cannot be saved: on a full disk this makes room.
void JobService::remove_file(const JobId& id, const std::string& file) {
  JobQueue changed = queue_;
  changed.change_files(id);
  if (!is_plain_name(file) || !folders_.remove_input(id, file)) refuse_unknown();
  queue_ = std::move(changed);
  save_or_say(id);
}

/// The YAML files name only what was uploaded, and one of them is the job.
JobFiles JobService::checked_files(const JobId& id) const {
  std::set<std::string> names;
  for (const ListedFile& file : folders_.inputs(id)) names.insert(file.name);
  std::map<std::string, YamlNode> yaml;
  std::uint64_t bytes = 0;
  for (const std::string& name : names) {
    if (!is_yaml_name(name)) continue;
    const std::string text = folders_.input(id, name);
    bytes += text.size();
    if (bytes > options_.yaml_bytes_each)
      throw Refusal(Refusal::Kind::limit, "the YAML files of a job have at most 4 MB together");
    const YamlNode& root = yaml[name] = parse_yaml(text, name);
    check_named_files(root, names);
  }
  return find_job(yaml);
}

void JobService::ask_to_run(const JobId& id, const ServiceRequest& request) {
  queue_.record(id);  // before anything is opened by that name
  const JobFiles files = checked_files(id);
  RunOrder order;
  order.goes_on = queue_.record(id).state == JobState::interrupted && folders_.can_go_on(id);
  std::vector<std::string> calibrate{"calibrate", "input/" + files.job, order.goes_on ? "--resume" : "--out",
                                     "results"};
  calibrate.insert(calibrate.end(), options_.run_arguments.begin(), options_.run_arguments.end());
  order.commands.push_back(std::move(calibrate));
  if (const auto tolerance = request.parameters.find("tolerance_mm"); tolerance != request.parameters.end()) {
    if (files.data.size() != 1)
      throw Refusal(Refusal::Kind::invalid, "a certificate needs a job with one data set: leave out tolerance_mm");
    order.commands.push_back({"certify", "results/model.yaml", "input/" + files.data.front(), "--tolerance",
                              require_tolerance(tolerance->second), "--out", "results"});
  }
  JobQueue changed = queue_;
  changed.ask_to_run(id);
  folders_.save(id, changed.record(id));
  queue_ = std::move(changed);
  orders_[id] = std::move(order);
}

}  // namespace demecal

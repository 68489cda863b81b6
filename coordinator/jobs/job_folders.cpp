#include "coordinator/jobs/job_folders.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <ranges>
#include <system_error>
#include <utility>

#include "errors/check.hpp"
#include "errors/input_error.hpp"

namespace demecal {
namespace {

constexpr int kFolder = O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;
constexpr int kToRead = O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;  // a pipe would keep us waiting
constexpr int kToWrite = O_WRONLY | O_CREAT | O_NOFOLLOW | O_CLOEXEC;    // closed in runs: they must not hold the lock
constexpr mode_t kOwnFolder = 0700, kOwnFile = 0600;
constexpr const char* kInput = "input";
constexpr const char* kResults = "results";
constexpr const char* kTerminal = "terminal.log";
constexpr const char* kRecord = "job.json";
constexpr const char* kBeingWritten = ".being-written";
constexpr std::uint64_t kMostOfRecord = 4096;

constexpr std::array<const char*, 12> kOffered{
    "report.html",     "report.json", "model.yaml", "model-best.yaml", "certificate.html", "certificate.pdf",
    "certificate.xml", "history.csv", "fronts.csv", "distal.csv",      "pose-errors.csv",  "events.jsonl"};

[[noreturn]] void fail_with(int error, const std::string& what) {
  throw std::system_error(error, std::generic_category(), what);
}

[[noreturn]] void fail_with_errno(const std::string& what) {
  fail_with(errno, what);
}

OwnedDescriptor open_below(int folder, const std::string& name, int flags) {
  return OwnedDescriptor(::openat(folder, name.c_str(), flags, kOwnFile));
}

/// What stands in a job's folder, as messages name it.
std::string name_in_job(const JobId& id, const std::string& name) {
  return id.user + '/' + id.job + '/' + name;
}

OwnedDescriptor made_below(int folder, const std::string& name, const std::string& shown) {
  if (::mkdirat(folder, name.c_str(), kOwnFolder) != 0 && errno != EEXIST)
    fail_with_errno("the folder " + shown + " cannot be made");
  OwnedDescriptor made = open_below(folder, name, kFolder);
  if (made.get() < 0) fail_with_errno("the folder " + shown + " cannot be opened");
  return made;
}

/// The size of a regular file; nothing of anything else.
std::optional<std::uint64_t> regular_file_size(int descriptor) {
  struct stat found {};
  if (descriptor < 0 || ::fstat(descriptor, &found) != 0 || !S_ISREG(found.st_mode)) return std::nullopt;
  return static_cast<std::uint64_t>(found.st_size);
}

/// The entries of a folder that are called by plain names.
std::vector<std::string> plain_names(const OwnedDescriptor& folder) {
  std::vector<std::string> names;
  const int again = folder.get() < 0 ? -1 : ::openat(folder.get(), ".", kFolder);
  DIR* const listing = again < 0 ? nullptr : ::fdopendir(again);
  if (listing == nullptr) return names;
  while (const dirent* const entry = ::readdir(listing)) {  // NOLINT(concurrency-mt-unsafe): each has its own listing
    if (is_plain_name(entry->d_name)) names.emplace_back(entry->d_name);
  }
  ::closedir(listing);
  std::ranges::sort(names);
  return names;
}

std::vector<ListedFile> files_in(const OwnedDescriptor& folder) {
  std::vector<ListedFile> files;
  for (const std::string& name : plain_names(folder)) {
    const OwnedDescriptor file = open_below(folder.get(), name, kToRead);
    if (const auto bytes = regular_file_size(file.get())) files.push_back({name, *bytes});
  }
  return files;
}

/// Bytes of the file from `begin` on; fewer where it has become shorter.
std::string read_bytes(int descriptor, std::uint64_t begin, std::uint64_t count, const std::string& shown) {
  std::string bytes(count, '\0');
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t got = ::pread(descriptor, bytes.data() + done, bytes.size() - done, static_cast<off_t>(begin + done));
    if (got < 0) fail_with_errno(shown + " cannot be read");
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  bytes.resize(done);
  return bytes;
}

/// The file appears whole or not at all, and what could not be finished takes no room.
void write_whole(int folder, const std::string& name, std::string_view bytes, const std::string& shown) {
  const OwnedDescriptor file = open_below(folder, kBeingWritten, kToWrite | O_TRUNC);
  int fault = file.get() < 0 ? errno : 0;
  for (std::size_t done = 0; done < bytes.size() && fault == 0;) {
    const ssize_t put = ::write(file.get(), bytes.data() + done, bytes.size() - done);
    if (put <= 0) fault = put < 0 ? errno : EIO;
    done += static_cast<std::size_t>(std::max<ssize_t>(put, 0));
  }
  if (fault == 0 && ::renameat(folder, kBeingWritten, folder, name.c_str()) != 0) fault = errno;
  if (fault == 0) return;
  ::unlinkat(folder, kBeingWritten, 0);
  fail_with(fault, shown + " cannot be written");
}

}  // namespace

OwnedDescriptor::~OwnedDescriptor() {
  if (number_ >= 0) ::close(number_);
}

OwnedDescriptor& OwnedDescriptor::operator=(OwnedDescriptor&& other) noexcept {
  std::swap(number_, other.number_);
  return *this;
}

int OwnedDescriptor::release() {
  return std::exchange(number_, -1);
}

JobFolders::JobFolders(const std::string& root) : root_(std::filesystem::absolute(root).lexically_normal().string()) {
  std::error_code fault;
  std::filesystem::create_directories(root_, fault);
  descriptor_ = OwnedDescriptor(::open(root_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (fault || descriptor_.get() < 0 || ::faccessat(descriptor_.get(), ".", W_OK | X_OK, AT_EACCESS) != 0)
    throw InputError({root_, 0}, "", "must be a folder that can be written to: name another with --dir");
}

OwnedDescriptor JobFolders::lock() const {
  OwnedDescriptor again = open_below(descriptor_.get(), ".", kFolder);  // closed in runs: they must not hold it
  if (::flock(again.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw InputError({root_, 0}, "",
                     "another demecal serves the jobs of this folder: end it, or name another folder with --dir");
  return again;
}

std::vector<JobId> JobFolders::jobs() const {
  std::vector<JobId> found;
  for (const std::string& user : plain_names(descriptor_)) {
    const OwnedDescriptor folder = open_below(descriptor_.get(), user, kFolder);
    for (const std::string& job : plain_names(folder)) {
      if (open_below(folder.get(), job, kFolder).get() >= 0) found.push_back({user, job});
    }
  }
  return found;
}

OwnedDescriptor JobFolders::folder(const JobId& id) const {
  DEMECAL_CHECK(is_plain_name(id.user) && is_plain_name(id.job), "user=" << id.user << " job=" << id.job);
  const OwnedDescriptor user = open_below(descriptor_.get(), id.user, kFolder);
  OwnedDescriptor job = open_below(user.get(), id.job, kFolder);
  if (user.get() < 0 || job.get() < 0) fail_with_errno("the folder " + id.user + '/' + id.job + " cannot be opened");
  return job;
}

void JobFolders::make(const JobId& id) const {
  DEMECAL_CHECK(is_plain_name(id.user) && is_plain_name(id.job), "user=" << id.user << " job=" << id.job);
  const OwnedDescriptor user = made_below(descriptor_.get(), id.user, id.user);
  const OwnedDescriptor job = made_below(user.get(), id.job, id.user + '/' + id.job);
  made_below(job.get(), kInput, name_in_job(id, kInput));
}

void JobFolders::remove(const JobId& id) const {
  const OwnedDescriptor is_there = folder(id);
  std::filesystem::remove_all(path_of(id));  // of a link it removes the link
}

std::string JobFolders::path_of(const JobId& id) const {
  return root_ + '/' + id.user + '/' + id.job;
}

std::vector<ListedFile> JobFolders::inputs(const JobId& id) const {
  return files_in(open_below(folder(id).get(), kInput, kFolder));
}

std::string JobFolders::input(const JobId& id, const std::string& name) const {
  DEMECAL_CHECK(is_plain_name(name), "name=" << name);
  const OwnedDescriptor inputs = open_below(folder(id).get(), kInput, kFolder);
  const OwnedDescriptor file = open_below(inputs.get(), name, kToRead);
  const auto size = regular_file_size(file.get());
  if (!size) fail_with(file.get() < 0 ? errno : EINVAL, name + ", which was uploaded, cannot be read");
  return read_bytes(file.get(), 0, *size, name);
}

void JobFolders::put_input(const JobId& id, const std::string& name, std::string_view bytes) const {
  DEMECAL_CHECK(is_plain_name(name), "name=" << name);
  const OwnedDescriptor inputs = made_below(folder(id).get(), kInput, name_in_job(id, kInput));
  write_whole(inputs.get(), name, bytes, name);
}

void JobFolders::remove_unfinished(const JobId& id) const {
  const OwnedDescriptor job = folder(id), inputs = open_below(job.get(), kInput, kFolder);
  for (const OwnedDescriptor* const there : {&job, &inputs}) ::unlinkat(there->get(), kBeingWritten, 0);
}

bool JobFolders::remove_input(const JobId& id, const std::string& name) const {
  DEMECAL_CHECK(is_plain_name(name), "name=" << name);
  const OwnedDescriptor inputs = open_below(folder(id).get(), kInput, kFolder);
  if (::unlinkat(inputs.get(), name.c_str(), 0) == 0) return true;
  if (errno != ENOENT) fail_with_errno(name + " cannot be removed");
  return false;
}

std::vector<ListedFile> JobFolders::results(const JobId& id) const {
  std::vector<ListedFile> files = files_in(open_below(folder(id).get(), kResults, kFolder));
  std::erase_if(files, [](const ListedFile& file) { return !is_offered(file.name); });
  const auto rank = [](const ListedFile& file) { return std::ranges::find(kOffered, file.name); };
  std::ranges::sort(files, {}, rank);
  return files;
}

bool JobFolders::is_offered(const std::string& name) {
  return std::ranges::find(kOffered, name) != kOffered.end();
}

std::shared_ptr<AnsweredFile> JobFolders::open_result(const JobId& id, const std::string& name) const {
  if (!is_offered(name)) return nullptr;
  const OwnedDescriptor results = open_below(folder(id).get(), kResults, kFolder);
  OwnedDescriptor file = open_below(results.get(), name, kToRead);
  const auto size = regular_file_size(file.get());
  if (!size) return nullptr;
  return std::make_shared<AnsweredFile>(file.release(), *size);
}

std::optional<std::string> JobFolders::result(const JobId& id, const std::string& name, std::uint64_t most) const {
  const std::shared_ptr<AnsweredFile> file = open_result(id, name);
  if (!file || file->bytes() > most) return std::nullopt;
  return read_bytes(file->descriptor(), 0, file->bytes(), name);
}

void JobFolders::remove_results(const JobId& id, std::string_view beginning) const {
  const OwnedDescriptor results = open_below(folder(id).get(), kResults, kFolder);
  if (results.get() < 0) return;
  for (const char* const name : kOffered) {
    if (!std::string_view(name).starts_with(beginning)) continue;
    if (::unlinkat(results.get(), name, 0) != 0 && errno != ENOENT)
      fail_with_errno(name_in_job(id, std::string(kResults) + '/' + name) + " cannot be removed");
  }
}

bool JobFolders::can_go_on(const JobId& id) const {
  const OwnedDescriptor results = open_below(folder(id).get(), kResults, kFolder);
  return regular_file_size(open_below(results.get(), "run.journal", kToRead).get()).has_value();
}

OwnedDescriptor JobFolders::open_terminal(const JobId& id, bool keep) const {
  OwnedDescriptor file = open_below(folder(id).get(), kTerminal, kToWrite | O_APPEND | (keep ? 0 : O_TRUNC));
  if (file.get() < 0) fail_with_errno(name_in_job(id, kTerminal) + " cannot be written");
  return file;
}

std::string JobFolders::terminal(const JobId& id, std::uint64_t most) const {
  const OwnedDescriptor file = open_below(folder(id).get(), kTerminal, kToRead);
  const std::uint64_t size = regular_file_size(file.get()).value_or(0), count = std::min(size, most);
  return count == 0 ? "" : read_bytes(file.get(), size - count, count, name_in_job(id, kTerminal));
}

JobRecord JobFolders::record(const JobId& id) const {
  const OwnedDescriptor file = open_below(folder(id).get(), kRecord, kToRead);
  const auto size = regular_file_size(file.get());
  if (!size || *size > kMostOfRecord) return {};
  return parse_record(read_bytes(file.get(), 0, *size, name_in_job(id, kRecord)));
}

void JobFolders::save(const JobId& id, const JobRecord& record) const {
  write_whole(folder(id).get(), kRecord, record_text(record), name_in_job(id, kRecord));
}

}  // namespace demecal

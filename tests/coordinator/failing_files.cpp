// The system's calls, as this program of tests has them.
#include "failing_files.hpp"

#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>

namespace demecal {
namespace {

thread_local bool files_fail = false;

}  // namespace

FailingFiles::FailingFiles() {
  files_fail = true;
}
FailingFiles::~FailingFiles() {
  files_fail = false;
}

}  // namespace demecal

extern "C" ssize_t pread(int file, void* bytes, size_t count, off_t begin) {
  if (!demecal::files_fail) return ::syscall(SYS_pread64, file, bytes, count, begin);
  errno = EIO;
  return -1;
}

extern "C" ssize_t write(int file, const void* bytes, size_t count) {
  return demecal::files_fail ? 0 : ::syscall(SYS_write, file, bytes, count);
}

// Files that this thread can neither read nor write, as of a broken disk.
#pragma once

namespace demecal {

/// While it lives, pread of this thread fails and write takes nothing.
class FailingFiles {
 public:
  FailingFiles();
  ~FailingFiles();
  FailingFiles(const FailingFiles&) = delete;
  FailingFiles& operator=(const FailingFiles&) = delete;
};

}  // namespace demecal

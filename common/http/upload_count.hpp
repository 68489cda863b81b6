// How many uploads go on, and whether one more may.
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <string>
#include <utility>

namespace demecal::inline http {

/// Uploads that go on, of all and of each user.
class UploadCount {
 public:
  UploadCount(std::size_t most, std::size_t most_each) : most_(most), most_each_(most_each) {}

  /// The upload of a user for as long as this lives, where there is a place for it.
  class Upload {
   public:
    Upload(UploadCount& count, std::string user)
        : count_(count), user_(std::move(user)), has_place_(count.begin(user_)) {}
    ~Upload() {
      if (has_place_) count_.end(user_);
    }
    Upload(const Upload&) = delete;
    Upload& operator=(const Upload&) = delete;

    bool has_place() const { return has_place_; }

   private:
    UploadCount& count_;
    std::string user_;
    bool has_place_;
  };

 private:
  bool begin(const std::string& user) {
    const std::lock_guard lock(mutex_);
    if (all_ >= most_ || each_[user] >= most_each_) return false;
    ++all_;
    ++each_[user];
    return true;
  }
  void end(const std::string& user) {
    const std::lock_guard lock(mutex_);
    --all_;
    if (--each_[user] == 0) each_.erase(user);
  }

  const std::size_t most_, most_each_;
  std::mutex mutex_;
  std::size_t all_ = 0;
  std::map<std::string, std::size_t> each_;
};

}  // namespace demecal::inline http

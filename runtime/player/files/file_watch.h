// runtime/player/files/file_watch.h: tells when files change on the disk.
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace kinora {

class FileWatch {
  public:
    // `changed` is called from a thread of its own, once for what changes together.
    explicit FileWatch(std::function<void()> changed);
    ~FileWatch();
    FileWatch(const FileWatch&) = delete;

    // These files from now on. Their folders are watched, so that a file that is replaced by
    // another of its name counts as changed.
    void watch(const std::vector<std::string>& files);

  private:
    void run();

    std::function<void()> changed_;
    int inotify_ = -1;
    int end_[2] = {-1, -1};  // a pipe that ends the thread
    std::mutex mutex_;
    std::map<int, std::string> folders_;                   // by watch
    std::set<std::pair<std::string, std::string>> files_;  // folder, name
    std::thread thread_;
};

}  // namespace kinora

// runtime/player/files/file_watch.cpp: inotify on the folders of files.
#include "runtime/player/files/file_watch.h"

#include <poll.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>

namespace kinora {

namespace {

constexpr int kQuietMs = 60;  // an editor writes a file in several steps
constexpr uint32_t kEvents = IN_CLOSE_WRITE | IN_MOVED_TO | IN_CREATE | IN_DELETE | IN_MODIFY;

std::pair<std::string, std::string> folder_and_name(const std::string& file) {
    std::error_code ignored;
    std::filesystem::path path = std::filesystem::absolute(file, ignored).lexically_normal();
    return {path.parent_path().string(), path.filename().string()};
}

}  // namespace

FileWatch::FileWatch(std::function<void()> changed) : changed_(std::move(changed)) {
    inotify_ = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    if (inotify_ < 0 || pipe(end_) != 0) return;  // nothing is watched then
    thread_ = std::thread([this] { run(); });
}

FileWatch::~FileWatch() {
    if (thread_.joinable()) {
        char byte = 0;
        while (write(end_[1], &byte, 1) < 0 && errno == EINTR) {
        }
        thread_.join();
    }
    for (int descriptor : {inotify_, end_[0], end_[1]})
        if (descriptor >= 0) close(descriptor);
}

void FileWatch::watch(const std::vector<std::string>& files) {
    if (inotify_ < 0) return;
    std::lock_guard lock(mutex_);
    for (const auto& [number, folder] : folders_) inotify_rm_watch(inotify_, number);
    folders_.clear();
    files_.clear();
    for (const std::string& file : files) {
        auto entry = folder_and_name(file);
        int number = inotify_add_watch(inotify_, entry.first.c_str(), kEvents);
        if (number < 0) continue;
        folders_[number] = entry.first;
        files_.insert(entry);
    }
}

void FileWatch::run() {
    bool pending = false;
    while (true) {
        pollfd polled[2] = {{inotify_, POLLIN, 0}, {end_[0], POLLIN, 0}};
        int ready = poll(polled, 2, pending ? kQuietMs : -1);
        if (polled[1].revents != 0) return;
        if (ready == 0 && pending) {
            pending = false;
            changed_();
            continue;
        }
        alignas(inotify_event) char buffer[4096];
        ssize_t size = read(inotify_, buffer, sizeof buffer);
        std::lock_guard lock(mutex_);
        for (ssize_t at = 0; at < size;) {
            inotify_event event;
            std::memcpy(&event, buffer + at, sizeof event);
            auto folder = folders_.find(event.wd);
            if (event.len > 0 && folder != folders_.end())
                pending |= files_.count({folder->second, buffer + at + sizeof event}) > 0;
            at += ssize_t(sizeof event + event.len);
        }
    }
}

}  // namespace kinora

// runtime/programs/play/window/script_lines.cpp: bytes to lines.
#include "runtime/programs/play/window/script_lines.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>

namespace kinora::play {

ScriptLines::ScriptLines(const std::string& file, std::function<void()> wake)
    : wake_(std::move(wake)) {
    file_ = file == "-" ? dup(STDIN_FILENO) : open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (file_ < 0) {
        error_ = std::strerror(errno);
        return;
    }
    stop_ = eventfd(0, EFD_CLOEXEC);
    thread_ = std::thread([this] { read(); });
}

ScriptLines::~ScriptLines() {
    if (thread_.joinable()) {
        const uint64_t one = 1;
        [[maybe_unused]] const ssize_t told = write(stop_, &one, sizeof one);
        thread_.join();
    }
    if (stop_ >= 0) close(stop_);
    if (file_ >= 0) close(file_);
}

std::optional<std::string> ScriptLines::next() {
    std::lock_guard lock(mutex_);
    if (lines_.empty()) return std::nullopt;
    std::string line = std::move(lines_.front());
    lines_.pop_front();
    return line;
}

void ScriptLines::read() {
    char bytes[4096];
    pollfd wanted[2] = {{file_, POLLIN, 0}, {stop_, POLLIN, 0}};
    while (true) {
        if (poll(wanted, 2, -1) < 0 && errno == EINTR) continue;
        if (wanted[1].revents) return;
        const ssize_t count = ::read(file_, bytes, sizeof bytes);
        if (count < 0 && errno == EINTR) continue;
        take({bytes, count > 0 ? static_cast<size_t>(count) : 0}, count <= 0);
        if (count <= 0) return;
    }
}

void ScriptLines::take(std::string_view bytes, bool end) {
    {
        std::lock_guard lock(mutex_);
        for (const char c : bytes) {
            if (c != '\n')
                begun_ += c;
            else
                lines_.push_back(std::exchange(begun_, {}));
        }
        if (end && !begun_.empty()) lines_.push_back(std::exchange(begun_, {}));
    }
    wake_();
}

}  // namespace kinora::play

// runtime/programs/play/window/script_lines.h: lines of a script as they come, read by a thread of
// their own: a pipe may have the next one at any time.
#pragma once

#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace kinora::play {

class ScriptLines {
  public:
    // "-" is standard input. `wake` is called from the thread when there are lines.
    ScriptLines(const std::string& file, std::function<void()> wake);
    ~ScriptLines();
    ScriptLines(const ScriptLines&) = delete;

    // Why the file cannot be read; "" if it can.
    const std::string& error() const { return error_; }
    std::optional<std::string> next();

  private:
    void read();
    void take(std::string_view bytes, bool end);

    std::function<void()> wake_;
    std::string error_;
    int file_ = -1, stop_ = -1;  // descriptors
    std::mutex mutex_;
    std::deque<std::string> lines_;
    std::string begun_;  // of the thread: a line without its end
    std::thread thread_;
};

}  // namespace kinora::play

// runtime/programs/validate/output_file.cpp: temporary name, write, rename.
#include "runtime/programs/validate/output_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace kinora {

namespace {

constexpr size_t kBuffer = 1 << 16;

int write_all(int descriptor, std::string_view text) {
    while (!text.empty()) {
        ssize_t n = ::write(descriptor, text.data(), text.size());
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return errno;
        text.remove_prefix(size_t(n));
    }
    return 0;
}

bool is_device(const std::string& path) {
    struct stat status {};
    return ::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode);
}

}  // namespace

OutputFile::OutputFile(std::string path) : path_(std::move(path)) {
    if (path_.empty() || path_ == "-") {
        descriptor_ = STDOUT_FILENO;
        return;
    }
    if (is_device(path_)) {  // a pipe or /dev/null cannot be replaced
        device_.reset(std::fopen(path_.c_str(), "wbe"));
        error_ = device_ ? 0 : errno;
    } else {
        error_ = file_.open(path_);
    }
    if (!error_) descriptor_ = ::fileno(device_ ? device_.get() : file_.stream());
}

void OutputFile::write(std::string_view text) {
    if (error_) return;
    buffer_ += text;
    if (buffer_.size() >= kBuffer) flush();
}

void OutputFile::flush() {
    if (!error_) error_ = write_all(descriptor_, buffer_);
    buffer_.clear();
}

bool OutputFile::close() {
    flush();
    if (!error_ && file_.stream()) error_ = file_.commit();
    device_.reset();
    descriptor_ = -1;
    if (error_ == 0 || error_ == EPIPE) return true;
    std::fprintf(stderr, "kinora-validate: cannot write '%s': %s\n",
                 path_.empty() ? "stdout" : path_.c_str(), std::strerror(error_));
    return false;
}

std::string read_stdin() {
    std::string text;
    char buffer[kBuffer];
    for (;;) {
        ssize_t n = ::read(STDIN_FILENO, buffer, sizeof buffer);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return text;
        text.append(buffer, size_t(n));
    }
}

}  // namespace kinora

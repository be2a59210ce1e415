// runtime/programs/validate/output_file.cpp: temporary name, write, rename.
#include "runtime/programs/validate/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

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
    bool direct = is_device(path_);  // a pipe or /dev/null cannot be replaced
    temporary_ = direct ? "" : path_ + ".tmp" + std::to_string(::getpid());
    const std::string& name = direct ? path_ : temporary_;
    descriptor_ = ::open(name.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor_ < 0) {
        error_ = errno;
        temporary_.clear();
    }
}

OutputFile::~OutputFile() {
    if (descriptor_ > STDERR_FILENO) ::close(descriptor_);
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
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
    if (descriptor_ > STDERR_FILENO) {
        if (!error_ && !temporary_.empty() && ::fsync(descriptor_) != 0 && errno != EINVAL)
            error_ = errno;
        if (::close(descriptor_) != 0 && !error_) error_ = errno;
        descriptor_ = -1;
    }
    if (!error_ && !temporary_.empty()) {
        if (::rename(temporary_.c_str(), path_.c_str()) != 0)
            error_ = errno;
        else
            temporary_.clear();
    }
    if (error_ == 0 || error_ == EPIPE) return true;
    std::fprintf(stderr, "kinora-validate: cannot write '%s': %s\n",
                 path_.empty() ? "stdout" : path_.c_str(), std::strerror(error_));
    return false;
}

int replace_file(const std::string& name, std::string_view text) {
    // Not the link to a file, but the file.
    std::unique_ptr<char, decltype(&std::free)> real(::realpath(name.c_str(), nullptr), std::free);
    if (!real) return errno;
    std::string path = real.get();
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) return errno;
    if (::access(path.c_str(), W_OK) != 0) return errno;
    std::string temporary = path + ".tmp" + std::to_string(::getpid());
    int descriptor =
        ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, status.st_mode & 07777);
    if (descriptor < 0) return errno;
    int error = write_all(descriptor, text);
    if (!error && ::fchmod(descriptor, status.st_mode & 07777) != 0) error = errno;
    if (!error && ::fsync(descriptor) != 0) error = errno;
    if (::close(descriptor) != 0 && !error) error = errno;
    if (!error && ::rename(temporary.c_str(), path.c_str()) != 0) error = errno;
    if (error) ::unlink(temporary.c_str());
    return error;
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

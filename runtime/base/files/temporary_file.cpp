// runtime/base/files/temporary_file.cpp: names that no other process takes, and who removes the
// files.
#include "runtime/base/files/temporary_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <climits>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace kinora {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMark = "kinora", kEnding = "tmp";
constexpr size_t kMostHost = 24, kBootDigits = 8, kRandomDigits = 16;
constexpr size_t kMostName = 255;  // NAME_MAX of Linux' file systems
constexpr std::string_view kHexDigits = "0123456789abcdef";
constexpr auto kOld = std::chrono::hours(24);

std::string host_name() {
    utsname system{};
    std::string host = uname(&system) == 0 ? system.nodename : "";
    host.resize(std::min(host.size(), kMostHost));
    for (char& c : host)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '-';
    return host.empty() ? "host" : host;
}

// Two machines may have one name, not one boot.
std::string boot_id() {
    std::string id;
    std::ifstream("/proc/sys/kernel/random/boot_id") >> id;
    id.resize(kBootDigits, '0');
    return id;
}

uint64_t random_number() {
    uint64_t number = 0;
    if (getrandom(&number, sizeof number, 0) == sizeof number) return number;
    static std::atomic<uint64_t> count{0};
    const auto now = std::chrono::steady_clock::now().time_since_epoch().count();
    return uint64_t(now) * 0x9e3779b97f4a7c15u + ++count;
}

// At most so many bytes, and no part of a character.
std::string cut_name(std::string name, size_t most) {
    if (name.size() <= most) return name;
    while (most > 0 && (uint8_t(name[most]) & 0xc0) == 0x80) --most;
    name.resize(most);
    return name;
}

// Takes the last part of a name that dots divide.
std::string_view take_last(std::string_view& name) {
    const size_t dot = name.rfind('.');
    if (dot == std::string_view::npos) return {};
    std::string_view last = name.substr(dot + 1);
    name = name.substr(0, dot);
    return last;
}

bool consists_of(std::string_view text, std::string_view letters, size_t size) {
    return text.size() == size && text.find_first_not_of(letters) == std::string_view::npos;
}

// The names of open files, in memory that stays: a handler of signals reads them.
struct OpenName {
    std::atomic<int> state{0};  // 0: free, 1: taken, 2: a name
    char name[PATH_MAX];
};
std::array<OpenName, 16> g_open_names;

int remember_open(const std::string& name) {
    if (name.size() >= PATH_MAX) return -1;
    for (size_t i = 0; i < g_open_names.size(); ++i) {
        int free = 0;
        if (!g_open_names[i].state.compare_exchange_strong(free, 1)) continue;
        std::memcpy(g_open_names[i].name, name.c_str(), name.size() + 1);
        g_open_names[i].state = 2;
        return int(i);
    }
    return -1;
}

void forget_open(int& slot) {
    if (slot >= 0) g_open_names[size_t(slot)].state = 0;
    slot = -1;
}

}  // namespace

std::string temporary_name(const std::string& path) {
    static const std::string host = host_name(), boot = boot_id();
    const fs::path target(path);
    const std::string ending = fmt::format(".{}.{}.{}.{}.{:016x}.{}", kMark, host, boot, getpid(),
                                           random_number(), kEnding);
    return (target.parent_path() /
            ("." + cut_name(target.filename().string(), kMostName - 1 - ending.size()) + ending))
        .string();
}

bool is_temporary_name(std::string_view name) {
    if (!name.starts_with('.') || take_last(name) != kEnding) return false;
    if (!consists_of(take_last(name), kHexDigits, kRandomDigits)) return false;
    const std::string_view pid = take_last(name), boot = take_last(name), host = take_last(name);
    return !pid.empty() && consists_of(pid, kHexDigits.substr(0, 10), pid.size()) &&
           consists_of(boot, kHexDigits, kBootDigits) && !host.empty() && take_last(name) == kMark;
}

int TemporaryFile::open(const std::string& path, mode_t mode) {
    drop();
    path_ = path;
    int descriptor = -1;
    for (int tries = 0; descriptor < 0 && tries < 8; ++tries) {
        name_ = temporary_name(path);
        descriptor = ::open(name_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode);
        if (descriptor < 0 && errno != EEXIST) break;
    }
    const int number = errno;
    if (descriptor >= 0) {
        slot_ = remember_open(name_);
        file_.reset(fdopen(descriptor, "w+b"));
        if (file_) return 0;
        close(descriptor);
        drop();
    }
    name_.clear();
    return number ? number : EIO;
}

int TemporaryFile::sync() {
    bool good = !std::ferror(file_.get()) && std::fflush(file_.get()) == 0 &&
                fsync(fileno(file_.get())) == 0;
    int number = errno;
    // Network file systems may say here alone that there is no more room.
    if (std::fclose(file_.release()) != 0 && good) {
        good = false;
        number = errno;
    }
    if (good) return 0;
    return number ? number : EIO;
}

int TemporaryFile::commit() {
    int number = sync();
    if (number == 0 && std::rename(name_.c_str(), path_.c_str()) != 0) number = errno;
    if (number == 0) {
        name_.clear();
        forget_open(slot_);
    }
    drop();
    return number;
}

void TemporaryFile::drop() {
    file_.reset();
    if (!name_.empty()) unlink(name_.c_str());
    name_.clear();
    forget_open(slot_);
}

void remove_old_temporaries(const std::string& path) {
    const fs::path folder = fs::path(path).parent_path();
    std::error_code code;
    for (fs::directory_iterator at(folder.empty() ? "." : folder, code), end; !code && at != end;
         at.increment(code)) {
        std::error_code ignored;
        if (!is_temporary_name(at->path().filename().string())) continue;
        if (!fs::is_regular_file(at->symlink_status(ignored))) continue;
        const auto age =
            fs::file_time_type::clock::now() - fs::last_write_time(at->path(), ignored);
        if (!ignored && age > kOld) fs::remove(at->path(), ignored);
    }
}

void unlink_temporaries() noexcept {
    for (const OpenName& open : g_open_names)
        if (open.state == 2) unlink(open.name);
}

int write_whole_file(const std::string& path, std::string_view bytes, mode_t mode) {
    TemporaryFile file;
    if (int number = file.open(path, mode)) return number;
    std::fwrite(bytes.data(), 1, bytes.size(), file.stream());  // commit() sees what failed
    return file.commit();
}

int replace_file(const std::string& path, std::string_view bytes) {
    std::unique_ptr<char, decltype(&std::free)> real(realpath(path.c_str(), nullptr), std::free);
    struct stat status {};
    if (!real || stat(real.get(), &status) != 0 || access(real.get(), W_OK) != 0) return errno;
    const mode_t mode = status.st_mode & 07777;
    TemporaryFile file;
    if (int number = file.open(real.get(), mode)) return number;
    if (fchmod(fileno(file.stream()), mode) != 0) return errno;
    std::fwrite(bytes.data(), 1, bytes.size(), file.stream());
    return file.commit();
}

int make_folder_of(const std::string& path) {
    const fs::path folder = fs::path(path).parent_path();
    std::error_code code;
    if (!folder.empty()) fs::create_directories(folder, code);
    return code.value();
}

}  // namespace kinora

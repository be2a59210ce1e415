// collada/document/archive.cpp: members of a zip become files of a private folder, or are refused.
#include "collada/document/archive.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <mutex>

#include "collada/document/findings.h"
#include "collada/document/libzip_p.h"
#include "runtime/base/display_path.h"
#include "runtime/base/regular_file.h"

namespace kinora::collada {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kFolderPrefix = "kinora-archive-";
constexpr auto kStaleAge = std::chrono::minutes(10);  // younger ones may not be locked yet

// Removes what killed processes left: folders of ours that are old and that nobody holds.
void remove_stale(const fs::path& parent) {
    std::error_code error;
    fs::directory_iterator at(parent, error), end;
    for (size_t seen = 0; !error && at != end && seen < 10'000; at.increment(error), ++seen) {
        const fs::path& path = at->path();
        if (!path.filename().string().starts_with(kFolderPrefix)) continue;
        struct stat status {};
        if (lstat(path.c_str(), &status) != 0 || !S_ISDIR(status.st_mode)) continue;
        if (status.st_uid != geteuid()) continue;
        std::error_code ignored;
        auto age = fs::file_time_type::clock::now() - fs::last_write_time(path, ignored);
        if (ignored || age < kStaleAge) continue;
        int lock = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC | O_NOFOLLOW);
        if (lock < 0) continue;
        if (flock(lock, LOCK_EX | LOCK_NB) == 0) fs::remove_all(path, ignored);
        close(lock);
    }
}

}  // namespace

std::shared_ptr<const PrivateFolder> PrivateFolder::make(std::string& error) {
    std::error_code code;
    fs::path parent = fs::temp_directory_path(code);
    if (!code) parent = fs::canonical(parent, code);
    if (code) {
        error = "no folder for temporary files: " + code.message();
        return nullptr;
    }
    static std::once_flag cleaned;
    std::call_once(cleaned, [&] { remove_stale(parent); });
    std::string path = (parent / kFolderPrefix).string() + "XXXXXX";
    if (!mkdtemp(path.data())) {
        error =
            fmt::format("cannot make a folder in '{}': {}", parent.string(), std::strerror(errno));
        return nullptr;
    }
    int lock = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (lock >= 0) flock(lock, LOCK_EX | LOCK_NB);
    return std::shared_ptr<const PrivateFolder>(new PrivateFolder(std::move(path), lock));
}

PrivateFolder::~PrivateFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    if (lock_ >= 0) close(lock_);
}

bool is_archive_bytes(std::string_view bytes) {
    return bytes.starts_with(std::string_view("PK\3\4", 4)) ||
           bytes.starts_with(std::string_view("PK\5\6", 4));
}

bool is_archive(const std::string& path) {
    std::array<char, 4> head{};
    OpenFile file = open_regular_file(path);
    return file && std::fread(head.data(), 1, head.size(), file.get()) == head.size() &&
           is_archive_bytes({head.data(), head.size()});
}

namespace {

constexpr size_t kDeepest = 64, kLongest = 1000;  // of a member's path

// The path below the folder that a member's name means; "" and `why` when it may have none.
std::string safe_path(std::string_view name, std::string& why) {
    std::string path;
    size_t depth = 0;
    why.clear();
    if (name.find('\0') != name.npos) why = "its name holds a NUL";
    if (name.starts_with('/') || name.starts_with('\\')) why = "its path is absolute";
    if (name.size() > 1 && name[1] == ':') why = "its path is absolute";
    if (name.size() > kLongest) why = "its path is too long";
    if (!why.empty()) return {};
    for (size_t at = 0; at <= name.size();) {
        size_t end = std::min(name.find_first_of("/\\", at), name.size());
        std::string_view part = name.substr(at, end - at);
        at = end + 1;
        if (part.empty() || part == ".") continue;
        if (part == "..") {
            why = "its path leaves the archive";
            return {};
        }
        if (++depth > kDeepest) {
            why = "its path is too deep";
            return {};
        }
        path += (path.empty() ? "" : "/") + std::string(part);
    }
    if (path.empty()) why = "it has no name";
    return path;
}

class Unpacking {
  public:
    Unpacking(const std::string& path, const ArchiveLimits& limits, Diagnostics& diag)
        : path_(path), limits_(limits), diag_(diag) {}
    ~Unpacking() {
        if (zip_) zip().zip_discard(zip_);
    }

    std::optional<Archive> run(zip_source_t* source, zip_error_t& error);

  private:
    bool fail(const FindingInfo& code, const std::string& what) {
        diag_.report(code, Location{}, path_, what);
        return false;
    }
    bool unpack(zip_uint64_t index);
    bool copy(zip_file_t* from, const std::string& name, const std::string& to);
    bool is_link(zip_uint64_t index) const;

    const std::string& path_;
    const ArchiveLimits& limits_;
    Diagnostics& diag_;
    zip_t* zip_ = nullptr;
    uint64_t archive_bytes_ = 0, unpacked_ = 0;
    Archive archive_;
};

bool Unpacking::is_link(zip_uint64_t index) const {
    zip_uint8_t system = 0;
    zip_uint32_t attributes = 0;
    if (zip().zip_file_get_external_attributes(zip_, index, 0, &system, &attributes) != 0)
        return false;
    mode_t mode = mode_t(attributes >> 16);
    return system == ZIP_OPSYS_UNIX && (mode & S_IFMT) != 0 && !S_ISREG(mode) && !S_ISDIR(mode);
}

// False only where the whole archive is refused.
bool Unpacking::copy(zip_file_t* from, const std::string& name, const std::string& to) {
    int out = open(to.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600);
    if (out < 0) {
        diag_.report(Code::ARCHIVE_MEMBER, Location{}, name,
                     errno == EEXIST ? std::string("another member has its name")
                                     : std::string(std::strerror(errno)));
        return true;
    }
    std::array<char, 1 << 16> buffer;
    std::string refused, left_out;
    for (;;) {
        zip_int64_t got = zip().zip_fread(from, buffer.data(), buffer.size());
        if (got < 0) left_out = zip().zip_file_strerror(from);
        if (got <= 0) break;
        unpacked_ += uint64_t(got);
        if (unpacked_ > limits_.unpacked_bytes)
            refused = fmt::format("it unpacks to more than {} bytes", limits_.unpacked_bytes);
        if (unpacked_ > limits_.free_bytes && unpacked_ / limits_.ratio > archive_bytes_)
            refused = fmt::format("it unpacks to more than {} times its size", limits_.ratio);
        if (!refused.empty()) break;
        if (write(out, buffer.data(), size_t(got)) != got) {
            refused = std::strerror(errno);
            break;
        }
    }
    close(out);
    if (!refused.empty()) return fail(Code::ARCHIVE_LIMIT, refused);
    if (!left_out.empty()) {
        unlink(to.c_str());  // half a member would be read as if it were whole
        diag_.report(Code::ARCHIVE_MEMBER, Location{}, name, left_out);
    }
    return true;
}

bool Unpacking::unpack(zip_uint64_t index) {
    zip_stat_t stat;
    zip().zip_stat_init(&stat);
    if (zip().zip_stat_index(zip_, index, 0, &stat) != 0 || !stat.name) {
        diag_.report(Code::ARCHIVE_MEMBER, Location{}, fmt::format("{}!{}", path_, index),
                     std::string(zip().zip_strerror(zip_)));
        return true;
    }
    std::string_view raw = stat.name;
    std::string name = path_ + "!" + std::string(raw), why;
    std::string path = safe_path(raw, why);
    if (why.empty() && is_link(index)) why = "it is a link";
    if (why.empty() && (stat.valid & ZIP_STAT_ENCRYPTION_METHOD) &&
        stat.encryption_method != ZIP_EM_NONE)
        why = "it is encrypted";
    bool folder = raw.ends_with('/') || raw.ends_with('\\');
    std::string to = archive_.folder->path() + "/" + path;
    std::error_code error;
    if (why.empty()) {
        fs::create_directories(folder ? to : fs::path(to).parent_path().string(), error);
        if (error) why = error.message();
    }
    if (!why.empty()) {
        diag_.report(Code::ARCHIVE_MEMBER, Location{}, name, why);
        return true;
    }
    if (folder) return true;
    zip_file_t* from = zip().zip_fopen_index(zip_, index, 0);
    if (!from) {
        diag_.report(Code::ARCHIVE_MEMBER, Location{}, name, std::string(zip().zip_strerror(zip_)));
        return true;
    }
    bool go_on = copy(from, name, to);
    zip().zip_fclose(from);
    if (!go_on || !fs::exists(to, error)) return go_on;
    if (stat.valid & ZIP_STAT_MTIME) {  // so that a picture's fingerprint is the archive's own
        timespec times[2] = {{stat.mtime, 0}, {stat.mtime, 0}};
        utimensat(AT_FDCWD, to.c_str(), times, AT_SYMLINK_NOFOLLOW);
    }
    archive_.members.push_back(std::move(path));
    return true;
}

std::optional<Archive> Unpacking::run(zip_source_t* source, zip_error_t& error) {
    if (source) zip_ = zip().zip_open_from_source(source, ZIP_RDONLY, &error);
    if (!zip_) {
        fail(Code::ARCHIVE_OPEN, zip().zip_error_strerror(&error));
        if (source) zip().zip_source_free(source);
        return std::nullopt;
    }
    zip_stat_t stat;
    zip().zip_stat_init(&stat);
    if (zip().zip_source_stat(source, &stat) == 0 && (stat.valid & ZIP_STAT_SIZE))
        archive_bytes_ = stat.size;
    zip_uint64_t count = zip_uint64_t(std::max<zip_int64_t>(zip().zip_get_num_entries(zip_, 0), 0));
    if (count > limits_.members) {
        fail(Code::ARCHIVE_LIMIT,
             fmt::format("it has {} members, the limit is {}", count, limits_.members));
        return std::nullopt;
    }
    std::string why;
    archive_.folder = PrivateFolder::make(why);
    if (!archive_.folder) {
        fail(Code::ARCHIVE_OPEN, why);
        return std::nullopt;
    }
    show_folder_as(archive_.folder->path(), path_ + "!");
    for (zip_uint64_t i = 0; i < count; ++i)
        if (!unpack(i)) return std::nullopt;
    return std::move(archive_);
}

// Unpacks the archive that `open_source` opens.
template <class OpenSource>
std::optional<Archive> unpack_source(const std::string& path, const ArchiveLimits& limits,
                                     Diagnostics& diag, OpenSource&& open_source) {
    if (!zip().error().empty()) {
        diag.report(Code::ARCHIVE_OPEN, Location{}, path, zip().error());
        return std::nullopt;
    }
    zip_error_t error;
    zip().zip_error_init(&error);
    auto archive = Unpacking(path, limits, diag).run(open_source(error), error);
    zip().zip_error_fini(&error);
    return archive;
}

}  // namespace

std::optional<Archive> unpack_archive(const std::string& path, const ArchiveLimits& limits,
                                      Diagnostics& diag) {
    return unpack_source(path, limits, diag, [&](zip_error_t& error) {
        return zip().zip_source_file_create(path.c_str(), 0, -1, &error);
    });
}

std::optional<Archive> unpack_archive_bytes(const std::string& path, std::string_view bytes,
                                            const ArchiveLimits& limits, Diagnostics& diag) {
    return unpack_source(path, limits, diag, [&](zip_error_t& error) {
        return zip().zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
    });
}

}  // namespace kinora::collada

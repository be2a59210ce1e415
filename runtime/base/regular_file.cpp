// runtime/base/regular_file.cpp: opened without waiting, then asked what they are.
#include "runtime/base/regular_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

namespace kinora {

bool is_regular_file(const std::string& path) {
    std::error_code error;
    return std::filesystem::is_regular_file(path, error);
}

OpenFile open_regular_file(const std::string& path, uint64_t& size, std::string* error) {
    auto fail = [&](const char* why) {
        if (error) *error = why;
        return OpenFile();
    };
    // O_NONBLOCK: a pipe without a writer opens at once.
    int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (descriptor < 0) return fail(errno == ENOENT ? "no such file" : std::strerror(errno));
    struct stat status {};
    bool known = ::fstat(descriptor, &status) == 0;
    if (!known || !S_ISREG(status.st_mode)) {
        ::close(descriptor);
        return fail(known && S_ISDIR(status.st_mode) ? "it is a folder, not a file"
                                                     : "it is no regular file");
    }
    size = uint64_t(status.st_size);
    OpenFile file(::fdopen(descriptor, "rb"));
    if (file) return file;
    ::close(descriptor);
    return fail("not enough memory");
}

OpenFile open_regular_file(const std::string& path, std::string* error) {
    uint64_t size = 0;
    return open_regular_file(path, size, error);
}

std::optional<std::string> read_regular_file(const std::string& path, uint64_t most,
                                             std::string* error) {
    auto fail = [&](const char* why) {
        if (error) *error = why;
        return std::nullopt;
    };
    uint64_t size = 0;
    OpenFile file = open_regular_file(path, size, error);
    if (!file) return std::nullopt;
    if (size > most) return fail("it is too large");
    std::string bytes(size_t(size), '\0');
    bytes.resize(std::fread(bytes.data(), 1, bytes.size(), file.get()));
    if (std::ferror(file.get())) return fail("it cannot be read to its end");
    return bytes;
}

namespace {

struct Magic {
    std::string_view bytes;
    const char* what;
};

constexpr Magic kDisguises[] = {
    {"version https://git-lfs", "it is a Git LFS pointer; run 'git lfs pull'"},
    {"\x1f\x8b", "it is a gzip file"},
    {"PK\x03\x04", "it is a zip archive (.zae or .kmz); unpack it"},
    {"BZh", "it is a bzip2 file"},
    {"\xfd"
     "7zXZ",
     "it is an xz file"},
    {"Kaydara FBX", "it is an FBX file"},
    {"BLENDER", "it is a Blender file"},
};

}  // namespace

const char* disguise_of(std::string_view first_bytes) {
    for (const Magic& magic : kDisguises)
        if (first_bytes.starts_with(magic.bytes)) return magic.what;
    return nullptr;
}

}  // namespace kinora

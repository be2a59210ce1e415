// runtime/scene/images/point_file.cpp: reads and writes point files.
#include "runtime/scene/images/point_file.h"

#include <fmt/format.h>

#include <bit>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "runtime/base/files/temporary_file.h"
#include "runtime/base/regular_file.h"

namespace kinora {

static_assert(std::endian::native == std::endian::little);

namespace {

constexpr char kMagic[] = "KNPOINT1";
constexpr size_t kMagicBytes = 8;
constexpr uint32_t kMostChannels = 256, kLongestName = 256;

using File = OpenFile;

template <class T>
bool get(std::FILE* f, T& value) {
    return std::fread(&value, sizeof value, 1, f) == 1;
}
template <class T>
bool put(std::FILE* f, const T& value) {
    return std::fwrite(&value, sizeof value, 1, f) == 1;
}

std::string broken(const char* why) {
    return fmt::format("the file is broken: {}", why);
}

std::string read_head(std::FILE* f, PointFile& out, uint64_t& count) {
    char magic[kMagicBytes];
    uint32_t channels = 0;
    if (std::fread(magic, 1, kMagicBytes, f) != kMagicBytes ||
        std::memcmp(magic, kMagic, kMagicBytes) != 0)
        return "it is no Kinora point file";
    if (!get(f, channels) || !get(f, count)) return broken("it ends in its head");
    if (channels > kMostChannels) return broken("too many channels");
    for (uint32_t c = 0; c < channels; ++c) {
        uint32_t type = 0, length = 0;
        if (!get(f, type) || !get(f, length)) return broken("it ends in its head");
        if (type > 127 || point_components(char(type)) == 0) return broken("an unknown type");
        if (length > kLongestName) return broken("a channel's name is too long");
        std::string name(length, '\0');
        if (std::fread(name.data(), 1, length, f) != length) return broken("it ends in its head");
        if (out.channel(name, char(type)) != c) return broken("a channel is there twice");
    }
    return "";
}

}  // namespace

int point_components(char type) {
    switch (type) {
        case 'f':
            return 1;
        case 'c':
        case 'p':
        case 'v':
        case 'n':
            return 3;
        case 'm':
            return 16;
        default:
            return 0;
    }
}

size_t PointFile::channel(std::string_view name, char type) {
    for (size_t c = 0; c < channels.size(); ++c)
        if (channels[c].name == name && channels[c].type == type) return c;
    channels.push_back({std::string(name), type, stride});
    stride += point_components(type);
    return channels.size() - 1;
}

std::string read_point_file(const std::string& path, PointFile& out) {
    out = {};
    std::string refused;
    File f = open_regular_file(path, &refused);
    if (!f) return refused;
    uint64_t count = 0;
    if (std::string error = read_head(f.get(), out, count); !error.empty()) return error;
    long begin = std::ftell(f.get());
    std::fseek(f.get(), 0, SEEK_END);
    long end = std::ftell(f.get());
    std::fseek(f.get(), begin, SEEK_SET);
    uint64_t bytes = uint64_t(out.stride) * sizeof(float);
    if (begin < 0 || end < begin || count > uint64_t(end) || count * bytes != uint64_t(end - begin))
        return broken("its length does not fit its number of points");
    out.points.resize(size_t(count) * size_t(out.stride));
    if (std::fread(out.points.data(), sizeof(float), out.points.size(), f.get()) !=
        out.points.size())
        return broken("it cannot be read to its end");
    return "";
}

// A scene must not be able to destroy what is not its own.
static bool may_replace(const std::string& path) {
    std::error_code error;
    if (!std::filesystem::exists(path, error)) return true;
    File f = open_regular_file(path);
    char magic[kMagicBytes];
    size_t got = f ? std::fread(magic, 1, kMagicBytes, f.get()) : 0;
    return (f && got == 0) || (got == kMagicBytes && std::memcmp(magic, kMagic, kMagicBytes) == 0);
}

std::string write_point_file(const std::string& path, const PointFile& file) {
    if (!may_replace(path)) return "another file has that name, and it is no point file";
    TemporaryFile beside;
    if (int number = beside.open(path)) return std::strerror(number);
    std::FILE* f = beside.stream();
    bool ok = std::fwrite(kMagic, 1, kMagicBytes, f) == kMagicBytes;
    ok = ok && put(f, uint32_t(file.channels.size())) && put(f, uint64_t(file.count()));
    for (const PointChannel& c : file.channels) {
        ok = ok && put(f, uint32_t(c.type)) && put(f, uint32_t(c.name.size()));
        ok = ok && std::fwrite(c.name.data(), 1, c.name.size(), f) == c.name.size();
    }
    ok = ok && std::fwrite(file.points.data(), sizeof(float), file.points.size(), f) ==
                   file.points.size();
    const int number = ok ? beside.commit() : errno;
    return ok && number == 0 ? "" : std::strerror(number);
}

}  // namespace kinora

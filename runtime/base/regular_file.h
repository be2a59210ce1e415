// runtime/base/regular_file.h: files that scenes name. Only regular ones are opened: a pipe would
// wait for its writer for ever, and opening a device may do things.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace kinora {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using OpenFile = std::unique_ptr<std::FILE, CloseFile>;

// Whether there is one, links followed; no error but "no".
bool is_regular_file(const std::string& path);

// The file, open for reading. Null with why in `error` where it cannot be read or is not regular,
// which is found out on the open file: nobody can exchange it in between.
OpenFile open_regular_file(const std::string& path, std::string* error = nullptr);

// The same with its size in bytes.
OpenFile open_regular_file(const std::string& path, uint64_t& size, std::string* error = nullptr);

// All of it; nothing where it has more than `most` bytes.
std::optional<std::string> read_regular_file(const std::string& path, uint64_t most = UINT64_MAX,
                                             std::string* error = nullptr);

// "it is a Git LFS pointer; ...": what the first bytes of a file say that it is instead of text, a
// model or a picture, whatever its name; null where they say nothing of the kind.
const char* disguise_of(std::string_view first_bytes);

}  // namespace kinora

// runtime/base/files/content_hash.cpp: xxHash, by its header alone.
#include "runtime/base/files/content_hash.h"

#include <fmt/format.h>
#include <sys/stat.h>
#define XXH_INLINE_ALL  // a few calls are not worth a library at each start
#include <xxhash.h>

#include <vector>

#include "runtime/base/regular_file.h"

namespace kinora {

struct ContentHash::State {
    XXH3_state_t xxh;
};

ContentHash::ContentHash() : state_(std::make_unique<State>()) {
    XXH3_64bits_reset(&state_->xxh);
}

ContentHash::~ContentHash() = default;

void ContentHash::add(const void* bytes, size_t count) {
    XXH3_64bits_update(&state_->xxh, bytes, count);
}

void ContentHash::add_text(std::string_view text) {
    const uint64_t size = text.size();
    add(&size, sizeof size);
    add(text.data(), text.size());
}

uint64_t ContentHash::value() const {
    return XXH3_64bits_digest(&state_->xxh);
}

std::string ContentHash::digits() const {
    return fmt::format("{:016x}", value());
}

namespace {

std::optional<uint64_t> hash_of_file(std::FILE* file) {
    constexpr size_t kPiece = 1 << 20;
    ContentHash hash;
    std::vector<char> piece(kPiece);
    while (size_t got = std::fread(piece.data(), 1, piece.size(), file))
        hash.add(piece.data(), got);
    if (std::ferror(file)) return std::nullopt;
    return hash.value();
}

}  // namespace

std::optional<uint64_t> FileHashes::of(const std::string& path) {
    OpenFile file = open_regular_file(path);
    struct stat status {};
    if (!file || fstat(fileno(file.get()), &status) != 0) return std::nullopt;
    const Identity identity(status.st_dev, status.st_ino, status.st_size, status.st_mtim.tv_sec,
                            status.st_mtim.tv_nsec);
    auto [known, fresh] = known_.try_emplace(identity);
    if (fresh) known->second = hash_of_file(file.get());
    return known->second;
}

}  // namespace kinora

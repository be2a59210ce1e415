// runtime/base/files/content_hash.h: 64 bits that stand for bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>

namespace kinora {

// XXH3 of bytes that come in pieces; how they are cut changes nothing.
class ContentHash {
  public:
    ContentHash();
    ~ContentHash();
    ContentHash(const ContentHash&) = delete;
    ContentHash& operator=(const ContentHash&) = delete;

    void add(const void* bytes, size_t count);
    // The length first, so that two texts are not the same as one.
    void add_text(std::string_view text);
    uint64_t value() const;
    // 16 hexadecimal digits.
    std::string digits() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

// Hashes of files. What has the same inode, size and time of change is read once, whatever its
// names.
class FileHashes {
  public:
    // Nothing where it is no regular file or cannot be read to its end.
    std::optional<uint64_t> of(const std::string& path);

  private:
    using Identity = std::tuple<uint64_t, uint64_t, uint64_t, int64_t, int64_t>;
    std::map<Identity, std::optional<uint64_t>> known_;
};

}  // namespace kinora

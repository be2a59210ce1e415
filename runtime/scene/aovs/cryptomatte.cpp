// runtime/scene/aovs/cryptomatte.cpp: hashes of names.
#include "runtime/scene/aovs/cryptomatte.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <nlohmann/json.hpp>

namespace kinora {

namespace {

uint32_t scrambled(uint32_t block) {
    return std::rotl(block * 0xcc9e2d51u, 15) * 0x1b873593u;
}

}  // namespace

uint32_t murmur_hash_3(std::string_view text) {
    uint32_t hash = 0;
    const size_t blocks = text.size() / 4;
    for (size_t i = 0; i < blocks; ++i) {
        uint32_t block;  // of a machine whose first byte is the lowest
        std::memcpy(&block, text.data() + 4 * i, sizeof block);
        hash = std::rotl(hash ^ scrambled(block), 13) * 5 + 0xe6546b64u;
    }
    uint32_t tail = 0;
    for (size_t i = text.size(); i > 4 * blocks; --i) tail = tail << 8 | uint8_t(text[i - 1]);
    hash ^= scrambled(tail);
    hash ^= uint32_t(text.size());
    hash = (hash ^ hash >> 16) * 0x85ebca6bu;
    hash = (hash ^ hash >> 13) * 0xc2b2ae35u;
    return hash ^ hash >> 16;
}

float crypto_id(std::string_view name) {
    const uint32_t hash = murmur_hash_3(name), exponent = hash >> 23 & 255;
    return std::bit_cast<float>(exponent == 0 || exponent == 255 ? hash ^ 1u << 23 : hash);
}

std::vector<std::pair<std::string, std::string>> crypto_texts(std::string_view layer,
                                                              std::span<const std::string> names) {
    using Json = nlohmann::ordered_json;
    Json manifest = Json::object();
    for (const std::string& name : names)
        manifest[name] = fmt::format("{:08x}", std::bit_cast<uint32_t>(crypto_id(name)));
    const std::string key =
        "cryptomatte/" + fmt::format("{:08x}", murmur_hash_3(layer)).substr(0, 7) + "/";
    return {{key + "name", std::string(layer)},
            {key + "hash", "MurmurHash3_32"},
            {key + "conversion", "uint32_to_float32"},
            {key + "manifest", manifest.dump(-1, ' ', false, Json::error_handler_t::replace)}};
}

}  // namespace kinora

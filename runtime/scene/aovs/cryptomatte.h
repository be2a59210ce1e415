// runtime/scene/aovs/cryptomatte.h: numbers of names, as Psyop's Cryptomatte specification 1.2.0
// has them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace kinora {

// A. Appleby's MurmurHash3_x86_32, seed 0.
uint32_t murmur_hash_3(std::string_view text);

// The number that stands for a name in a picture. Its bits are the hash, but for those of floats
// that are not normal, where one bit of the exponent is turned.
float crypto_id(std::string_view name);

// The header's texts of a layer: its name, and the names in it behind their numbers. The manifest
// is JSON.
std::vector<std::pair<std::string, std::string>> crypto_texts(std::string_view layer,
                                                              std::span<const std::string> names);

}  // namespace kinora

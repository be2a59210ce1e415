// runtime/scene/gltf/document/glb.cpp: the chunks of a .glb.
#include "runtime/scene/gltf/document/glb.h"

#include <cstdint>

namespace kinora {

namespace {

void append_word(std::string& bytes, uint32_t word) {
    for (int i = 0; i < 4; ++i) bytes += char(word >> (8 * i) & 0xff);
}

uint32_t read_word(const std::string& bytes, size_t at) {
    uint32_t word = 0;
    for (size_t i = 0; i < 4; ++i) word |= uint32_t(uint8_t(bytes[at + i])) << (8 * i);
    return word;
}

constexpr uint32_t kMagic = 0x46546c67, kJsonChunk = 0x4e4f534a, kBinChunk = 0x004e4942;

}  // namespace

std::string join_glb(const GlbParts& parts) {
    std::string text = parts.json, bin = parts.buffer;
    text.resize((text.size() + 3) / 4 * 4, ' ');
    bin.resize((bin.size() + 3) / 4 * 4, '\0');
    std::string out;
    size_t size = 12 + 8 + text.size() + (bin.empty() ? 0 : 8 + bin.size());
    for (uint32_t word : {kMagic, 2u, uint32_t(size), uint32_t(text.size()), kJsonChunk})
        append_word(out, word);
    out += text;
    if (!bin.empty()) {
        append_word(out, uint32_t(bin.size()));
        append_word(out, kBinChunk);
        out += bin;
    }
    return out;
}

GlbParts split_glb(const std::string& glb) {
    GlbParts parts;
    if (glb.size() < 20) return parts;
    size_t length = read_word(glb, 12);
    parts.json = glb.substr(20, length);
    if (glb.size() >= 28 + length) parts.buffer = glb.substr(28 + length);
    return parts;
}

}  // namespace kinora

// rsl/syntax/ast.cpp: memory of the nodes, and names.
#include "rsl/syntax/ast.h"

#include <cstring>

namespace kinora::rsl {

namespace {
constexpr size_t kFirstBlock = 32 * 1024;
constexpr size_t kLargestBlock = 1024 * 1024;
}  // namespace

NodeArena::NodeArena() = default;
NodeArena::~NodeArena() = default;

void* NodeArena::allocate(size_t bytes, size_t alignment) {
    size_t begin = (used_ + alignment - 1) & ~(alignment - 1);
    if (blocks_.empty() || begin + bytes > size_) {
        size_ = std::max(bytes, std::min(kLargestBlock, blocks_.empty() ? kFirstBlock : size_ * 2));
        blocks_.push_back(std::make_unique_for_overwrite<std::byte[]>(size_));
        begin = 0;
    }
    used_ = begin + bytes;
    return blocks_.back().get() + begin;
}

std::string_view NodeArena::copy(std::string_view text) {
    if (text.empty()) return {};
    char* data = static_cast<char*>(allocate(text.size(), 1));
    std::memcpy(data, text.data(), text.size());
    return {data, text.size()};
}

const char* shader_kind_name(ShaderKind kind) {
    constexpr const char* kNames[] = {"surface", "displacement", "light",
                                      "volume",  "imager",       "transformation"};
    return kNames[int(kind)];
}

const char* op_text(Op op) {
    constexpr const char* kTexts[] = {
        "", "+", "-", "*", "/", ".", "^", "<", "<=", ">", ">=", "==", "!=", "&&", "||", "!", "-"};
    return kTexts[int(op)];
}

}  // namespace kinora::rsl

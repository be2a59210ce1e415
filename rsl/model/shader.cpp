// rsl/model/shader.cpp: the names of vertex inputs that shaders read without declaring them.
#include "rsl/model/shader.h"

#include <fmt/format.h>

namespace kinora::rsl {

std::string vertex_request_name(BaseType type, std::string_view input) {
    return fmt::format("@{}.{}", type_name(type), input);
}

std::optional<std::string_view> requested_input(std::string_view binding, BaseType type) {
    std::string begin = vertex_request_name(type, "");
    if (!binding.starts_with(begin)) return {};
    return binding.substr(begin.size());
}

namespace {

bool fits(std::string_view pattern, std::string_view text) {
    if (pattern.empty()) return text.empty();
    if (pattern[0] != '*')
        return !text.empty() && text[0] == pattern[0] && fits(pattern.substr(1), text.substr(1));
    for (size_t k = 0; k <= text.size(); ++k)
        if (fits(pattern.substr(1), text.substr(k))) return true;
    return false;
}

}  // namespace

std::optional<BaseType> named_output(const Shader& shader, std::string_view name) {
    const NamedOutput* best = nullptr;  // the longest pattern says most
    for (const NamedOutput& output : shader.named_outputs)
        if (fits(output.pattern, name) && (!best || output.pattern.size() > best->pattern.size()))
            best = &output;
    return best ? std::optional(best->type) : std::nullopt;
}

}  // namespace kinora::rsl

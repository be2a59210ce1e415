// runtime/scene/kernels/light_categories.cpp: category texts of lights and of those who ask.
#include "runtime/scene/kernels/light_categories.h"

#include <algorithm>

namespace kinora {

namespace {

// The parts of a text between separators: calls each(part) until one is true.
template <class Each>
bool any_part(std::string_view text, char separator, Each&& each) {
    for (size_t at = 0; at <= text.size();) {
        size_t end = std::min(text.find(separator, at), text.size());
        if (each(text.substr(at, end - at))) return true;
        at = end + 1;
    }
    return false;
}

std::string_view trimmed(std::string_view text) {
    size_t first = text.find_first_not_of(' ');
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

}  // namespace

bool has_category(std::string_view own, std::string_view wanted) {
    auto has = [&](std::string_view name) {
        name = trimmed(name);
        bool without = name.starts_with("-");
        if (without) name = trimmed(name.substr(1));
        return any_part(own, ',', [&](std::string_view part) { return trimmed(part) == name; }) !=
               without;
    };
    if (wanted.find_first_of("|&") == std::string_view::npos)
        return any_part(wanted, ',', [&](std::string_view name) { return has(name); });
    return any_part(wanted, '|', [&](std::string_view both) {
        return !any_part(both, '&', [&](std::string_view name) { return !has(name); });
    });
}

}  // namespace kinora

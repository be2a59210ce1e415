// runtime/scene/gltf/pointers/channel_target.cpp: what a channel of an animation drives.
#include "runtime/scene/gltf/pointers/channel_target.h"

#include <algorithm>
#include <charconv>
#include <iterator>

#include "runtime/scene/gltf/file/value.h"

namespace kinora {

namespace {

constexpr std::string_view kNodePaths[] = {"translation", "rotation", "scale", "weights"};

// "/nodes/3/scale" as its parts; false for another pointer.
bool read_node_pointer(std::string_view pointer, ChannelTarget& target) {
    constexpr std::string_view kNodes = "/nodes/";
    if (!pointer.starts_with(kNodes)) return false;
    pointer.remove_prefix(kNodes.size());
    const auto [rest, error] =
        std::from_chars(pointer.data(), pointer.data() + pointer.size(), target.node);
    if (error != std::errc() || target.node < 0) return false;
    pointer.remove_prefix(size_t(rest - pointer.data()));
    const bool is_path = pointer.starts_with('/') &&
                         std::ranges::find(kNodePaths, pointer.substr(1)) != std::end(kNodePaths);
    if (is_path) target.path = pointer.substr(1);
    return is_path;
}

}  // namespace

ChannelTarget target_of(const tinygltf::AnimationChannel& channel) {
    if (channel.target_path != "pointer") return {channel.target_node, channel.target_path, ""};
    auto found = channel.target_extensions.find("KHR_animation_pointer");
    if (found == channel.target_extensions.end()) return {};
    ChannelTarget target;
    std::string pointer = string_member(found->second, "pointer");
    if (!read_node_pointer(pointer, target)) target = {-1, "", std::move(pointer)};
    return target;
}

}  // namespace kinora

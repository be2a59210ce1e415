// runtime/scene/gltf/pointers/channel_target.h: what a channel of an animation drives.
#pragma once

#include <string>

#include "runtime/scene/gltf/file/file.h"

namespace kinora {

// A node's property, or a value of the file by its JSON pointer (KHR_animation_pointer).
struct ChannelTarget {
    int node = -1;     // not checked
    std::string path;  // "translation"; "" with a pointer
    std::string pointer;
};

// A pointer to a node's property is that property. Nothing is driven, and both texts are empty,
// where an extension's pointer is no string.
ChannelTarget target_of(const tinygltf::AnimationChannel& channel);

}  // namespace kinora

// runtime/scene/gltf/pointers/pointer_slots.cpp: values of the file that channels drive by JSON
// pointers.
#include "runtime/scene/gltf/pointers/pointer_slots.h"

#include <algorithm>

#include "runtime/scene/gltf/pointers/channel_target.h"

namespace kinora {

uint32_t SlotFollower::width() const {
    uint32_t width = 0;
    for (ValueSlot slot : slots) width += slot.count;
    return width;
}

PointerSlots::PointerSlots(const tinygltf::Model& model) {
    for (const tinygltf::Animation& animation : model.animations)
        for (const tinygltf::AnimationChannel& channel : animation.channels)
            if (std::string pointer = target_of(channel).pointer; !pointer.empty())
                driven_.insert(std::move(pointer));
}

void PointerSlots::add(SlotFollower follower) {
    bool moves = std::ranges::any_of(follower.values,
                                     [&](const FileValue& v) { return is_driven(v.pointer); });
    if (!moves) return;
    for (const FileValue& value : follower.values)
        by_pointer_[value.pointer].push_back(uint32_t(followers_.size()));
    followers_.push_back(std::move(follower));
}

void PointerSlots::follow(FileValue value, std::vector<ValueSlot> slots, double scale) {
    add({{std::move(value)}, std::move(slots), scale, nullptr});
}

void PointerSlots::follow(std::vector<FileValue> values, std::vector<ValueSlot> slots,
                          SlotFormula formula) {
    add({std::move(values), std::move(slots), 1, std::move(formula)});
}

void PointerSlots::pass_over(const std::string& pointer) {
    if (is_driven(pointer)) passed_over_.insert(pointer);
}

void PointerSlots::pass_over_from(size_t first, size_t end) {
    for (size_t f = first; f < end; ++f)
        for (const FileValue& value : followers_[f].values) {
            std::erase(by_pointer_[value.pointer], uint32_t(f));
            pass_over(value.pointer);
        }
}

std::span<const uint32_t> PointerSlots::followers_of(const std::string& pointer) const {
    auto found = by_pointer_.find(pointer);
    return found == by_pointer_.end() ? std::span<const uint32_t>() : found->second;
}

}  // namespace kinora

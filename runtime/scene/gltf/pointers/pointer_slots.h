// runtime/scene/gltf/pointers/pointer_slots.h: values of the file that channels drive by JSON
// pointers (KHR_animation_pointer), and the slots that follow them.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "runtime/scene/description/scene_description.h"
#include "runtime/scene/gltf/file/file.h"

namespace kinora {

// A value of the file, and what it holds.
struct FileValue {
    std::string pointer;
    std::vector<double> rest;
};

// Numbers of slots, one slot after the other, from those of file values.
using SlotFormula = std::function<void(std::span<const std::vector<double>>, double* numbers)>;

// Slots that follow values of the file.
struct SlotFollower {
    std::vector<FileValue> values;
    std::vector<ValueSlot> slots;  // of the one value's numbers in turn, where there is no formula
    double scale = 1;              // of these
    SlotFormula formula;

    uint32_t width() const;  // of all slots
};

// Only values that a channel drives are kept.
class PointerSlots {
  public:
    explicit PointerSlots(const tinygltf::Model& model);

    // Slots with a value's numbers times `scale`, or with what a formula makes of some values.
    void follow(FileValue value, std::vector<ValueSlot> slots, double scale = 1);
    void follow(std::vector<FileValue> values, std::vector<ValueSlot> slots, SlotFormula formula);
    // Values that are read, and that other ones stand in place of.
    void pass_over(const std::string& pointer);

    bool is_driven(const std::string& pointer) const { return driven_.contains(pointer); }
    bool is_passed_over(const std::string& pointer) const { return passed_over_.contains(pointer); }

    std::span<const SlotFollower> followers() const { return followers_; }
    // By number; none of a pointer that nothing follows.
    std::span<const uint32_t> followers_of(const std::string& pointer) const;
    // Those from this number on are gone, and their values are passed over.
    void pass_over_from(size_t first, size_t end);

  private:
    void add(SlotFollower follower);

    std::set<std::string> driven_, passed_over_;
    std::vector<SlotFollower> followers_;
    std::map<std::string, std::vector<uint32_t>> by_pointer_;
};

}  // namespace kinora

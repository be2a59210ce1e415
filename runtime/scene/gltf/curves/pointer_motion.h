// runtime/scene/gltf/curves/pointer_motion.h: values of materials, lights and cameras as curves of
// what stands in the file for them (KHR_animation_pointer).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "runtime/scene/gltf/curves/curve_writer.h"
#include "runtime/scene/gltf/curves/moving_object.h"

namespace kinora {

class PointerMotion {
  public:
    PointerMotion(const SceneDescription& description, std::span<const Take> takes,
                  CurveWriter& curves);

    // By any take.
    bool is_moved(ValueSlot slot) const;

    // An object that is made of these slots, at all keys and between them. It is `make` of the
    // values at rest where nothing moves them.
    MovingObject object(std::span<const ValueSlot> slots, const ObjectAt& make);

    // Every take's curves of the object's numbers. The object stands at `pointer`.
    void move_object(const std::string& pointer, std::span<const ValueSlot> slots,
                     const ObjectAt& make, const MovingObject& object);

    // Of a slot whose numbers stand there as they are.
    void move_numbers(const std::string& pointer, ValueSlot slot);

  private:
    void move_object(uint32_t take, const std::string& pointer,
                     const std::vector<MovingChannel>& channels, const ObjectAt& make,
                     const MovingObject& object);
    std::vector<ValueSlot> moved(std::span<const ValueSlot> slots) const;

    const SceneDescription& description_;
    std::span<const Take> takes_;
    CurveWriter& curves_;
    ValuesAtTime values_;
    std::vector<bool> moved_;  // per value
};

}  // namespace kinora

// runtime/scene/gltf/curves/pointer_motion.cpp: values of materials, lights and cameras as curves.
#include "runtime/scene/gltf/curves/pointer_motion.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

namespace kinora {

namespace {

// The keys, and times between them.
std::vector<double> looked_at(const std::vector<double>& keys) {
    std::vector<double> times;
    for (size_t k = 0; k < keys.size(); ++k) {
        times.push_back(keys[k]);
        for (double s : kProbes)
            if (k + 1 < keys.size()) times.push_back(keys[k] + s * (keys[k + 1] - keys[k]));
    }
    return times;
}

}  // namespace

PointerMotion::PointerMotion(const SceneDescription& description, std::span<const Take> takes,
                             CurveWriter& curves)
    : description_(description),
      takes_(takes),
      curves_(curves),
      values_(description),
      moved_(description.values.size(), false) {
    for (const Take& take : takes_)
        for (const anim::Animation::Write& write : take.animation->writes)
            moved_[write.slot] = true;
}

bool PointerMotion::is_moved(ValueSlot slot) const {
    ValueSlot written = written_slot(description_, slot);
    for (uint32_t i = 0; written.present() && i < written.count; ++i)
        if (moved_[written.offset + i]) return true;
    return false;
}

std::vector<ValueSlot> PointerMotion::moved(std::span<const ValueSlot> slots) const {
    std::vector<ValueSlot> result;
    std::ranges::copy_if(slots, std::back_inserter(result),
                         [&](ValueSlot slot) { return is_moved(slot); });
    return result;
}

MovingObject PointerMotion::object(std::span<const ValueSlot> slots, const ObjectAt& make) {
    MovingObject object(make(description_.values));
    const std::vector<ValueSlot> moving = moved(slots);
    for (const Take& take : takes_) {
        if (moving.empty()) break;
        std::vector<MovingChannel> channels = channels_of(description_, *take.animation, moving);
        for (double time : looked_at(key_times({}, channels, description_))) {
            values_.evaluate(channels, time);
            object.look_at(make(values_.values()));
        }
        values_.to_rest(channels);
    }
    return object;
}

void PointerMotion::move_object(const std::string& pointer, std::span<const ValueSlot> slots,
                                const ObjectAt& make, const MovingObject& object) {
    if (object.moving().empty()) return;
    const std::vector<ValueSlot> moving = moved(slots);
    for (uint32_t take = 0; take < takes_.size(); ++take) {
        std::vector<MovingChannel> channels =
            channels_of(description_, *takes_[take].animation, moving);
        if (!channels.empty()) move_object(take, pointer, channels, make, object);
        values_.to_rest(channels);
    }
}

void PointerMotion::move_object(uint32_t take, const std::string& pointer,
                                const std::vector<MovingChannel>& channels, const ObjectAt& make,
                                const MovingObject& object) {
    std::map<double, std::vector<std::vector<double>>> known;  // numbers at a time, by pointer
    auto numbers_at = [&](double time) -> const auto& {
        auto [found, is_new] = known.try_emplace(time);
        if (!is_new) return found->second;
        values_.evaluate(channels, time);
        Json now = make(values_.values());
        for (const std::string& member : object.moving())
            found->second.push_back(object.numbers(now, member));
        return found->second;
    };
    PropertyCurve curve;
    curve.channels = channels;
    curve.times = key_times({}, channels, description_);
    size_t index = 0;
    for (const std::string& member : object.moving()) {
        curve.name = pointer + member;
        curve.width = uint32_t(object.numbers(object.rest(), member).size());
        curve.at = [&](double time, double* out) {
            const std::vector<double>& numbers = numbers_at(time)[index];
            std::copy_n(numbers.begin(), std::min<size_t>(numbers.size(), curve.width), out);
        };
        curves_.add(take, kNone, curve);
        ++index;
    }
}

void PointerMotion::move_numbers(const std::string& pointer, ValueSlot slot) {
    if (!is_moved(slot)) return;
    const bool is_written = written_slot(description_, slot).offset == slot.offset;
    for (uint32_t take = 0; take < takes_.size(); ++take) {
        PropertyCurve curve;
        curve.name = pointer;
        curve.width = slot.count;
        curve.channels = channels_of(description_, *takes_[take].animation, std::span(&slot, 1));
        if (curve.channels.empty()) continue;
        curve.times = key_times({}, curve.channels, description_);
        const std::vector<MovingChannel> channels = curve.channels;
        curve.at = [&](double time, double* out) {
            values_.evaluate(channels, time);
            std::copy_n(&values_.values()[slot.offset], slot.count, out);
        };
        if (!is_written || !curves_.add_spline(take, kNone, curve, slot.offset))
            curves_.add(take, kNone, curve);
        values_.to_rest(channels);
    }
}

}  // namespace kinora

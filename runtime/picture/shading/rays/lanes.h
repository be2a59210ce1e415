// runtime/picture/shading/rays/lanes.h: the lanes of a call of a service, and samples of them.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

#include "jit/ir/kernel_call.h"
#include "raytrace/random/series.h"
#include "runtime/base/math.h"

namespace kinora {

inline constexpr int kMostSamples = 65536;  // of one call at one point

// Lanes of a service call, by name of the argument row.
class Lanes {
  public:
    explicit Lanes(const jit::ServiceCall& call) : call_(call), mask_(call.mask) {}
    const jit::ServiceCall& call() const { return call_; }
    uint32_t mask() const { return mask_; }
    bool asks(int lane) const { return mask_ >> lane & 1; }
    float number(int row, int lane) const { return call_.args[row * jit::kMaxLanes + lane]; }
    int32_t integer(int row, int lane) const { return jit::bits_of(number(row, lane)); }
    vec3 triple(int row, int lane) const {
        return {number(row, lane), number(row + 1, lane), number(row + 2, lane)};
    }
    void set(int row, int lane, float value) const {
        call_.results[row * jit::kMaxLanes + lane] = value;
    }
    void set(int row, int lane, vec3 v) const {
        for (int k = 0; k < 3; ++k) set(row + k, lane, v[k]);
    }
    size_t point(int lane) const { return size_t(call_.first + lane); }
    // These lanes only, where they ask.
    Lanes(const Lanes& all, uint32_t lanes) : call_(all.call_), mask_(all.mask_ & lanes) {}
    // Calls f(lanes) for the lanes of each text that argument `row` has, one text after the other:
    // rays that go together share their label.
    template <class F>
    void for_each_text(int row, F&& f) const {
        for (uint32_t left = mask_; left;) {
            int32_t text = integer(row, std::countr_zero(left));
            uint32_t same = 0;
            for (uint32_t rest = left; rest; rest &= rest - 1)
                if (int lane = std::countr_zero(rest); integer(row, lane) == text)
                    same |= 1u << lane;
            f(Lanes(*this, same));
            left &= ~same;
        }
    }
    int first() const { return std::countr_zero(mask_); }
    int samples(int row, int lane) const {
        float n = number(row, lane);
        return n >= 1 ? int(std::min(n + 0.5f, float(kMostSamples))) : 1;
    }
    // What tells the point apart; the call in the source, with its loops.
    uint32_t own(int lane) const { return uint32_t(integer(0, lane)); }
    uint32_t site(int lane) const { return uint32_t(integer(1, lane)); }
    // Of all samples of the call at this lane.
    uint32_t seed(int lane) const { return raytrace::hash(own(lane), site(lane)); }

  private:
    const jit::ServiceCall& call_;
    uint32_t mask_;
};

// The samples of some lanes: of which lane each is, and its number there.
struct SampleSpan {
    std::span<const uint8_t> lane;
    std::span<const uint32_t> number;

    size_t size() const { return lane.size(); }
    SampleSpan subspan(size_t first, size_t count) const {
        return {lane.subspan(first, count), number.subspan(first, count)};
    }
};

}  // namespace kinora

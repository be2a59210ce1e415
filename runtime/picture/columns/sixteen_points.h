// runtime/picture/columns/sixteen_points.h: columns of hits read, and rows of a grid written,
// sixteen points at a time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "runtime/base/math.h"
#include "runtime/picture/columns/kernels.h"

namespace kinora {

// Rows of one triple; a triple that is wanted in part has all three rows.
struct Triple {
    float* c[3] = {};
    explicit operator bool() const { return c[0]; }
    void set(size_t i, vec3 value) const {
        c[0][i] = value.x;
        c[1][i] = value.y;
        c[2][i] = value.z;
    }
};

// Up to sixteen points of a grid, whose hits often lie one behind the other.
class SixteenPoints {
  public:
    // `ascending`: the points are known to be in order.
    SixteenPoints(std::span<const uint32_t> points, size_t first, size_t end, bool ascending)
        : hit_(points.data() + first),
          count_(std::min(kColumnPoints, end - first)),
          dense_(count_ == kColumnPoints &&
                 hit_[kColumnPoints - 1] - hit_[0] == kColumnPoints - 1 &&
                 (ascending || std::is_sorted(hit_, hit_ + kColumnPoints))) {}

    size_t count() const { return count_; }
    uint32_t hit(size_t i) const { return hit_[i < count_ ? i : 0]; }
    // A column of hits at these points, in `room` where it is not there in one piece.
    template <class T>
    const T* at(const T* column, T (&room)[kColumnPoints]) const {
        if (dense_) return column + hit_[0];
        for (size_t i = 0; i < kColumnPoints; ++i) room[i] = column[hit(i)];
        return room;
    }
    TripleColumns at(const float* const columns[3], float (&room)[3][kColumnPoints]) const {
        return {{at(columns[0], room[0]), at(columns[1], room[1]), at(columns[2], room[2])}};
    }

  private:
    const uint32_t* hit_;
    size_t count_;
    bool dense_;
};

}  // namespace kinora

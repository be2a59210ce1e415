// anim/channel.h: which numbers a sampler drives.
#pragma once

#include <cstdint>

namespace kinora::anim {

// Sampler components component .. component + count - 1 go to values[slot + i * slot_step]. A
// whole-matrix target is count 16 with a sampler of SampleKind::Matrix; its slot holds the matrix
// in document (row-major) order.
struct Channel {
    uint32_t sampler = 0;    // index into Animation::samplers
    uint32_t component = 0;  // first component read
    uint32_t slot = 0;       // first number written
    uint32_t count = 1;
    uint32_t slot_step = 1;
    uint32_t owner = 0;  // bit set when one of these numbers changes
};

// Index of COLLADA's `matrix(column)(row)` within a slot that holds a <matrix>: matrix(3)(0) is 3.
constexpr uint32_t matrix_slot(uint32_t column, uint32_t row) {
    return row * 4 + column;
}

}  // namespace kinora::anim

// runtime/scene/images/point_file.h: points with values on disk, as bake3d writes and texture3d
// reads them.
//
// The format, little-endian:
//   8 bytes   "KNPOINT1"
//   uint32    number of channels
//   uint64    number of points
//   each channel: uint32 type letter (f c p v n m as in rsl/model/builtin.h), uint32 bytes of its
//   name,
//             the name
//   each point: floats P xyz, N xyz (world space), radius, then the channels' numbers in order
// and nothing behind: a file of another length is broken.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace kinora {

struct PointChannel {
    std::string name;
    char type = 'f';
    int offset = 0;  // of its first number in a point
    bool operator==(const PointChannel&) const = default;
};
int point_components(char type);  // 1, 3 or 16; 0 for a letter that is no type

inline constexpr int kPointHead = 7;  // numbers before the channels: P, N, radius

struct PointFile {
    std::vector<PointChannel> channels;
    int stride = kPointHead;  // floats of one point
    std::vector<float> points;

    size_t count() const { return points.size() / size_t(stride); }
    const float* point(size_t i) const { return points.data() + i * size_t(stride); }
    // Adds a channel unless it is there; its index.
    size_t channel(std::string_view name, char type);
};

// Both give "" or what is wrong. Writing is whole or not at all: a file beside it is renamed. It
// replaces nothing but point files and empty ones.
std::string read_point_file(const std::string& path, PointFile& out);
std::string write_point_file(const std::string& path, const PointFile& file);

}  // namespace kinora

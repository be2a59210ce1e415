// runtime/scene/images/point_store.h: point files in memory, each read once, with an index of where
// points are.
#pragma once

#include <map>
#include <memory>
#include <shared_mutex>
#include <span>
#include <string>
#include <vector>

#include "runtime/base/allowed_paths.h"
#include "runtime/base/math.h"
#include "runtime/scene/images/point_file.h"

namespace kinora {

// The points of a file and a balanced tree over their positions.
class PointCloud {
  public:
    explicit PointCloud(PointFile file);

    struct Near {
        float distance2;
        uint32_t point;
        bool operator<(const Near& o) const {
            return distance2 != o.distance2 ? distance2 < o.distance2 : point < o.point;
        }
    };
    // The nearest points to P, nearest first, at most near.size() of them (at most 64); their
    // number. With N not 0, only points whose normal is 0 or within 90 degrees of it.
    size_t nearest(vec3 P, vec3 N, std::span<Near> near) const;

    const PointFile file;

  private:
    void build(size_t begin, size_t end, int depth);
    struct Search;
    void search(Search& s, size_t begin, size_t end) const;
    float coordinate(uint32_t point, int axis) const { return file.point(point)[axis]; }

    std::vector<uint32_t> order_;  // the middle of each range splits it
    std::vector<uint8_t> axis_;    // by position in order_
};

class PointStore {
  public:
    PointStore() = default;
    explicit PointStore(AllowedPaths trees)
        : trees_(std::move(trees)) {}  // reads files of these only

    // A channel of a file, as a look-up names it.
    struct Channel {
        int offset = -1;  // in a point; -1: the file has no such channel
        int components = 1;
    };
    struct Lookup {
        const PointCloud* cloud = nullptr;  // null: the file cannot be read
        std::span<const Channel> channels;
    };
    // The file and channels of interned texts ("float a,color b"). Reads the file when it has not
    // been met; only then it allocates. Thread-safe; valid until forget().
    Lookup find(int32_t path, int32_t channels);

    // The file has been written: the next look-up reads it again. While nothing is looked up.
    void forget(const std::string& path);
    // Files that look-ups asked for and that cannot be read, with the reason; they are tried again.
    std::vector<std::pair<std::string, std::string>> take_errors();

  private:
    struct Entry {
        std::unique_ptr<PointCloud> cloud;
        std::string error;
        std::map<int32_t, std::vector<Channel>> channels;  // by the interned text
    };
    const AllowedPaths trees_;
    std::shared_mutex mutex_;
    std::map<int32_t, Entry> entries_;  // by the interned path
};

// "float a,color b" in parts: type letter and name. Texts that do not fit are left out.
std::vector<std::pair<char, std::string>> split_channels(std::string_view text);

}  // namespace kinora

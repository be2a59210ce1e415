// runtime/scene/images/point_store.cpp: point files by name, and the points near a position.
#include "runtime/scene/images/point_store.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <mutex>
#include <numeric>

#include "rsl/model/renderer_services.h"
#include "rsl/syntax/types.h"

namespace kinora {

// ---- the tree -----------------------------------------------------------------------------------

PointCloud::PointCloud(PointFile from) : file(std::move(from)) {
    order_.resize(file.count());
    axis_.resize(file.count());
    std::iota(order_.begin(), order_.end(), 0u);
    // Points without a position are no one's neighbours.
    std::erase_if(order_, [&](uint32_t p) {
        return !std::isfinite(coordinate(p, 0)) || !std::isfinite(coordinate(p, 1)) ||
               !std::isfinite(coordinate(p, 2));
    });
    build(0, order_.size(), 0);
}

// The middle point of a range splits it along the range's longest side.
void PointCloud::build(size_t begin, size_t end, int depth) {
    if (end - begin < 2) return;
    float low[3], high[3];
    for (int k = 0; k < 3; ++k) low[k] = HUGE_VALF, high[k] = -HUGE_VALF;
    for (size_t i = begin; i < end; ++i)
        for (int k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], coordinate(order_[i], k));
            high[k] = std::max(high[k], coordinate(order_[i], k));
        }
    int axis = 0;
    for (int k = 1; k < 3; ++k)
        if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    size_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + long(begin), order_.begin() + long(middle),
                     order_.begin() + long(end), [&](uint32_t a, uint32_t b) {
                         float x = coordinate(a, axis), y = coordinate(b, axis);
                         return x != y ? x < y : a < b;
                     });
    axis_[middle] = uint8_t(axis);
    build(begin, middle, depth + 1);
    build(middle + 1, end, depth + 1);
}

// The candidates so far, nearest first.
struct PointCloud::Search {
    vec3 P, N;
    std::span<Near> near;
    size_t count = 0;

    float reach() const { return count < near.size() ? HUGE_VALF : near[count - 1].distance2; }
    void offer(Near candidate) {
        if (count == near.size() && !(candidate < near[count - 1])) return;
        size_t at = count < near.size() ? count++ : count - 1;
        while (at > 0 && candidate < near[at - 1]) {
            near[at] = near[at - 1];
            --at;
        }
        near[at] = candidate;
    }
};

void PointCloud::search(Search& s, size_t begin, size_t end) const {
    if (begin >= end) return;
    size_t middle = begin + (end - begin) / 2;
    uint32_t point = order_[middle];
    const float* p = file.point(point);
    vec3 way(p[0] - s.P.x, p[1] - s.P.y, p[2] - s.P.z);
    vec3 n(p[3], p[4], p[5]);
    bool faces = s.N == vec3(0.0f) || n == vec3(0.0f) || glm::dot(n, s.N) >= 0;
    if (faces) s.offer({glm::dot(way, way), point});
    if (end - begin == 1) return;
    float beyond = s.P[axis_[middle]] - p[axis_[middle]];
    if (beyond < 0) {
        search(s, begin, middle);
        if (beyond * beyond <= s.reach()) search(s, middle + 1, end);
    } else {
        search(s, middle + 1, end);
        if (beyond * beyond <= s.reach()) search(s, begin, middle);
    }
}

size_t PointCloud::nearest(vec3 P, vec3 N, std::span<Near> near) const {
    Search s{P, N, near};
    if (!near.empty()) search(s, 0, order_.size());
    return s.count;
}

// ---- the store ----------------------------------------------------------------------------------

std::vector<std::pair<char, std::string>> split_channels(std::string_view text) {
    std::vector<std::pair<char, std::string>> parts;
    while (!text.empty()) {
        size_t end = std::min(text.find(','), text.size());
        std::string_view part = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        size_t space = part.find(' ');
        if (space == std::string_view::npos) continue;
        rsl::BaseType type = rsl::type_from_name(part.substr(0, space));
        if (type <= rsl::BaseType::Matrix)
            parts.emplace_back("fcpvnm"[int(type)], std::string(part.substr(space + 1)));
    }
    return parts;
}

namespace {

bool is_triple(char type) {
    return point_components(type) == 3;
}

std::vector<PointStore::Channel> resolve(const PointFile* file, std::string_view text) {
    std::vector<PointStore::Channel> found;
    for (const auto& [type, name] : split_channels(text)) {
        PointStore::Channel& channel = found.emplace_back();
        channel.components = point_components(type);
        for (const PointChannel& own : file ? file->channels : std::vector<PointChannel>())
            if (own.name == name && (own.type == type || (is_triple(own.type) && is_triple(type))))
                channel.offset = own.offset;
    }
    return found;
}

}  // namespace

PointStore::Lookup PointStore::find(int32_t path, int32_t channels) {
    {
        std::shared_lock lock(mutex_);
        auto entry = entries_.find(path);
        if (entry != entries_.end())
            if (auto known = entry->second.channels.find(channels);
                known != entry->second.channels.end())
                return {entry->second.cloud.get(), known->second};
    }
    std::unique_lock lock(mutex_);
    auto [entry, fresh] = entries_.try_emplace(path);
    if (fresh) {
        PointFile file;
        const std::string& name = rsl::interned(path);
        auto [file_path, outside] = trees_.find(name);
        entry->second.error =
            name.empty() ? ""  // a parameter that is not filled in
            : outside ? "it lies outside the scene's folder (--allow-external DIR lets it be read)"
                      : read_point_file(file_path, file);
        if (!name.empty() && entry->second.error.empty())
            entry->second.cloud = std::make_unique<PointCloud>(std::move(file));
    }
    const PointCloud* cloud = entry->second.cloud.get();
    auto [known, unseen] = entry->second.channels.try_emplace(channels);
    if (unseen) known->second = resolve(cloud ? &cloud->file : nullptr, rsl::interned(channels));
    return {cloud, known->second};
}

void PointStore::forget(const std::string& path) {
    std::unique_lock lock(mutex_);
    entries_.erase(rsl::intern(path));
}

std::vector<std::pair<std::string, std::string>> PointStore::take_errors() {
    std::unique_lock lock(mutex_);
    std::vector<std::pair<std::string, std::string>> errors;
    std::erase_if(entries_, [&](const auto& entry) {
        if (entry.second.error.empty()) return false;
        errors.emplace_back(rsl::interned(entry.first), entry.second.error);
        return true;
    });
    std::sort(errors.begin(), errors.end());
    return errors;
}

}  // namespace kinora

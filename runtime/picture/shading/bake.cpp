// runtime/picture/shading/bake.cpp: bake3d.
#include "runtime/picture/shading/bake.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "raytrace/hits.h"
#include "rsl/model/renderer_services.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/images/point_store.h"
#include "runtime/scene/shaders/point_queries.h"

namespace kinora {

void Bakes::begin_frame(size_t threads) {
    points_.resize(std::max(points_.size(), threads));
}

// One point a pixel: what its first sample sees, through transparent layers too. Rays that shaders
// shoot bake nothing.
void Bakes::add(const Grid& grid, const jit::ServiceCall& call) {
    enum { File = 0, Channels, P = 3, N = 6, Radius = 9, Scale, Numbers };
    if (grid.depth > 0 || !grid.shadows) return;
    std::vector<BakedPoint>& points = points_[grid.memory.number];
    ArgumentRows rows{call};
    ToWorld to_world(pose_);
    for (int lane = 0; lane < call.lanes; ++lane) {
        if (!(call.mask >> lane & 1)) continue;
        uint32_t hit = grid.points[size_t(call.first + lane)];
        if (grid.hits.sample[hit] != 0) continue;
        BakedPoint point;
        point.file = rows.integer(File, lane);
        if (rsl::interned(point.file).empty()) continue;  // a parameter that is not filled in
        point.channels = rows.integer(Channels, lane);
        point.pixel_y = grid.hits.pixel_y[hit];
        point.pixel_x = grid.hits.pixel_x[hit];
        point.layer = grid.hits.layer[hit];
        point.order = uint32_t(points.size());
        float radius = rows.number(Radius, lane), scale = rows.number(Scale, lane);
        bool as_is = scale < 0;
        vec3 position = as_is ? rows.triple(P, lane) : to_world.position(rows.triple(P, lane));
        vec3 normal = as_is ? rows.triple(N, lane) : to_world.direction(rows.triple(N, lane));
        // Half the diagonal of the pixel's footprint, so that neighbours touch.
        if (!(radius > 0))
            radius = 0.70710678f * std::max(glm::length(kinora::triple(grid.hits.dPdx, hit)),
                                            glm::length(kinora::triple(grid.hits.dPdy, hit)));
        radius *= std::abs(scale);
        float head[kPointHead] = {position.x, position.y, position.z, normal.x,
                                  normal.y,   normal.z,   radius};
        std::copy_n(head, kPointHead, point.numbers);
        for (int k = 0; k < rsl::kPointFloats; ++k)
            point.numbers[kPointHead + k] = rows.number(Numbers + k, lane);
        points.push_back(point);
    }
}

namespace {

// Points of one file, in picture order, with all channels that any of them has.
PointFile joined(std::span<const BakedPoint* const> points) {
    PointFile file;
    int32_t last = -1;
    for (const BakedPoint* p : points) {
        if (p->channels == last) continue;
        last = p->channels;
        for (const auto& [type, name] : split_channels(rsl::interned(p->channels)))
            file.channel(name, type);
    }
    file.points.assign(points.size() * size_t(file.stride), 0.0f);
    std::vector<int> to;  // offsets of the numbers of the last text
    last = -1;
    for (size_t i = 0; i < points.size(); ++i) {
        const BakedPoint& p = *points[i];
        if (p.channels != last || i == 0) {
            last = p.channels;
            to.clear();
            for (const auto& [type, name] : split_channels(rsl::interned(p.channels)))
                for (int k = 0; k < point_components(type); ++k)
                    to.push_back(file.channels[file.channel(name, type)].offset + k);
        }
        float* out = file.points.data() + i * size_t(file.stride);
        std::copy_n(p.numbers, kPointHead, out);
        for (size_t k = 0; k < to.size(); ++k) out[to[k]] = p.numbers[kPointHead + int(k)];
    }
    return file;
}

}  // namespace

void Bakes::flush(bool whole, Diagnostics& diagnostics) {
    std::vector<const BakedPoint*> all;
    for (const auto& points : points_)
        for (const BakedPoint& point : points) all.push_back(&point);
    auto key = [](const BakedPoint* p) {
        return std::tie(rsl::interned(p->file), p->pixel_y, p->pixel_x, p->layer, p->order);
    };
    std::sort(all.begin(), all.end(),
              [&](const BakedPoint* a, const BakedPoint* b) { return key(a) < key(b); });
    for (size_t begin = 0; whole && begin < all.size();) {
        size_t end = begin + 1;
        while (end < all.size() && all[end]->file == all[begin]->file) ++end;
        const std::string& name = rsl::interned(all[begin]->file);
        auto [path, outside] = resources_.description->writable.find(name);
        std::string error =
            outside ? "it lies outside the scene's folder (--allow-external DIR lets it be written)"
                    : write_point_file(path, joined({all.data() + begin, end - begin}));
        if (!error.empty()) diagnostics.report(Code::FRAME_UNWRITABLE, Location{}, path, error);
        resources_.points->forget(name);
        begin = end;
    }
    for (auto& points : points_) points.clear();
    for (auto& [path, error] : resources_.points->take_errors())
        if (reported_.insert(path).second)
            diagnostics.report(Code::POINT_FILE_UNREADABLE, Location{}, path, error);
}

}  // namespace kinora

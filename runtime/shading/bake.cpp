// runtime/shading/bake.cpp: bake3d, texture3d and photon maps.
#include "runtime/shading/bake.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <tuple>

#include "raytrace/hits.h"
#include "rsl/model/renderer_services.h"
#include "runtime/description/findings.h"
#include "runtime/images/point_store.h"
#include "runtime/scene/scene.h"

namespace kinora {

namespace {

constexpr size_t kNeighbours = 8, kMostPhotons = 64;

// World space, as the files have it.
struct ToWorld {
    dmat4 point;
    dmat3 normal;  // of normals: the transpose of camera_from_world
    explicit ToWorld(const Pose& pose)
        : point(glm::inverse(pose.view.camera_from_world)),
          normal(glm::transpose(dmat3(pose.view.camera_from_world))) {}
    vec3 position(vec3 P) const { return vec3(dvec3(point * dvec4(dvec3(P), 1.0))); }
    vec3 direction(vec3 N) const {
        dvec3 n = normal * dvec3(N);
        double length = glm::length(n);
        return length > 0 ? vec3(n / length) : vec3(0.0f);
    }
};

struct Rows {
    const jit::ServiceCall& call;
    float number(int row, int lane) const { return call.args[row * jit::kMaxLanes + lane]; }
    int32_t integer(int row, int lane) const { return jit::bits_of(number(row, lane)); }
    vec3 triple(int row, int lane) const {
        return {number(row, lane), number(row + 1, lane), number(row + 2, lane)};
    }
};

// Weights of the neighbours; the first alone where the position is its own.
size_t weigh(std::span<PointCloud::Near> near, const PointFile& file, float* weights) {
    if (near.empty()) return 0;
    float radius = file.point(near[0].point)[kPointHead - 1];
    if (near.size() == 1 || near[0].distance2 <= 1e-10f * radius * radius) {
        weights[0] = 1;
        return 1;
    }
    float farthest = std::sqrt(near.back().distance2) * 1.0001f, sum = 0;
    for (size_t i = 0; i < near.size(); ++i) {
        float share = farthest > 0 ? 1 - std::sqrt(near[i].distance2) / farthest : 1;
        sum += weights[i] = share * share;
    }
    for (size_t i = 0; i < near.size(); ++i) weights[i] /= sum;
    return near.size();
}

// The mean of a channel's numbers over the neighbours.
struct Mean {
    PointCloud::Near near[kNeighbours];
    float weights[kNeighbours];
    size_t count = 0;
    const PointFile* file = nullptr;

    Mean(const PointCloud& cloud, vec3 P, vec3 N) : file(&cloud.file) {
        size_t found = cloud.nearest(P, N, near);
        count = weigh({near, found}, *file, weights);
    }
    float number(int offset) const {
        float sum = 0;
        for (size_t i = 0; i < count; ++i) sum += weights[i] * file->point(near[i].point)[offset];
        return sum;
    }
};

vec3 photon_density(const PointCloud& cloud, int offset, vec3 P, vec3 N, int wanted) {
    PointCloud::Near near[kMostPhotons];
    size_t most = size_t(std::clamp(wanted, 1, int(kMostPhotons)));
    size_t count = cloud.nearest(P, N, {near, most});
    if (count == 0 || offset < 0) return vec3(0.0f);
    vec3 sum(0.0f);
    for (size_t i = 0; i < count; ++i) {
        const float* power = cloud.file.point(near[i].point) + offset;
        sum += vec3(power[0], power[1], power[2]);
    }
    float area = float(kPi) * near[count - 1].distance2;
    return area > 0 ? sum / area : vec3(0.0f);
}

}  // namespace

void look_up_points(const Scene& scene, const Pose& pose, const jit::ServiceCall& call) {
    Rows rows{call};
    ToWorld to_world(pose);
    for (int lane = 0; lane < jit::kMaxLanes; ++lane) {
        call.results[lane] = jit::float_of(0);
        for (int k = 0; k < rsl::kPointFloats; ++k)
            call.results[(1 + k) * jit::kMaxLanes + lane] = 0;
        if (!(call.mask >> lane & 1)) continue;
        PointStore::Lookup found = scene.points->find(rows.integer(0, lane), rows.integer(1, lane));
        if (!found.cloud) continue;
        vec3 P = rows.triple(2, lane), N = rows.triple(5, lane);
        bool as_is = rows.number(8, lane) < 0;
        Mean mean(*found.cloud, as_is ? P : to_world.position(P),
                  as_is ? N : to_world.direction(N));
        if (mean.count == 0) continue;
        int32_t known = 0;
        int next = 1;
        for (size_t c = 0; c < found.channels.size(); ++c) {
            const PointStore::Channel& channel = found.channels[c];
            if (channel.offset >= 0) known |= int32_t(1u << c);
            for (int k = 0; k < channel.components; ++k, ++next)
                if (channel.offset >= 0)
                    call.results[next * jit::kMaxLanes + lane] = mean.number(channel.offset + k);
        }
        call.results[lane] = jit::float_of(known);
    }
}

void look_up_photons(const Scene& scene, const Pose& pose, const jit::ServiceCall& call) {
    static const int32_t kPower = rsl::intern("color power");
    static const int32_t kDiffusion = rsl::intern("color _ssdiffusion,color _radiance_t");
    Rows rows{call};
    ToWorld to_world(pose);
    for (int lane = 0; lane < jit::kMaxLanes; ++lane) {
        vec3 light(0.0f);
        int32_t file = rows.integer(0, lane);
        if ((call.mask >> lane & 1) && file != 0) {
            auto kind = rsl::PhotonKind(rows.integer(1, lane));
            bool scattered = kind == rsl::PhotonKind::Subsurface;
            PointStore::Lookup found = scene.points->find(file, scattered ? kDiffusion : kPower);
            vec3 P = to_world.position(rows.triple(3, lane));
            vec3 N = to_world.direction(rows.triple(6, lane));
            if (found.cloud && scattered) {
                int offset = found.channels[0].offset >= 0 ? found.channels[0].offset
                                                           : found.channels[1].offset;
                Mean mean(*found.cloud, P, N);
                for (int k = 0; k < 3 && offset >= 0; ++k) light[k] = mean.number(offset + k);
            } else if (found.cloud) {
                light = photon_density(*found.cloud, found.channels[0].offset, P, N,
                                       rows.integer(2, lane));
            }
        }
        for (int k = 0; k < 3; ++k) call.results[k * jit::kMaxLanes + lane] = light[k];
    }
}

// ---- writing ------------------------------------------------------------------------------------

void Bakes::begin_frame(size_t threads) {
    points_.resize(std::max(points_.size(), threads));
}

// One point a pixel: what its first sample sees, through transparent layers too. Rays that shaders
// shoot bake nothing.
void Bakes::add(const Grid& grid, const jit::ServiceCall& call) {
    enum { File = 0, Channels, P = 3, N = 6, Radius = 9, Scale, Numbers };
    if (grid.depth > 0 || !grid.shadows) return;
    std::vector<BakedPoint>& points = points_[grid.memory.number];
    Rows rows{call};
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
        auto [path, outside] = scene_.description->writable.find(name);
        std::string error =
            outside ? "it lies outside the scene's folder (--allow-external DIR lets it be written)"
                    : write_point_file(path, joined({all.data() + begin, end - begin}));
        if (!error.empty()) diagnostics.report(Code::FRAME_UNWRITABLE, Location{}, path, error);
        scene_.points->forget(name);
        begin = end;
    }
    for (auto& points : points_) points.clear();
    for (auto& [path, error] : scene_.points->take_errors())
        if (reported_.insert(path).second)
            diagnostics.report(Code::POINT_FILE_UNREADABLE, Location{}, path, error);
}

}  // namespace kinora

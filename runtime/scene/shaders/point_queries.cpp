// runtime/scene/shaders/point_queries.cpp: texture3d and photon maps.
#include "runtime/scene/shaders/point_queries.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "rsl/model/renderer_services.h"
#include "runtime/scene/images/point_store.h"
#include "runtime/scene/pose.h"

namespace kinora {

ToWorld::ToWorld(const Pose& pose)
    : point(glm::inverse(pose.view.camera_from_world)),
      normal(glm::transpose(dmat3(pose.view.camera_from_world))) {}

vec3 ToWorld::position(vec3 P) const {
    return vec3(dvec3(point * dvec4(dvec3(P), 1.0)));
}

vec3 ToWorld::direction(vec3 N) const {
    dvec3 n = normal * dvec3(N);
    double length = glm::length(n);
    return length > 0 ? vec3(n / length) : vec3(0.0f);
}

namespace {

constexpr size_t kNeighbours = 8, kMostPhotons = 64;

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

void look_up_points(PointStore& store, const Pose& pose, const jit::ServiceCall& call) {
    ArgumentRows rows{call};
    ToWorld to_world(pose);
    for (int lane = 0; lane < jit::kMaxLanes; ++lane) {
        call.results[lane] = jit::float_of(0);
        for (int k = 0; k < rsl::kPointFloats; ++k)
            call.results[(1 + k) * jit::kMaxLanes + lane] = 0;
        if (!(call.mask >> lane & 1)) continue;
        PointStore::Lookup found = store.find(rows.integer(0, lane), rows.integer(1, lane));
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

void look_up_photons(PointStore& store, const Pose& pose, const jit::ServiceCall& call) {
    static const int32_t kPower = rsl::intern("color power");
    static const int32_t kDiffusion = rsl::intern("color _ssdiffusion,color _radiance_t");
    ArgumentRows rows{call};
    ToWorld to_world(pose);
    for (int lane = 0; lane < jit::kMaxLanes; ++lane) {
        vec3 light(0.0f);
        int32_t file = rows.integer(0, lane);
        if ((call.mask >> lane & 1) && file != 0) {
            auto kind = rsl::PhotonKind(rows.integer(1, lane));
            bool scattered = kind == rsl::PhotonKind::Subsurface;
            PointStore::Lookup found = store.find(file, scattered ? kDiffusion : kPower);
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

}  // namespace kinora

// runtime/scene/shaders/point_queries.h: point files as shaders read them: the services texture3d
// and photons. Also what reads and writes of them share.
#pragma once

#include "jit/ir/kernel_call.h"
#include "runtime/base/math.h"

namespace kinora {

class PointStore;  // runtime/scene/images/point_store.h
struct Pose;

// World space, as the files have it, from "current" space.
struct ToWorld {
    dmat4 point;
    dmat3 normal;  // of normals: the transpose of camera_from_world
    explicit ToWorld(const Pose& pose);
    vec3 position(vec3 P) const;
    vec3 direction(vec3 N) const;  // length 1, or 0
};

// The arguments of a call, by row and lane.
struct ArgumentRows {
    const jit::ServiceCall& call;
    float number(int row, int lane) const { return call.args[row * jit::kMaxLanes + lane]; }
    int32_t integer(int row, int lane) const { return jit::bits_of(number(row, lane)); }
    vec3 triple(int row, int lane) const {
        return {number(row, lane), number(row + 1, lane), number(row + 2, lane)};
    }
};

// Values near P: the mean of up to 8 of the file's points with normals to P's side, weighed by
// (1 - distance / that of the farthest)^2; exactly a point's own where P is that point.
void look_up_points(PointStore& store, const Pose& pose, const jit::ServiceCall& call);

// PhotonKind::Map and Caustic: the power of the nearest photons by the area of the disc that holds
// them (H. W. Jensen, Realistic Image Synthesis Using Photon Mapping, 2001, eq. 7.6), channel
// "power". Subsurface: as texture3d of "_ssdiffusion", else of "_radiance_t".
void look_up_photons(PointStore& store, const Pose& pose, const jit::ServiceCall& call);

}  // namespace kinora

// tests/raytrace/meshes.h: meshes, rays and little helpers for the ray tracer's tests and benches.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "raytrace/accel.h"

namespace kinora::raytrace::test {

inline constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
inline constexpr float kInf = std::numeric_limits<float>::infinity();

struct TestMesh {
    std::vector<vec4> positions;
    std::vector<uint32_t> triangles;

    Geometry geometry(uint32_t id, GeometryKind kind = GeometryKind::Static) const {
        Geometry g;
        g.id = id;
        g.kind = kind;
        g.positions = positions;
        g.triangles = triangles;
        return g;
    }
};

// A closed sphere of 2 * across * (down - 1) triangles, wound anticlockwise from outside.
inline TestMesh sphere(double radius, dvec3 center, int across = 32, int down = 16) {
    TestMesh m;
    auto add = [&](double theta, double phi) {
        dvec3 p = center + radius * dvec3(std::sin(theta) * std::cos(phi),
                                          std::sin(theta) * std::sin(phi), std::cos(theta));
        m.positions.push_back(vec4(vec3(p), 0.0f));
    };
    add(0, 0);
    for (int j = 1; j < down; ++j)
        for (int i = 0; i < across; ++i) add(kPi * j / down, 2 * kPi * i / across);
    add(kPi, 0);
    auto at = [&](int j, int i) { return uint32_t(1 + (j - 1) * across + i % across); };
    const uint32_t south = uint32_t(m.positions.size() - 1);
    for (int i = 0; i < across; ++i) {
        for (uint32_t k : {0u, at(1, i), at(1, i + 1)}) m.triangles.push_back(k);
        for (int j = 1; j + 1 < down; ++j)
            for (uint32_t k : {at(j, i), at(j + 1, i), at(j + 1, i + 1), at(j, i), at(j + 1, i + 1),
                               at(j, i + 1)})
                m.triangles.push_back(k);
        for (uint32_t k : {at(down - 1, i), south, at(down - 1, i + 1)}) m.triangles.push_back(k);
    }
    return m;
}

// A tube along z from -2 to 2 around the z axis: 2 * across * along triangles.
inline TestMesh tube(int across, int along, double radius = 0.5) {
    TestMesh m;
    for (int j = 0; j <= along; ++j)
        for (int i = 0; i < across; ++i) {
            double phi = 2 * kPi * i / across;
            m.positions.push_back(vec4(float(radius * std::cos(phi)), float(radius * std::sin(phi)),
                                       float(-2.0 + 4.0 * j / along), 0));
        }
    auto at = [&](int j, int i) { return uint32_t(j * across + i % across); };
    for (int j = 0; j < along; ++j)
        for (int i = 0; i < across; ++i)
            for (uint32_t k : {at(j, i), at(j, i + 1), at(j + 1, i + 1), at(j, i), at(j + 1, i + 1),
                               at(j + 1, i)})
                m.triangles.push_back(k);
    return m;
}

// The tube's vertices bent by `angle` over its length, as a skin would.
inline void bend(const TestMesh& rest, double angle, std::vector<vec4>& out) {
    out.resize(rest.positions.size());
    for (size_t i = 0; i < out.size(); ++i) {
        const vec4& p = rest.positions[i];
        double a = angle * (double(p.z) + 2) / 4;
        out[i] = vec4(p.x, float(std::cos(a) * p.y - std::sin(a) * p.z),
                      float(std::sin(a) * p.y + std::cos(a) * p.z), 0);
    }
}

// Triangles strewn over a box of half width `spread`.
inline TestMesh soup(size_t count, double spread, double size, uint32_t seed) {
    TestMesh m;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    auto point = [&] { return dvec3(uniform(random), uniform(random), uniform(random)); };
    for (size_t i = 0; i < count; ++i) {
        dvec3 center = spread * point();
        for (int k = 0; k < 3; ++k) {
            m.triangles.push_back(uint32_t(m.positions.size()));
            m.positions.push_back(vec4(vec3(center + size * point()), 0.0f));
        }
    }
    return m;
}

inline void set_lane(RayPacket16& packet, int lane, vec3 org, vec3 dir, float tnear = 0,
                     float tfar = std::numeric_limits<float>::infinity(),
                     uint32_t mask = kMaskAll) {
    packet.org_x[lane] = org.x, packet.org_y[lane] = org.y, packet.org_z[lane] = org.z;
    packet.dir_x[lane] = dir.x, packet.dir_y[lane] = dir.y, packet.dir_z[lane] = dir.z;
    packet.tnear[lane] = tnear, packet.tfar[lane] = tfar;
    packet.mask[lane] = mask, packet.time[lane] = 0;
}

struct OneHit {
    bool hit = false;
    uint32_t geometry = kNone, instance = kNone, primitive = kNone;
    float u = 0, v = 0, t = 0;
    vec3 Ng{0.0f};
};

inline OneHit shoot(const Accel& accel, vec3 org, vec3 dir, float tnear = 0,
                    float tfar = std::numeric_limits<float>::infinity(), uint32_t mask = kMaskAll) {
    RayPacket16 packet{};
    packet.active = 1;
    set_lane(packet, 0, org, dir, tnear, tfar, mask);
    HitPacket16 hits;
    TraceCounters counters;
    if (!accel.intersect16(packet, hits, counters)) return {};
    return {
        true,      hits.geometry[0], hits.instance[0], hits.primitive[0],
        hits.u[0], hits.v[0],        hits.t[0],        {hits.Ng_x[0], hits.Ng_y[0], hits.Ng_z[0]}};
}

// Rays from a sphere of `radius` around `center` through random points near the middle.
struct RandomRays {
    std::mt19937 random;
    explicit RandomRays(uint32_t seed) : random(seed) {}
    dvec3 point() {
        std::uniform_real_distribution<double> uniform(-1, 1);
        return {uniform(random), uniform(random), uniform(random)};
    }
    dvec3 direction() {
        for (;;) {
            dvec3 p = point();
            double n = p.x * p.x + p.y * p.y + p.z * p.z;
            if (n > 1e-3 && n < 1) return p / std::sqrt(n);
        }
    }
    void next(double radius, dvec3 center, vec3& org, vec3& dir) {
        dvec3 from = center + radius * direction();
        dvec3 to = center + 0.4 * radius * point();
        org = vec3(from);
        dvec3 d = to - dvec3(org);
        dir = vec3(d / std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z));
    }
};

}  // namespace kinora::raytrace::test

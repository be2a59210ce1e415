// runtime/play/guide.cpp: first hits of all pixels, and joint bilateral enlargement by them.
//
// J. Kopf, M. Cohen, D. Lischinski, M. Uyttendaele, Joint Bilateral Upsampling, 2007.
#include "runtime/play/guide.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "runtime/base/parallel.h"

namespace kinora {

namespace {

using raytrace::kPacket;

struct Centers {
    const raytrace::Camera& camera;  // of the picture's size
    size_t width;

    dvec2 of(size_t pixel) const {
        return {double(pixel % width) + 0.5, double(pixel / width) + 0.5};
    }
};

void trace_packet(const Scene& scene, const Centers& centers, size_t first, size_t count,
                  PictureGuide& guide, raytrace::TraceCounters& counters) {
    raytrace::RayPacket16 rays{};
    raytrace::HitPacket16 hits;
    rays.coherent = true;
    rays.active = uint32_t((1u << count) - 1);
    for (size_t k = 0; k < count; ++k) {
        dvec2 at = centers.of(first + k);
        raytrace::CameraRay ray = raytrace::camera_ray(centers.camera, at.x, at.y);
        rays.org_x[k] = ray.org.x, rays.org_y[k] = ray.org.y, rays.org_z[k] = ray.org.z;
        rays.dir_x[k] = ray.dir.x, rays.dir_y[k] = ray.dir.y, rays.dir_z[k] = ray.dir.z;
        rays.tnear[k] = ray.tnear;
        rays.tfar[k] = ray.tfar;
        rays.mask[k] = raytrace::kMaskAll | raytrace::kMaskCamera;
        rays.time[k] = 0;
    }
    uint32_t hit = scene.accel.intersect16(rays, hits, counters);
    vec3 forward(centers.camera.forward);
    for (size_t k = 0; k < count; ++k) {
        size_t pixel = first + k;
        if ((hit >> k & 1) == 0) {
            guide.surface[pixel] = kNone;
            guide.Ng[pixel] = vec3(0.0f);
            guide.depth[pixel] = 0;
            continue;
        }
        vec3 direction(rays.dir_x[k], rays.dir_y[k], rays.dir_z[k]);
        vec3 Ng(hits.Ng_x[k], hits.Ng_y[k], hits.Ng_z[k]);
        float length = glm::length(Ng);
        if (length > 0) Ng /= length;
        guide.surface[pixel] = hits.instance[k];
        guide.Ng[pixel] = glm::dot(Ng, direction) > 0 ? -Ng : Ng;
        guide.depth[pixel] = hits.t[k] * glm::dot(direction, forward);
    }
}

// What the guide says at one place.
struct Place {
    uint32_t surface;
    vec3 Ng;
    float depth;
};

// How much one place says about another.
float likeness(const Place& a, const Place& b) {
    constexpr float kOther = 1e-4f;
    if (a.surface != b.surface) return kOther;
    if (a.surface == kNone) return 1;
    float facing = std::max(glm::dot(a.Ng, b.Ng), 0.0f);
    facing *= facing;
    facing *= facing;
    float apart = std::abs(a.depth - b.depth) / std::max(std::abs(a.depth), 1e-30f);
    return std::max(facing * facing / (1 + 400 * apart * apart), kOther);
}

// A guide of the picture's size, or of half of it in both directions.
struct Places {
    const PictureGuide& guide;
    int width, height;  // of the guide
    int step;           // pixels of the picture in one of the guide

    Places(const PictureGuide& of, int picture_width, int picture_height) : guide(of) {
        bool whole = of.surface.size() == size_t(picture_width) * size_t(picture_height);
        step = whole ? 1 : 2;
        width = (picture_width + step - 1) / step;
        height = (picture_height + step - 1) / step;
    }
    Place at(int x, int y) const {
        size_t k = size_t(y / step) * size_t(width) + size_t(x / step);
        return {guide.surface[k], guide.Ng[k], guide.depth[k]};
    }
};

// The two small pixels beside a large one's center in one direction, and their shares.
struct Neighbors {
    int index[2];
    float share[2];
};

std::vector<Neighbors> neighbors(int small, int large) {
    std::vector<Neighbors> out(static_cast<size_t>(large));
    for (int x = 0; x < large; ++x) {
        double at = (x + 0.5) * small / large - 0.5;
        int first = int(std::floor(at));
        Neighbors& n = out[size_t(x)];
        for (int k = 0; k < 2; ++k) {
            n.index[k] = std::clamp(first + k, 0, small - 1);
            n.share[k] = float(1 - std::abs(at - (first + k)));
        }
    }
    return out;
}

}  // namespace

void make_guide(const Scene& scene, int width, int height, PictureGuide& guide) {
    size_t pixels = size_t(width) * size_t(height);
    guide.surface.resize(pixels);
    guide.Ng.resize(pixels);
    guide.depth.resize(pixels);
    raytrace::Camera camera = scene.view;
    // The same window in other pixels.
    camera.raster_dx *= double(camera.width) / width;
    camera.raster_dy *= double(camera.height) / height;
    camera.width = width;
    camera.height = height;
    Centers centers{camera, size_t(width)};
    constexpr size_t kPackets = 64;  // a task
    size_t packets = (pixels + kPacket - 1) / kPacket;
    parallel_for(0, packets, kPackets, [&](size_t begin, size_t end) {
        raytrace::TraceCounters counters;
        for (size_t packet = begin; packet < end; ++packet) {
            size_t first = packet * kPacket;
            trace_packet(scene, centers, first, std::min<size_t>(kPacket, pixels - first), guide,
                         counters);
        }
    });
}

void enlarge(const raytrace::Film& small, const PictureGuide& guide, int width, int height,
             raytrace::Film& out) {
    if (out.width != width || out.height != height) out.resize(width, height);
    Places places(guide, width, height);
    // At the small pixels' centers.
    std::vector<Place> centers(small.rgba.size());
    for (int y = 0; y < small.height; ++y)
        for (int x = 0; x < small.width; ++x)
            centers[size_t(y) * size_t(small.width) + size_t(x)] =
                places.at(std::min(int((x + 0.5) * width / small.width), width - 1),
                          std::min(int((y + 0.5) * height / small.height), height - 1));
    std::vector<Neighbors> columns = neighbors(small.width, width);
    std::vector<Neighbors> rows = neighbors(small.height, height);
    auto row = [&](int y) {
        const Neighbors& v = rows[size_t(y)];
        for (int x = 0; x < width; ++x) {
            const Neighbors& h = columns[size_t(x)];
            Place here = places.at(x, y);
            vec4 sum(0.0f);
            float weights = 0;
            for (int k = 0; k < 4; ++k) {
                size_t from =
                    size_t(v.index[k >> 1]) * size_t(small.width) + size_t(h.index[k & 1]);
                float weight =
                    (h.share[k & 1] * v.share[k >> 1] + 1e-3f) * likeness(here, centers[from]);
                sum += weight * small.rgba[from];
                weights += weight;
            }
            out.rgba[size_t(y) * size_t(width) + size_t(x)] = sum / weights;
        }
    };
    parallel_for(0, size_t(height), 16, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y) row(int(y));
    });
}

}  // namespace kinora

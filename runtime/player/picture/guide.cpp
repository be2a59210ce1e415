// runtime/player/picture/guide.cpp: first hits of all pixels, and joint bilateral enlargement by
// them.
//
// J. Kopf, M. Cohen, D. Lischinski, M. Uyttendaele, Joint Bilateral Upsampling, 2007.
#include "runtime/player/picture/guide.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <numeric>
#include <span>
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

void trace_packet(const Pose& pose, const Centers& centers, std::span<const uint32_t> pixels,
                  PictureGuide& guide, raytrace::TraceCounters& counters) {
    const size_t count = pixels.size();
    raytrace::RayPacket16 rays{};
    raytrace::HitPacket16 hits;
    rays.coherent = true;
    rays.active = uint32_t((1u << count) - 1);
    for (size_t k = 0; k < count; ++k) {
        dvec2 at = centers.of(pixels[k]);
        raytrace::CameraRay ray = raytrace::camera_ray(centers.camera, at.x, at.y);
        rays.org_x[k] = ray.org.x, rays.org_y[k] = ray.org.y, rays.org_z[k] = ray.org.z;
        rays.dir_x[k] = ray.dir.x, rays.dir_y[k] = ray.dir.y, rays.dir_z[k] = ray.dir.z;
        rays.tnear[k] = ray.tnear;
        rays.tfar[k] = ray.tfar;
        rays.mask[k] = raytrace::kMaskEye;
        rays.time[k] = 0;
    }
    uint32_t hit = pose.accel.intersect16(rays, hits, counters);
    vec3 forward(centers.camera.forward);
    for (size_t k = 0; k < count; ++k) {
        const size_t pixel = pixels[k];
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

using FourFloats = float __attribute__((vector_size(16)));

FourFloats load(const vec4& from) {
    FourFloats to;
    std::memcpy(&to, &from, sizeof(to));
    return to;
}

constexpr float kOther = 1e-4f;
constexpr float kApart = 400;  // one over the square of the share of a depth

// How much four places say about another: next to nothing on another surface; less where they face
// elsewhere or lie at another depth.
FourFloats likeness(const Place& here, const Place* const (&others)[4]) {
    // A loop would write them to memory one by one.
    const auto of_four = [&](auto&& of) {
        return FourFloats{of(*others[0]), of(*others[1]), of(*others[2]), of(*others[3])};
    };
    const FourFloats is_same =
        of_four([&](const Place& other) { return other.surface == here.surface ? 1.0f : 0.0f; });
    if (here.surface == kNone) return is_same + kOther;
    FourFloats facing = of_four([&](const Place& other) { return glm::dot(here.Ng, other.Ng); });
    FourFloats apart = of_four([&](const Place& other) { return here.depth - other.depth; });
    facing = facing > 0 ? facing : FourFloats{};
    facing *= facing;
    facing *= facing;
    apart *= 1 / std::max(std::abs(here.depth), 1e-30f);
    return is_same * facing * facing / (1 + kApart * apart * apart) + kOther;
}

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

// The cell of a row of `count` that lies at each pixel of a row of `pixels`.
std::vector<int> cells(int count, int pixels) {
    std::vector<int> out(static_cast<size_t>(pixels));
    for (int x = 0; x < pixels; ++x)
        out[size_t(x)] = std::min(int((x + 0.5) * count / pixels), count - 1);
    return out;
}

Place place_at(const PictureGuide& guide, int x, int y) {
    const size_t k = size_t(y) * size_t(guide.width) + size_t(x);
    return {guide.surface[k], guide.Ng[k], guide.depth[k]};
}

constexpr float kAlike = 0.8f;   // facing one way within 19 degrees: the guide would decide little
constexpr float kNoEdge = 0.3f;  // on one surface, at least

// Whether that likeness exceeds `much`, which is far more than kOther; without quotients.
bool is_alike(float much, const Place& a, const Place& b) {
    if (a.surface != b.surface) return false;
    if (a.surface == kNone) return true;
    float facing = std::max(glm::dot(a.Ng, b.Ng), 0.0f);
    facing *= facing;
    facing *= facing;
    const float depth = std::max(std::abs(a.depth), 1e-15f), apart = a.depth - b.depth;
    return facing * facing * depth * depth > much * (depth * depth + kApart * apart * apart);
}

// Whether a pixel is that much like its right neighbor and the two below.
bool are_alike(float much, const Place& here, const Place& right, const Place& below,
               const Place& both) {
    return is_alike(much, here, right) && is_alike(much, here, below) && is_alike(much, here, both);
}

template <class Body>
void each_row(int rows, Body&& body) {
    parallel_for(0, size_t(rows), 16, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y) body(int(y));
    });
}

// Of each pixel of a guide: whether an edge may lie within a pixel of its center, as one does where
// a pixel is unlike its right neighbor or the two below.
std::vector<uint8_t> beside_edges(const PictureGuide& guide) {
    std::vector<uint8_t> unlike(guide.surface.size()), edges(guide.surface.size());
    const auto at = [&](int x, int y) { return size_t(y) * size_t(guide.width) + size_t(x); };
    each_row(guide.height, [&](int y) {
        const int below = std::min(y + 1, guide.height - 1);
        for (int x = 0; x < guide.width; ++x) {
            const int right = std::min(x + 1, guide.width - 1);
            unlike[at(x, y)] = !are_alike(kNoEdge, place_at(guide, x, y), place_at(guide, right, y),
                                          place_at(guide, x, below), place_at(guide, right, below));
        }
    });
    each_row(guide.height, [&](int y) {
        const int above = std::max(y - 1, 0);
        for (int x = 0; x < guide.width; ++x) {
            const int left = std::max(x - 1, 0);
            edges[at(x, y)] = unlike[at(x, y)] | unlike[at(left, y)] | unlike[at(x, above)] |
                              unlike[at(left, above)];
        }
    });
    return edges;
}

// The same window in other pixels.
raytrace::Camera camera_of(const Pose& pose, int width, int height) {
    raytrace::Camera camera = pose.view;
    camera.raster_dx *= double(camera.width) / width;
    camera.raster_dy *= double(camera.height) / height;
    camera.axis *= dvec2(width, height) / dvec2(camera.width, camera.height);
    camera.width = width;
    camera.height = height;
    return camera;
}

// One picture made of a smaller one.
class Enlargement {
  public:
    Enlargement(const raytrace::Film& small, const PictureGuide& guide, int width, int height)
        : small_(small),
          guide_(guide),
          columns_(neighbors(small.width, width)),
          rows_(neighbors(small.height, height)),
          guide_columns_(cells(guide.width, width)),
          guide_rows_(cells(guide.height, height)),
          centers_(small.rgba.size()),
          alike_(small.rgba.size()) {
        const std::vector<int> x_of = cells(guide.width, small.width),
                               y_of = cells(guide.height, small.height);
        each_row(small.height, [&](int y) {
            for (int x = 0; x < small.width; ++x)
                centers_[at(x, y)] = place_at(guide, x_of[size_t(x)], y_of[size_t(y)]);
        });
        each_row(small.height, [&](int y) { find_alike(y); });
    }

    void run(TakeRow take) {
        parallel_for(0, rows_.size(), 16, [&](size_t begin, size_t end) {
            std::vector<vec4> mixed(static_cast<size_t>(small_.width)), out(columns_.size());
            for (size_t y = begin; y < end; ++y) {
                row(int(y), mixed, out);
                take(int(y), out);
            }
        });
    }

  private:
    size_t at(int x, int y) const { return size_t(y) * size_t(small_.width) + size_t(x); }

    void find_alike(int y) {
        const int below = std::min(y + 1, small_.height - 1);
        for (int x = 0; x < small_.width; ++x) {
            const int right = std::min(x + 1, small_.width - 1);
            alike_[at(x, y)] = are_alike(kAlike, centers_[at(x, y)], centers_[at(right, y)],
                                         centers_[at(x, below)], centers_[at(right, below)]);
        }
    }

    // `mixed`: the two small rows beside this one, by their shares.
    void row(int y, std::vector<vec4>& mixed, std::vector<vec4>& out) const {
        const Neighbors& v = rows_[size_t(y)];
        const size_t above = at(0, v.index[0]), below = at(0, v.index[1]);
        for (size_t x = 0; x < mixed.size(); ++x) {
            const FourFloats sum = v.share[0] * load(small_.rgba[above + x]) +
                                   v.share[1] * load(small_.rgba[below + x]);
            std::memcpy(&mixed[x], &sum, sizeof(sum));
        }
        for (size_t x = 0; x < out.size(); ++x) {
            const Neighbors& h = columns_[x];
            FourFloats sum = h.share[0] * load(mixed[size_t(h.index[0])]) +
                             h.share[1] * load(mixed[size_t(h.index[1])]);
            if (!alike_[above + size_t(h.index[0])]) sum = weighed(int(x), y);
            std::memcpy(&out[x], &sum, sizeof(sum));
        }
    }

    // Where the guide has edges.
    FourFloats weighed(int x, int y) const {
        const Neighbors &h = columns_[size_t(x)], &v = rows_[size_t(y)];
        const size_t from[4] = {at(h.index[0], v.index[0]), at(h.index[1], v.index[0]),
                                at(h.index[0], v.index[1]), at(h.index[1], v.index[1])};
        const FourFloats share = {h.share[0] * v.share[0], h.share[1] * v.share[0],
                                  h.share[0] * v.share[1], h.share[1] * v.share[1]};
        const Place here = place_at(guide_, guide_columns_[size_t(x)], guide_rows_[size_t(y)]);
        const Place* const places[4] = {&centers_[from[0]], &centers_[from[1]], &centers_[from[2]],
                                        &centers_[from[3]]};
        const FourFloats weight = (share + 1e-3f) * likeness(here, places);
        const FourFloats sum =
            weight[0] * load(small_.rgba[from[0]]) + weight[1] * load(small_.rgba[from[1]]) +
            weight[2] * load(small_.rgba[from[2]]) + weight[3] * load(small_.rgba[from[3]]);
        return sum / (weight[0] + weight[1] + weight[2] + weight[3]);
    }

    const raytrace::Film& small_;
    const PictureGuide& guide_;
    std::vector<Neighbors> columns_, rows_;
    std::vector<int> guide_columns_, guide_rows_;
    std::vector<Place> centers_;  // at the small pixels' centers
    std::vector<uint8_t> alike_;
};

}  // namespace

void make_guide(const Pose& pose, int width, int height, PictureGuide& guide) {
    size_t pixels = size_t(width) * size_t(height);
    guide.resize(width, height);
    const raytrace::Camera camera = camera_of(pose, width, height);
    Centers centers{camera, size_t(width)};
    constexpr size_t kPackets = 64;  // a task
    size_t packets = (pixels + kPacket - 1) / kPacket;
    parallel_for(0, packets, kPackets, [&](size_t begin, size_t end) {
        raytrace::TraceCounters counters;
        for (size_t packet = begin; packet < end; ++packet) {
            std::array<uint32_t, kPacket> some;
            std::iota(some.begin(), some.end(), uint32_t(packet * kPacket));
            const size_t count = std::min<size_t>(kPacket, pixels - packet * kPacket);
            trace_packet(pose, centers, std::span(some).first(count), guide, counters);
        }
    });
}

void refine_guide(const Pose& pose, const PictureGuide& small, int width, int height,
                  PictureGuide& guide) {
    guide.resize(width, height);
    const raytrace::Camera camera = camera_of(pose, width, height);
    const Centers centers{camera, size_t(width)};
    const std::vector<uint8_t> edges = beside_edges(small);
    const std::vector<int> columns = cells(small.width, width), rows = cells(small.height, height);
    // By squares, so that the rays of a packet run side by side.
    constexpr size_t kSide = 8;
    const auto beside = [&](size_t side, size_t length, auto&& body) {
        for (size_t at = side * kSide; at < std::min((side + 1) * kSide, length); ++at) body(at);
    };
    const size_t across = (size_t(width) + kSide - 1) / kSide,
                 down = (size_t(height) + kSide - 1) / kSide;
    parallel_for(0, down, 1, [&](size_t begin, size_t end) {
        raytrace::TraceCounters counters;
        std::array<uint32_t, kPacket> some;
        size_t count = 0;
        const auto refine = [&](size_t x, size_t y) {
            const size_t pixel = y * size_t(width) + x,
                         from = size_t(rows[y]) * size_t(small.width) + size_t(columns[x]);
            guide.surface[pixel] = small.surface[from];
            guide.Ng[pixel] = small.Ng[from];
            guide.depth[pixel] = small.depth[from];
            if (!edges[from]) return;
            some[count++] = uint32_t(pixel);
            if (count < kPacket) return;
            trace_packet(pose, centers, some, guide, counters);
            count = 0;
        };
        for (size_t square = begin * across; square < end * across; ++square)
            beside(square / across, size_t(height), [&](size_t y) {
                beside(square % across, size_t(width), [&](size_t x) { refine(x, y); });
            });
        if (count) trace_packet(pose, centers, std::span(some).first(count), guide, counters);
    });
}

void take_guide(const FirstHits& hits, const raytrace::Camera& camera, PictureGuide& guide) {
    guide.resize(hits.width, hits.height);
    const vec3 eye(camera.eye), forward(camera.forward);
    parallel_for(0, hits.surface.size(), 4096, [&](size_t begin, size_t end) {
        for (size_t k = begin; k < end; ++k) {
            guide.surface[k] = hits.surface[k];
            guide.Ng[k] = vec3(0.0f);
            guide.depth[k] = 0;
            if (hits.surface[k] == kNone) continue;
            const vec3 way = hits.P[k] - eye, Ng = hits.Ng[k];
            guide.Ng[k] = glm::dot(Ng, camera.orthographic ? forward : way) > 0 ? -Ng : Ng;
            guide.depth[k] = glm::dot(way, forward);
        }
    });
}

void enlarge_rows(const raytrace::Film& small, const PictureGuide& guide, int width, int height,
                  TakeRow take) {
    Enlargement(small, guide, width, height).run(take);
}

void enlarge(const raytrace::Film& small, const PictureGuide& guide, int width, int height,
             raytrace::Film& out) {
    if (out.width != width || out.height != height) out.resize(width, height);
    enlarge_rows(small, guide, width, height,
                 [&](int y, std::span<const vec4> row) { std::ranges::copy(row, &out.at(0, y)); });
}

}  // namespace kinora

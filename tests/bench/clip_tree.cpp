// tests/bench/clip_tree.cpp: from which pose should the tree of a deforming mesh be built?
//
//     build/release/bench/clip_tree SCENE [WIDTHxHEIGHT [FRAMES]]
//
// Renders frames of the clip on one thread and records their rays. Then each way of building a tree
// plays the clip: the tree is built once, refitted to every frame, and answers the recorded rays.
// Ways take turns at each frame; times are CPU time, the least of some runs, summed over the clip.
//
//   first      from the first frame, never built again
//   rest       from the vertices as the file has them
//   mean       from the mean of 16 poses
//   best of 16 from that of 16 poses whose own binary tree, refitted, has the least sum of box
//   areas
//              over the clip
//   as frames  as render_frame has it: from the rest pose, built again as AccelPolicy says
//   rebuild    built anew for each frame
#include <ctime>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "runtime/base/parallel.h"
#include "runtime/picture/frame/frame.h"
#include "runtime/scene/build/build_scene.h"
#include "runtime/scene/description/play_range.h"
#include "runtime/scene/load/import_scene.h"
#include "tests/bench/recorded_frame.h"

namespace kinora {
namespace {

using raytrace::Accel;
using raytrace::AccelPolicy;
using raytrace::Geometry;
using raytrace::GeometryKind;
using raytrace::RayPacket16;

constexpr int kRuns = 3;
constexpr size_t kPoses = 16;

double cpu_ms() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return double(t.tv_sec) * 1e3 + double(t.tv_nsec) * 1e-6;
}

// ---- the clip -----------------------------------------------------------------------------------

using Vertices = std::vector<std::vector<vec4>>;  // positions by row; of rows that deform

struct Frame {
    std::vector<Geometry> rows;
    Vertices pose;
    std::vector<RayPacket16> closest, any;
};

struct Clip {
    std::vector<Frame> frames;
    Vertices rest;
};

Vertices pose_of(const std::vector<Geometry>& rows) {
    Vertices pose(rows.size());
    for (size_t r = 0; r < rows.size(); ++r)
        if (rows[r].kind == GeometryKind::Deforming)
            pose[r].assign(rows[r].positions.begin(), rows[r].positions.end());
    return pose;
}

// Vertices as the file has them, in the mesh's space: a tree of them has the same triangles.
Vertices rest_of(const Scene& scene, const Vertices& like) {
    Vertices rest = like;
    for (size_t r = 0; r < like.size(); ++r) {
        const auto& mesh = scene.meshes[scene.shapes[scene.surfaces[r].shape].mesh].positions;
        if (!like[r].empty() && mesh.size() == like[r].size()) rest[r] = mesh;
    }
    return rest;
}

Clip play(const Scene& scene, kinora::Pose& pose, const FrameSettings& settings, double start,
          double end, size_t count) {
    Clip clip;
    Diagnostics diagnostics;
    raytrace::Film film;
    FrameStats stats;
    for (size_t f = 0; f < count; ++f) {
        const double time = start + (end - start) * double(f) / double(count - 1);
        RecordedRays rays;
        raytrace::record_packets(&rays);
        render_frame(scene, pose, time, settings, film, stats, diagnostics);
        raytrace::record_packets(nullptr);
        Frame& frame = clip.frames.emplace_back();
        frame.rows = pose.rows;
        frame.pose = pose_of(frame.rows);
        for (RayUse use : {RayUse::Camera, RayUse::Nested})
            for (const RayPacket16& p : rays.as_sent(use)) frame.closest.push_back(p);
        frame.any = rays.as_sent(RayUse::Shadow);
    }
    clip.rest = rest_of(scene, clip.frames.front().pose);
    return clip;
}

// ---- a tree of our own, to choose a pose by -----------------------------------------------------

struct Box {
    vec3 low{std::numeric_limits<float>::infinity()}, high{-low};
    void add(const vec4& p) {
        low = glm::min(low, vec3(p));
        high = glm::max(high, vec3(p));
    }
    void add(const Box& b) {
        low = glm::min(low, b.low);
        high = glm::max(high, b.high);
    }
    double area() const {
        const dvec3 e(high - low);
        return e.x * e.y + e.y * e.z + e.z * e.x;
    }
};

// Triangles halved at the median along the longest axis, down to four.
class BinaryTree {
  public:
    BinaryTree(std::span<const vec4> positions, std::span<const uint32_t> triangles)
        : triangles_(triangles), order_(triangles.size() / 3) {
        std::iota(order_.begin(), order_.end(), 0u);
        std::vector<vec3> middle(order_.size());
        for (size_t t = 0; t < middle.size(); ++t) {
            const Box b = box(positions, uint32_t(t));
            middle[t] = 0.5f * (b.low + b.high);
        }
        if (!order_.empty()) split(0, order_.size(), middle);
    }
    // Of all nodes' boxes around these vertices.
    double refitted(std::span<const vec4> positions) const {
        double sum = 0;
        if (!order_.empty()) refit(positions, 0, order_.size(), sum);
        return sum;
    }

  private:
    static constexpr size_t kLeaf = 4;
    Box box(std::span<const vec4> positions, uint32_t triangle) const {
        Box b;
        for (size_t k = 0; k < 3; ++k) b.add(positions[triangles_[3 * size_t(triangle) + k]]);
        return b;
    }
    void split(size_t begin, size_t end, const std::vector<vec3>& middle) {
        if (end - begin <= kLeaf) return;
        vec3 low = middle[order_[begin]], high = low;
        for (size_t i = begin; i < end; ++i) {
            low = glm::min(low, middle[order_[i]]);
            high = glm::max(high, middle[order_[i]]);
        }
        const vec3 size = high - low;
        const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
        const size_t half = (begin + end) / 2;
        std::nth_element(order_.begin() + ptrdiff_t(begin), order_.begin() + ptrdiff_t(half),
                         order_.begin() + ptrdiff_t(end),
                         [&](uint32_t a, uint32_t b) { return middle[a][axis] < middle[b][axis]; });
        split(begin, half, middle);
        split(half, end, middle);
    }
    Box refit(std::span<const vec4> positions, size_t begin, size_t end, double& sum) const {
        Box b;
        if (end - begin <= kLeaf) {
            for (size_t i = begin; i < end; ++i) b.add(box(positions, order_[i]));
        } else {
            const size_t half = (begin + end) / 2;
            b = refit(positions, begin, half, sum);
            b.add(refit(positions, half, end, sum));
        }
        sum += b.area();
        return b;
    }

    std::span<const uint32_t> triangles_;
    std::vector<uint32_t> order_;
};

// Of the trees of all rows, built from a pose, over the clip.
double refitted_areas(const Clip& clip, const Vertices& built) {
    double sum = 0;
    const std::vector<Geometry>& rows = clip.frames.front().rows;
    for (size_t r = 0; r < rows.size(); ++r) {
        if (built[r].empty()) continue;
        const BinaryTree tree(built[r], rows[r].triangles);
        for (const Frame& frame : clip.frames) sum += tree.refitted(frame.pose[r]);
    }
    return sum;
}

std::vector<size_t> sampled_frames(const Clip& clip) {
    std::vector<size_t> frames;
    const size_t count = std::min(kPoses, clip.frames.size());
    for (size_t k = 0; k < count; ++k) frames.push_back(k * (clip.frames.size() - 1) / (count - 1));
    return frames;
}

Vertices mean_of(const Clip& clip) {
    const std::vector<size_t> frames = sampled_frames(clip);
    Vertices mean = clip.frames.front().pose;
    for (size_t r = 0; r < mean.size(); ++r)
        for (size_t i = 0; i < mean[r].size(); ++i) {
            dvec4 sum(0.0);
            for (size_t f : frames) sum += dvec4(clip.frames[f].pose[r][i]);
            mean[r][i] = vec4(sum / double(frames.size()));
        }
    return mean;
}

const Vertices& best_of(const Clip& clip) {
    const Vertices* best = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (size_t f : sampled_frames(clip))
        if (const double sum = refitted_areas(clip, clip.frames[f].pose); sum < least)
            least = sum, best = &clip.frames[f].pose;
    return *best;
}

// ---- ways to build ------------------------------------------------------------------------------

class Way {
  public:
    Way(const char* called, const Clip& clip, const Vertices& built, const AccelPolicy& policy,
        bool as_frames)
        : name(called),
          areas(refitted_areas(clip, built)),
          as_frames_(as_frames),
          accel_(policy),
          rows_(clip.frames.front().rows),
          room_(built) {
        for (size_t r = 0; r < rows_.size(); ++r) enter(r, clip.frames.front().rows[r]);
        const double begin = cpu_ms();
        accel_.update(rows_);
        build = cpu_ms() - begin;
    }
    void play(const Frame& frame) {
        for (size_t r = 0; r < rows_.size(); ++r) {
            if (!room_[r].empty()) std::ranges::copy(frame.pose[r], room_[r].begin());
            enter(r, frame.rows[r]);
        }
        const double begin = cpu_ms();
        const raytrace::AccelUpdate& done = accel_.update(rows_);
        update += cpu_ms() - begin;
        rebuilds += done.rebuilds + done.low_rebuilds;
        trace += least_trace(frame);
    }

    const char* name;
    double areas, build = 0, update = 0, trace = 0;
    int rebuilds = 0;

  private:
    void enter(size_t r, const Geometry& as) {
        const uint32_t version = rows_[r].positions_version;
        rows_[r] = as;
        if (room_[r].empty()) return;
        if (!as_frames_) rows_[r].built_from = {};
        rows_[r].positions = room_[r];
        rows_[r].positions_version = version + 1;
    }
    double least_trace(const Frame& frame) {
        raytrace::HitPacket16 hits;
        raytrace::TraceCounters counters;
        double least = std::numeric_limits<double>::infinity();
        for (int run = 0; run < kRuns; ++run) {
            const double begin = cpu_ms();
            for (const RayPacket16& p : frame.closest) accel_.intersect16(p, hits, counters);
            for (const RayPacket16& p : frame.any) accel_.occluded16(p, counters);
            least = std::min(least, cpu_ms() - begin);
        }
        return least;
    }

    bool as_frames_;  // rows are those of the scene, whatever they are built from
    Accel accel_;
    std::vector<Geometry> rows_;
    Vertices room_;
};

int measure(const char* file, FrameSettings settings, size_t count) {
    set_thread_count(1);
    Diagnostics diagnostics;
    std::optional<SceneDescription> description = import_scene(file, {}, diagnostics);
    if (!description) {
        std::fprintf(stderr, "clip_tree: '%s' cannot be read\n", file);
        return 1;
    }
    const PlayRange range = play_range(*description);
    SceneOptions options;
    options.start_time = range.start;
    options.end_time = range.end;
    options.width = settings.width;
    options.height = settings.height;
    options.background_rebuilds = false;
    std::unique_ptr<Scene> scene = build_scene(
        std::make_shared<SceneDescription>(std::move(*description)), options, diagnostics);
    if (!scene) return 1;
    kinora::Pose pose(*scene);
    const Clip clip = play(*scene, pose, settings, range.start, range.end, count);
    size_t triangles = 0;
    for (const Geometry& row : clip.frames.front().rows)
        if (row.kind == GeometryKind::Deforming) triangles += row.triangles.size() / 3;
    if (triangles == 0) {
        std::fprintf(stderr, "clip_tree: nothing in '%s' deforms\n", file);
        return 1;
    }
    AccelPolicy once = accel_policy(options), anew = once;
    once.refit_limit = once.low_limit = std::numeric_limits<float>::infinity();
    anew.always_rebuild = true;
    const Vertices& first = clip.frames.front().pose;
    std::vector<std::unique_ptr<Way>> ways;
    auto add = [&](const char* name, const Vertices& built, const AccelPolicy& policy,
                   bool as_frames = false) {
        ways.push_back(std::make_unique<Way>(name, clip, built, policy, as_frames));
    };
    add("first", first, once);
    add("rest", clip.rest, once);
    add("mean", mean_of(clip), once);
    add("best of 16", best_of(clip), once);
    add("as frames", first, accel_policy(options), true);
    add("rebuild", first, anew);
    for (const Frame& frame : clip.frames)
        for (auto& way : ways) way->play(frame);
    std::printf("%s: %zu frames, %zu triangles that deform; ms over the clip\n", file, count,
                triangles);
    std::printf("%-11s %10s %9s %9s %9s %9s\n", "built from", "box areas", "trace", "update",
                "both", "rebuilds");
    for (const auto& way : ways)
        std::printf("%-11s %10.3f %9.2f %9.2f %9.2f %9d\n", way->name,
                    way->areas / ways.front()->areas, way->trace, way->update,
                    way->trace + way->update, way->rebuilds);
    return 0;
}

}  // namespace
}  // namespace kinora

int main(int argc, char** argv) {
    using namespace kinora;
    FrameSettings settings;
    settings.width = 320;
    settings.height = 180;
    settings.integrator.samples_per_pixel = 1;
    if (argc < 2 || argc > 4) {
        std::fprintf(stderr, "clip_tree SCENE [WIDTHxHEIGHT [FRAMES]]\n");
        return 2;
    }
    if (argc > 2 && std::sscanf(argv[2], "%dx%d", &settings.width, &settings.height) != 2) {
        std::fprintf(stderr, "clip_tree: the size is WIDTHxHEIGHT, not '%s'\n", argv[2]);
        return 2;
    }
    const int frames = argc > 3 ? std::atoi(argv[3]) : 24;
    if (frames < 2) {
        std::fprintf(stderr, "clip_tree: a clip has at least 2 frames, not '%s'\n", argv[3]);
        return 2;
    }
    return measure(argv[1], settings, size_t(frames));
}

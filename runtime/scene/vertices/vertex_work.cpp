// runtime/scene/vertices/vertex_work.cpp: welding, running and averaging of vertex kernels.
#include "runtime/scene/vertices/vertex_work.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>

#include "rsl/model/kernel_keys.h"
#include "runtime/base/memory/pages.h"
#include "runtime/base/parallel.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/scene.h"
#include "runtime/scene/shaders/scene_host.h"
#include "runtime/scene/vertices/vertex_columns_p.h"
#include "runtime/scene/vertices/weld.h"

namespace kinora {

namespace {

constexpr size_t kPart = 1024;  // wedges a kernel runs on at once
constexpr size_t kGrain = 4096;

// Lists from the key of each item.
Lists make_lists(std::span<const uint32_t> key_of_item, size_t keys) {
    Lists lists;
    resize_pages(lists.first, keys + 1);
    for (uint32_t key : key_of_item) ++lists.first[key + 1];
    for (size_t k = 0; k < keys; ++k) lists.first[k + 1] += lists.first[k];
    resize_pages(lists.items, key_of_item.size());
    // first[k] serves as the place of the next, and is first[k + 1] then.
    for (uint32_t i = 0; i < key_of_item.size(); ++i)
        lists.items[lists.first[key_of_item[i]]++] = i;
    std::shift_right(lists.first.begin(), lists.first.end(), 1);
    lists.first[0] = 0;
    return lists;
}

// The rotation that takes direction a to direction b, applied to n.
vec3 turned(vec3 n, vec3 a, vec3 b) {
    float scale = std::sqrt(glm::dot(a, a) * glm::dot(b, b));
    if (!(scale > 0)) return n;
    float cosine = glm::dot(a, b) / scale;
    if (cosine < -0.9999f) return -n;
    vec3 axis = glm::cross(a, b) / scale;
    return n * cosine + glm::cross(axis, n) + axis * (glm::dot(axis, n) / (1 + cosine));
}

vec3 unit_or(vec3 v, vec3 otherwise) {
    float square = glm::dot(v, v);
    return square > 0 && std::isfinite(square) ? v / std::sqrt(square) : otherwise;
}

// Output columns of a kernel, -1 where it has none.
struct OutputTriple {
    int c[3] = {-1, -1, -1};
    OutputTriple(const jit::Kernel& kernel, rsl::Global id) {
        for (size_t o = 0; o < kernel.outputs.size(); ++o) {
            rsl::KernelKey key = rsl::key_of(kernel.outputs[o]);
            if (key.kind == rsl::KeyKind::Global && key.global() == id) c[key.component] = int(o);
        }
    }
    vec3 at(std::span<float* const> out, size_t i) const {
        vec3 v;
        for (int k = 0; k < 3; ++k) v[k] = c[k] < 0 ? 0.0f : out[size_t(c[k])][i];
        return v;
    }
};

bool is_finite(vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

// What one call of run() works on.
struct VertexWork::Pass {
    const Scene& scene;
    Pose& pose;
    VertexState& state;
    uint32_t node;
    VertexSpace space;
    std::span<vec4> positions, normals;
    float winding = 1;  // -1: triangles are seen from their front as clockwise
    size_t stage = 0;
};

VertexState::VertexState(const VertexWork& work) {
    size_t parts = 0;
    for (const VertexWork::Group& group : work.groups_) {
        auto& stages = groups.emplace_back();
        for (size_t s = 0; s < VertexWork::kStages; ++s)
            if (const ShaderInstance* look = group.use.looks[s])
                stages[s].faults.resize(look->full.kernel().fault_sites.size() + 1);
        parts = std::max(parts, group.made.position.size() / kPart + 1);
    }
    resize_pages(moved, work.wedge_count_);
    resize_pages(bent, work.wedge_count_);
    resize_pages(faces, work.triangle_count_);
    resize_pages(before, work.key_of_normal_.size());
    prints.resize(parts);
    not_finite.resize(parts);
}

VertexWork::VertexWork(const Mesh& mesh, std::vector<DicedGroup> groups, std::vector<Use> uses) {
    for (size_t g = 0; g < groups.size(); ++g) {
        Group& group = groups_.emplace_back();
        group.made = std::move(groups[g]);
        group.use = uses[g];
        group.first_wedge = uint32_t(wedge_count_);
        group.first_triangle = triangle_count_;
        group.corners = make_lists(group.made.corners, group.made.position.size());
        wedge_count_ += group.made.position.size();
        triangle_count_ += group.made.corners.size() / 3;
        resize_pages(group_of_wedge_, wedge_count_, uint32_t(g));
    }
    weld_positions(mesh);
    weld_normals(mesh);
}

void VertexWork::weld_positions(const Mesh& mesh) {
    weld_of_position_ = weld(mesh.positions);
    std::vector<uint32_t> weld_of_wedge;
    reserve_pages(weld_of_wedge, wedge_count_);
    for (const Group& group : groups_)
        for (uint32_t p : group.made.position) weld_of_wedge.push_back(weld_of_position_[p]);
    welds_ = make_lists(weld_of_wedge, mesh.positions.size());
}

// Wedges at one position whose groups have the same shaders and whose normals are equal but for
// rounding. The key is the lowest normal entry among them.
void VertexWork::weld_normals(const Mesh& mesh) {
    resize_pages(key_of_normal_, mesh.normals.size());
    for (uint32_t n = 0; n < key_of_normal_.size(); ++n) key_of_normal_[n] = n;
    auto normal_of = [&](uint32_t wedge) {
        const Group& group = groups_[group_of_wedge_[wedge]];
        return group.made.normal[wedge - group.first_wedge];
    };
    auto looks_of = [&](uint32_t wedge) { return groups_[group_of_wedge_[wedge]].use.looks; };
    // The triangles of a flat face are one where dicing makes it smooth; else each has its own.
    auto may_join = [&](uint32_t wedge) {
        const Group& group = groups_[group_of_wedge_[wedge]];
        if (group.made.normal.empty()) return false;
        return !group.made.flat || group.use.looks[kStages - 1] != nullptr;
    };
    for (size_t weld = 0; weld + 1 < welds_.first.size(); ++weld) {
        std::span<const uint32_t> wedges = welds_.of(weld);
        for (size_t i = 1; i < wedges.size(); ++i) {
            if (!may_join(wedges[i])) continue;
            uint32_t n = normal_of(wedges[i]);
            for (size_t k = 0; k < i && key_of_normal_[n] == n; ++k) {
                if (!may_join(wedges[k])) continue;
                uint32_t other = normal_of(wedges[k]);
                vec3 difference = vec3(mesh.normals[n]) - vec3(mesh.normals[other]);
                if (glm::dot(difference, difference) < 1e-8f &&
                    looks_of(wedges[i]) == looks_of(wedges[k]))
                    key_of_normal_[n] = key_of_normal_[other];
            }
        }
    }
    const uint32_t none = uint32_t(mesh.normals.size());
    std::vector<uint32_t> key_of_wedge;
    resize_pages(key_of_wedge, wedge_count_, none);
    for (const Group& group : groups_)
        for (size_t w = 0; w < group.made.normal.size(); ++w)
            key_of_wedge[group.first_wedge + w] = key_of_normal_[group.made.normal[w]];
    same_normal_ = make_lists(key_of_wedge, mesh.normals.size() + 1);
}

void VertexWork::run(const Scene& scene, Pose& pose, VertexState& state,
                     const Vertices& vertices) const {
    while (state.arenas.size() < size_t(thread_count())) state.arenas.emplace_back();
    const std::span<vec4> normals = vertices.normals;
    Pass pass{scene,
              pose,
              state,
              vertices.node,
              VertexSpace(scene, pose, vertices.node, vertices.object_from_mesh, vertices.anchor),
              vertices.positions,
              normals,
              vertices.mirrored ? -1.0f : 1.0f};
    // Where the file gives none, normals are those of the triangles as they stand now.
    for (const Group& group : groups_)
        for (size_t w = 0; group.made.flat && w < group.made.normal.size(); ++w)
            normals[group.made.normal[w]] = vec4(0.0f);
    for (pass.stage = 0; pass.stage < kStages; ++pass.stage)
        if (std::any_of(groups_.begin(), groups_.end(),
                        [&](const Group& group) { return group.use.looks[pass.stage]; }))
            run_stage(pass);
}

void VertexWork::run_stage(Pass& pass) const {
    find_faces(pass);
    VertexState& state = pass.state;
    parallel_for(0, state.before.size(), kGrain, [&](size_t begin, size_t end) {
        for (size_t k = begin; k < end; ++k)
            state.before[k] = face_sum(state.faces, same_normal_.of(k));
    });
    for (size_t g = 0; g < groups_.size(); ++g) run_group(pass, g);
    move_positions(pass);
    find_faces(pass);
    turn_normals(pass);
}

void VertexWork::find_faces(const Pass& pass) const {
    std::span<vec3> faces = pass.state.faces;
    std::span<const vec4> positions = pass.positions;
    for (const Group& group : groups_) {
        const std::vector<uint32_t>&c = group.made.corners, &p = group.made.position;
        parallel_for(0, c.size() / 3, kGrain, [&](size_t begin, size_t end) {
            for (size_t t = begin; t < end; ++t) {
                vec3 p0(positions[p[c[3 * t]]]);
                vec3 e1 = vec3(positions[p[c[3 * t + 1]]]) - p0;
                vec3 e2 = vec3(positions[p[c[3 * t + 2]]]) - p0;
                faces[group.first_triangle + t] = pass.winding * glm::cross(e1, e2);
            }
        });
    }
}

vec3 VertexWork::face_sum(std::span<const vec3> faces, std::span<const uint32_t> wedges) const {
    vec3 sum(0.0f);
    for (uint32_t w : wedges) {
        const Group& group = groups_[group_of_wedge_[w]];
        for (uint32_t corner : group.corners.of(w - group.first_wedge))
            sum += faces[group.first_triangle + corner / 3];
    }
    return sum;
}

void VertexWork::run_group(Pass& pass, size_t g) const {
    const Group& group = groups_[g];
    VertexState& state = pass.state;
    VertexState::Stage& stage = state.groups[g][pass.stage];
    size_t count = group.made.position.size();
    const ShaderInstance* look = group.use.looks[pass.stage];
    if (!look) {
        std::fill_n(state.moved.begin() + group.first_wedge, count, vec3(0.0f));
        return;
    }
    look->update_for_vertices({pass.scene, pass.scene, pass.pose, pass.space.eye_object}, pass.node,
                              stage.frame);
    // Precise kernels run in the IEEE default, fast ones flush denormals
    // (docs/decisions.md#exact-arithmetic).
    bool fast = pass.scene.options.quality.math == jit::math::Tier::Fast;
    std::vector<uint8_t>& faults = stage.faults;
    parallel_for(0, (count + kPart - 1) / kPart, 1, [&](size_t begin, size_t end) {
        std::optional<raytrace::DenormalGuard> flush;
        if (fast) flush.emplace();
        Arena& arena = state.arenas[size_t(thread_index())];
        for (size_t part = begin; part < end; ++part) {
            Arena::Mark mark = arena.mark();
            std::span<uint8_t> own = arena.allocate_span<uint8_t>(faults.size());
            std::fill(own.begin(), own.end(), uint8_t(0));
            run_wedges(pass, g, part * kPart, std::min(count, (part + 1) * kPart), own,
                       state.prints[part]);
            for (size_t s = 0; s < own.size(); ++s)
                if (own[s]) std::atomic_ref(faults[s]).store(1, std::memory_order_relaxed);
            arena.release(mark);
        }
    });
    PrintedLines& printed = stage.printed;
    printed.clear();
    for (PrintedLines& prints : state.prints) {
        if (prints.asked() > 0) printed.add(std::move(prints));
        prints.clear();
    }
    printed.show(pass.scene.options.print);
    for (uint32_t& n : state.not_finite) state.not_finite_total += std::exchange(n, 0);
}

void VertexWork::run_wedges(const Pass& pass, size_t g, size_t begin, size_t end,
                            std::span<uint8_t> faults, PrintedLines& prints) const {
    const Group& group = groups_[g];
    VertexState& state = pass.state;
    const ShaderInstance& look = *group.use.looks[pass.stage];
    const jit::Kernel& kernel = look.full.kernel();
    Arena& arena = state.arenas[size_t(thread_index())];
    size_t count = end - begin;
    VertexSource source{group.made,
                        group.corners,
                        pass.positions,
                        pass.normals,
                        std::span(state.faces).subspan(group.first_triangle),
                        group.use.st,
                        group.use.varying[pass.stage],
                        weld_of_position_};
    std::span<float*> columns =
        fill_vertex_columns(look, source, pass.pose, pass.space, begin, end, arena);
    std::span<float*> out = take_outputs(kernel, count, arena);
    // No lights: the set behind handle 0, which `lights` gives without a grid, is empty.
    const jit::RecordSet no_lights;
    VertexHost host(pass.scene, pass.pose, look, pass.node, prints);
    look.full.run({.count = count,
                   .frame = state.groups[g][pass.stage].frame.full,
                   .columns = columns,
                   .out = out,
                   .faults = faults,
                   .record_sets = {&no_lights, 1},
                   .host = host},
                  arena);
    OutputTriple P(kernel, rsl::Global::P), N(kernel, rsl::Global::N);
    uint32_t bad = 0;
    for (size_t i = 0; i < count; ++i) {
        vec3 before(columns[kColP][i], columns[kColP + 1][i], columns[kColP + 2][i]);
        vec3 moved = P.at(out, i) - before, bent = N.at(out, i);
        bad += !is_finite(moved) || !is_finite(bent);
        size_t w = group.first_wedge + begin + i;
        state.moved[w] = is_finite(moved) ? pass.space.mesh_linear * moved : vec3(0);
        state.bent[w] =
            is_finite(bent) ? unit_or(pass.space.mesh_normals * bent, vec3(0)) : vec3(0);
    }
    state.not_finite[begin / kPart] = bad;
    if (group.use.attributes) store_outputs(pass, group, out, begin, count);
}

// Puts output parameters of a kernel into the attributes "vertex:NAME".
void VertexWork::store_outputs(const Pass& pass, const Group& group, std::span<float* const> out,
                               size_t first, size_t count) const {
    const jit::Kernel& kernel = group.use.looks[pass.stage]->full.kernel();
    for (size_t o = 0; o < kernel.outputs.size(); ++o) {
        rsl::KernelKey key = rsl::key_of(kernel.outputs[o]);
        if (key.kind != rsl::KeyKind::Aov) continue;
        const std::string& name = rsl::name_of(key);
        int c = rsl::number_index(key);
        for (VertexAttribute& a : group.use.attributes->attributes) {
            std::string_view semantic = a.semantic;
            if (!semantic.starts_with("vertex:")) continue;
            semantic.remove_prefix(7);
            if (name != semantic || c >= int(a.stride)) continue;
            std::vector<float>& to =
                a.output == kNone ? a.values : pass.pose.vertex_outputs[a.output];
            for (size_t i = 0; i < count; ++i) to[(first + i) * a.stride + size_t(c)] = out[o][i];
        }
    }
}

void VertexWork::move_positions(const Pass& pass) const {
    parallel_for(0, pass.positions.size(), kGrain, [&](size_t begin, size_t end) {
        for (size_t p = begin; p < end; ++p) {
            std::span<const uint32_t> wedges = welds_.of(weld_of_position_[p]);
            if (wedges.empty()) continue;
            vec3 sum(0.0f);
            for (uint32_t w : wedges) sum += pass.state.moved[w];
            pass.positions[p] += vec4(sum / float(wedges.size()), 0.0f);
        }
    });
}

void VertexWork::turn_normals(const Pass& pass) const {
    const VertexState& state = pass.state;
    parallel_for(0, pass.normals.size(), kGrain, [&](size_t begin, size_t end) {
        for (size_t n = begin; n < end; ++n) {
            uint32_t key = key_of_normal_[n];
            std::span<const uint32_t> wedges = same_normal_.of(key);
            if (wedges.empty()) continue;
            vec3 normal(pass.normals[n]);
            const Group& group = groups_[group_of_wedge_[wedges[0]]];
            const ShaderInstance* look = group.use.looks[pass.stage];
            if (look && look->lowered.bends_N) {
                vec3 sum(0.0f);
                for (uint32_t w : wedges) sum += state.bent[w];
                normal = unit_or(sum, normal);
            } else {
                vec3 after = face_sum(state.faces, wedges);
                bool displaced = pass.stage == kStages - 1 && after != state.before[key];
                bool anew = displaced || (look && group.made.flat);
                normal = unit_or(anew ? after : turned(normal, state.before[key], after), normal);
            }
            pass.normals[n] = vec4(normal, 0.0f);
        }
    });
}

void VertexWork::report(const MeshDefinition& mesh, VertexState& state,
                        Diagnostics& diagnostics) const {
    for (size_t g = 0; g < groups_.size(); ++g)
        for (size_t s = 0; s < kStages; ++s) {
            const ShaderInstance* look = groups_[g].use.looks[s];
            if (!look) continue;
            VertexState::Stage& stage = state.groups[g][s];
            stage.printed.report(look->shader().name, diagnostics);
            stage.printed.clear();
            auto faulted = [&](size_t site) {
                return std::exchange(stage.faults[site], uint8_t(0)) != 0;
            };
            report_faults(look->full.kernel(), faulted, diagnostics);
        }
    if (uint32_t count = std::exchange(state.not_finite_total, 0))
        diagnostics.report(Code::VERTEX_NON_FINITE, mesh.where, count, mesh.id);
}

// ---- when kernels run ---------------------------------------------------------------------------

// "current" is the object's space while vertices are moved.
static bool is_own_space(std::string_view space) {
    return space == "current" || space == "object" || space == "shader";
}

bool runs_each_frame(const ShaderInstance& look, const SceneNodes& scene, uint32_t node) {
    using Source = FrameInput::Source;
    auto between = [](uint16_t c, uint16_t first) { return c >= first && c < first + 3; };
    for (uint16_t c : look.full.columns)
        if (between(c, kColI) || c == kColDu || c == kColDv) return true;
    const SceneDescription& description = *scene.description;
    auto animated = [&](uint32_t value) {
        return value < description.animated.size() && description.animated[value];
    };
    auto space_moves = [&](std::string_view space) {
        if (is_own_space(space)) return false;
        if (space == "world") return scene.nodes[node].can_move;
        for (const Node& n : scene.nodes)
            if (description.nodes[n.definition].id == space)
                return n.can_move || scene.nodes[node].can_move;
        return true;  // of the camera
    };
    for (const FrameInput& input : look.full.inputs) {
        switch (input.source) {
            case Source::Fixed:
                break;
            case Source::Value:
                if (animated(input.index)) return true;
                break;
            case Source::Spatial:
                for (uint32_t k = 0; k < 3; ++k)
                    if (animated(input.index + k)) return true;
                break;
            case Source::Space:
                if (space_moves(look.spaces[input.index])) return true;
                break;
            case Source::Time:
            case Source::Shutter:
            case Source::Near:
            case Source::Far:
            case Source::Eye:
                return true;
        }
    }
    // A space whose name is computed may be any; option("Frame") and its like are asked by name.
    auto asks = [](const std::shared_ptr<const jit::Kernel>& kernel) {
        return kernel &&
               std::any_of(kernel->services.begin(), kernel->services.end(), [](const auto& s) {
                   return s.name == rsl::service_name(rsl::Service::transform) ||
                          s.name == rsl::service_name(rsl::Service::query);
               });
    };
    return asks(look.full.pair.point) || asks(look.full.pair.frame);
}

bool depends_on_node(const ShaderInstance& look) {
    return std::any_of(look.full.inputs.begin(), look.full.inputs.end(),
                       [&](const FrameInput& input) {
                           return input.source == FrameInput::Source::Space &&
                                  !is_own_space(look.spaces[input.index]);
                       });
}

}  // namespace kinora

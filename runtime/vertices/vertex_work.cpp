// runtime/vertices/vertex_work.cpp: welding, running and averaging of vertex kernels.
#include "runtime/vertices/vertex_work.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>

#include "rsl/model/kernel_keys.h"
#include "runtime/base/memory/pages.h"
#include "runtime/base/parallel.h"
#include "runtime/description/findings.h"
#include "runtime/shading/scene_host.h"
#include "runtime/vertices/vertex_columns_p.h"
#include "runtime/vertices/weld.h"

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

// Puts output parameters of a kernel into the attributes "vertex:NAME".
void store_outputs(const jit::Kernel& kernel, std::span<float* const> out, size_t first,
                   size_t count, PrimitiveGroup& group) {
    for (size_t o = 0; o < kernel.outputs.size(); ++o) {
        rsl::KernelKey key = rsl::key_of(kernel.outputs[o]);
        if (key.kind != rsl::KeyKind::Aov) continue;
        const std::string& name = rsl::name_of(key);
        int c = rsl::number_index(key);
        for (VertexAttribute& a : group.attributes) {
            std::string_view semantic = a.semantic;
            if (!semantic.starts_with("vertex:")) continue;
            semantic.remove_prefix(7);
            if (name != semantic || c >= int(a.stride)) continue;
            for (size_t i = 0; i < count; ++i)
                a.values[(first + i) * a.stride + size_t(c)] = out[o][i];
        }
    }
}

}  // namespace

// What one call of run() works on.
struct VertexWork::Pass {
    const Scene& scene;
    uint32_t node;
    VertexSpace space;
    std::span<vec4> positions, normals;
    float winding = 1;  // -1: triangles are seen from their front as clockwise
    size_t stage = 0;
};

VertexWork::VertexWork(const Mesh& mesh, std::vector<DicedGroup> groups, std::vector<Use> uses) {
    size_t triangles = 0;
    for (size_t g = 0; g < groups.size(); ++g) {
        Group& group = groups_.emplace_back();
        group.made = std::move(groups[g]);
        group.use = uses[g];
        group.first_wedge = uint32_t(wedge_count_);
        group.first_triangle = triangles;
        group.corners = make_lists(group.made.corners, group.made.position.size());
        for (size_t s = 0; s < kStages; ++s)
            if (const ShaderInstance* look = group.use.looks[s])
                group.faults[s].resize(look->full.kernel().fault_sites.size() + 1);
        wedge_count_ += group.made.position.size();
        triangles += group.made.corners.size() / 3;
        resize_pages(group_of_wedge_, wedge_count_, uint32_t(g));
    }
    weld_positions(mesh);
    weld_normals(mesh);
    resize_pages(moved_, wedge_count_);
    resize_pages(bent_, wedge_count_);
    resize_pages(faces_, triangles);
    resize_pages(before_, mesh.normals.size());
    size_t parts = 0;
    for (const Group& group : groups_)
        parts = std::max(parts, group.made.position.size() / kPart + 1);
    prints_.resize(parts);
    not_finite_.resize(parts);
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

void VertexWork::run(const Scene& scene, uint32_t node, const dmat4& object_from_mesh, dvec3 anchor,
                     std::span<vec4> positions, std::span<vec4> normals, bool mirrored) {
    while (arenas_.size() < size_t(thread_count())) arenas_.emplace_back();
    Pass pass{scene,     node,    VertexSpace(scene, node, object_from_mesh, anchor),
              positions, normals, mirrored ? -1.0f : 1.0f};
    // Where the file gives none, normals are those of the triangles as they stand now.
    for (const Group& group : groups_)
        for (size_t w = 0; group.made.flat && w < group.made.normal.size(); ++w)
            normals[group.made.normal[w]] = vec4(0.0f);
    for (pass.stage = 0; pass.stage < kStages; ++pass.stage)
        if (std::any_of(groups_.begin(), groups_.end(),
                        [&](const Group& group) { return group.use.looks[pass.stage]; }))
            run_stage(pass);
}

void VertexWork::run_stage(Pass& pass) {
    find_faces(pass);
    parallel_for(0, before_.size(), kGrain, [&](size_t begin, size_t end) {
        for (size_t k = begin; k < end; ++k) before_[k] = face_sum(same_normal_.of(k));
    });
    for (Group& group : groups_) run_group(pass, group);
    move_positions(pass);
    find_faces(pass);
    turn_normals(pass);
}

void VertexWork::find_faces(const Pass& pass) {
    std::span<const vec4> positions = pass.positions;
    for (const Group& group : groups_) {
        const std::vector<uint32_t>&c = group.made.corners, &p = group.made.position;
        parallel_for(0, c.size() / 3, kGrain, [&](size_t begin, size_t end) {
            for (size_t t = begin; t < end; ++t) {
                vec3 p0(positions[p[c[3 * t]]]);
                vec3 e1 = vec3(positions[p[c[3 * t + 1]]]) - p0;
                vec3 e2 = vec3(positions[p[c[3 * t + 2]]]) - p0;
                faces_[group.first_triangle + t] = pass.winding * glm::cross(e1, e2);
            }
        });
    }
}

vec3 VertexWork::face_sum(std::span<const uint32_t> wedges) const {
    vec3 sum(0.0f);
    for (uint32_t w : wedges) {
        const Group& group = groups_[group_of_wedge_[w]];
        for (uint32_t corner : group.corners.of(w - group.first_wedge))
            sum += faces_[group.first_triangle + corner / 3];
    }
    return sum;
}

void VertexWork::run_group(Pass& pass, Group& group) {
    size_t count = group.made.position.size();
    ShaderInstance* look = group.use.looks[pass.stage];
    if (!look) {
        std::fill_n(moved_.begin() + group.first_wedge, count, vec3(0.0f));
        return;
    }
    look->update_for_vertices({pass.scene, pass.space.eye_object}, pass.node);
    // Precise kernels run in the IEEE default, fast ones flush denormals
    // (docs/decisions.md#exact-arithmetic).
    bool fast = pass.scene.options.math == jit::math::Tier::Fast;
    std::vector<uint8_t>& faults = group.faults[pass.stage];
    parallel_for(0, (count + kPart - 1) / kPart, 1, [&](size_t begin, size_t end) {
        std::optional<raytrace::DenormalGuard> flush;
        if (fast) flush.emplace();
        Arena& arena = arenas_[size_t(thread_index())];
        for (size_t part = begin; part < end; ++part) {
            Arena::Mark mark = arena.mark();
            std::span<uint8_t> own = arena.allocate_span<uint8_t>(faults.size());
            std::fill(own.begin(), own.end(), uint8_t(0));
            run_wedges(pass, group, part * kPart, std::min(count, (part + 1) * kPart), own,
                       prints_[part]);
            for (size_t s = 0; s < own.size(); ++s)
                if (own[s]) std::atomic_ref(faults[s]).store(1, std::memory_order_relaxed);
            arena.release(mark);
        }
    });
    PrintedLines& printed = group.printed[pass.stage];
    printed.clear();
    for (PrintedLines& prints : prints_) {
        if (prints.asked() > 0) printed.add(std::move(prints));
        prints.clear();
    }
    printed.show();
    for (uint32_t& n : not_finite_) not_finite_total_ += std::exchange(n, 0);
}

void VertexWork::run_wedges(const Pass& pass, Group& group, size_t begin, size_t end,
                            std::span<uint8_t> faults, PrintedLines& prints) {
    const ShaderInstance& look = *group.use.looks[pass.stage];
    const jit::Kernel& kernel = look.full.kernel();
    Arena& arena = arenas_[size_t(thread_index())];
    size_t count = end - begin;
    VertexSource source{group.made,
                        group.corners,
                        pass.positions,
                        pass.normals,
                        std::span(faces_).subspan(group.first_triangle),
                        group.use.st,
                        group.use.varying[pass.stage],
                        weld_of_position_};
    std::span<float*> columns = fill_vertex_columns(look, source, pass.space, begin, end, arena);
    std::span<float*> out = take_outputs(kernel, count, arena);
    // No lights: the set behind handle 0, which `lights` gives without a grid, is empty.
    const jit::RecordSet no_lights;
    VertexHost host(pass.scene, look, pass.node, prints);
    look.full.run({.count = count,
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
        moved_[w] = is_finite(moved) ? pass.space.mesh_linear * moved : vec3(0);
        bent_[w] = is_finite(bent) ? unit_or(pass.space.mesh_normals * bent, vec3(0)) : vec3(0);
    }
    not_finite_[begin / kPart] = bad;
    if (group.use.attributes) store_outputs(kernel, out, begin, count, *group.use.attributes);
}

void VertexWork::move_positions(const Pass& pass) {
    parallel_for(0, pass.positions.size(), kGrain, [&](size_t begin, size_t end) {
        for (size_t p = begin; p < end; ++p) {
            std::span<const uint32_t> wedges = welds_.of(weld_of_position_[p]);
            if (wedges.empty()) continue;
            vec3 sum(0.0f);
            for (uint32_t w : wedges) sum += moved_[w];
            pass.positions[p] += vec4(sum / float(wedges.size()), 0.0f);
        }
    });
}

void VertexWork::turn_normals(const Pass& pass) {
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
                for (uint32_t w : wedges) sum += bent_[w];
                normal = unit_or(sum, normal);
            } else {
                vec3 after = face_sum(wedges);
                bool displaced = pass.stage == kStages - 1 && after != before_[key];
                bool anew = displaced || (look && group.made.flat);
                normal = unit_or(anew ? after : turned(normal, before_[key], after), normal);
            }
            pass.normals[n] = vec4(normal, 0.0f);
        }
    });
}

void VertexWork::report(const MeshDefinition& mesh, Diagnostics& diagnostics) {
    for (Group& group : groups_)
        for (size_t s = 0; s < kStages; ++s) {
            if (!group.use.looks[s]) continue;
            group.printed[s].report(group.use.looks[s]->shader().name, diagnostics);
            group.printed[s].clear();
            auto faulted = [&](size_t site) {
                return std::exchange(group.faults[s][site], uint8_t(0)) != 0;
            };
            report_faults(group.use.looks[s]->full.kernel(), faulted, diagnostics);
        }
    if (uint32_t count = std::exchange(not_finite_total_, 0))
        diagnostics.report(Code::VERTEX_NON_FINITE, mesh.where, count, mesh.id);
}

// ---- when kernels run ---------------------------------------------------------------------------

// "current" is the object's space while vertices are moved.
static bool is_own_space(std::string_view space) {
    return space == "current" || space == "object" || space == "shader";
}

bool runs_each_frame(const ShaderInstance& look, const Scene& scene, uint32_t node) {
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

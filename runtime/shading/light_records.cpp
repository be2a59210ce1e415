// runtime/shading/light_records.cpp: lights run once for a grid; their answers become records that
// surface kernels replay (docs/decisions.md#lights-run-once).
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "raytrace/sampling.h"

#include "runtime/shading/shading_p.h"

namespace kinora {

namespace {

// Columns a light kernel reads, from the points to be lit.
std::span<float*> light_columns(const ShaderInstance& look, const Scene& scene,
                                const LightSource& light, const float* const P[3],
                                const float* const N[3], const float* rng, size_t count,
                                Arena& arena) {
    std::span<float*> columns = arena.allocate_span<float*>(look.column_count);
    std::fill(columns.begin(), columns.end(), nullptr);
    vec3 origin(scene.view.camera_from_world * scene.nodes[light.node].world[3]);
    auto view = [](const float* p) { return const_cast<float*>(p); };
    for (uint16_t column : look.full.columns) {
        if (columns[column]) continue;
        if (column >= kColPs && column < kColPs + 3)
            columns[column] = view(P[column - kColPs]);
        else if (column >= kColNs && column < kColNs + 3)
            columns[column] = view(N[column - kColNs]);
        else if (column >= kColN && column < kColN + 3)
            columns[column] = view(N[column - kColN]);
        else if (column == kColRng && rng)
            columns[column] = view(rng);
        else {
            columns[column] = arena.allocate_span<float>(padded(count)).data();
            bool is_origin = column >= kColP && column < kColP + 3;
            std::fill_n(columns[column], padded(count), is_origin ? origin[column - kColP] : 0.0f);
        }
    }
    return columns;
}

int find_output(const jit::Kernel& kernel, const std::string& name) {
    for (size_t o = 0; o < kernel.outputs.size(); ++o)
        if (kernel.outputs[o].name == name) return int(o);
    return -1;
}

// The light's __category: a comma separated list.
std::string categories_of(const ShaderInstance& light) {
    for (const ParamSource& source : light.layers[0].params)
        if (source.name == "__category" && !source.strings.empty()) return source.strings[0];
    for (const rsl::ShaderParameter& p : light.shader().parameters)
        if (p.name == "__category" && p.constant && !p.constant->strings.empty())
            return p.constant->strings[0];
    return "";
}

// The parts of a text between separators: calls each(part) until one is true.
template <class Each>
bool any_part(std::string_view text, char separator, Each&& each) {
    for (size_t at = 0; at <= text.size();) {
        size_t end = std::min(text.find(separator, at), text.size());
        if (each(text.substr(at, end - at))) return true;
        at = end + 1;
    }
    return false;
}

std::string_view trimmed(std::string_view text) {
    size_t first = text.find_first_not_of(' ');
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

// "a", "a,b" (any of them), "a|b", "a&-b"; & binds closer than |, - stands before a name.
bool has_category(std::string_view own, std::string_view wanted) {
    auto has = [&](std::string_view name) {
        name = trimmed(name);
        bool without = name.starts_with("-");
        if (without) name = trimmed(name.substr(1));
        return any_part(own, ',', [&](std::string_view part) { return trimmed(part) == name; }) !=
               without;
    };
    if (wanted.find_first_of("|&") == std::string_view::npos)
        return any_part(wanted, ',', [&](std::string_view name) { return has(name); });
    return any_part(wanted, '|', [&](std::string_view both) {
        return !any_part(both, '&', [&](std::string_view name) { return !has(name); });
    });
}

// A light's float parameter: bound to a value, which may be animated, or its constant default.
Shading::LightNumber number_of(const ShaderInstance& light, std::string_view name) {
    for (const ParamSource& source : light.layers[0].params)
        if (source.name == name && source.value.present()) return {source.value.offset, 0};
    for (const rsl::ShaderParameter& p : light.shader().parameters)
        if (p.name == name && p.constant && !p.constant->numbers.empty())
            return {kNone, p.constant->numbers[0]};
    return {};
}

float present(const Shading::LightNumber& number, const Scene& scene) {
    return number.value == kNone ? number.fixed : float(scene.values[number.value]);
}

}  // namespace

// ---- names to output indices, once
// ---------------------------------------------------------------

namespace {

using Statement = Shading::Statement;
using LightBinding = Shading::LightBinding;

Statement statement_of(const ShaderInstance& look, size_t index, const LightDefinition& definition,
                       ShadowMode mode) {
    const jit::Kernel& kernel = look.full.kernel();
    const rsl::LightStatement& from = look.lowered.light_statements[index];
    Statement statement;
    statement.kind = from.kind;
    std::string prefix = "light:" + std::to_string(index) + ":";
    for (size_t k = 0; k < 3; ++k) {
        statement.L[k] = find_output(kernel, prefix + "L." + "xyz"[k]);
        statement.Cl[k] = find_output(kernel, prefix + "Cl." + "rgb"[k]);
        statement.Ol[k] = find_output(kernel, prefix + "Ol." + "rgb"[k]);
    }
    statement.lit = find_output(kernel, prefix + "lit");
    statement.casts_shadow = from.casts_shadow;
    if (definition.shadows) statement.casts_shadow = *definition.shadows;
    if (mode == ShadowMode::Explicit) statement.casts_shadow = definition.shadows.value_or(false);
    if (mode == ShadowMode::Off || from.kind == rsl::kLightAmbient) statement.casts_shadow = false;
    return statement;
}

// Has the light a parameter that a variable of the type can take?
bool parameter_fits(const ShaderInstance& light, std::string_view name, rsl::Type type) {
    for (const rsl::ShaderParameter& p : light.shader().parameters) {
        if (p.name != name) continue;
        bool triples = rsl::is_triple(p.type.base) && rsl::is_triple(type.base);
        return (p.type.base == type.base || triples) && p.type.array_length == type.array_length;
    }
    return false;
}

// Triples are read as any triple.
int find_component(const jit::Kernel& kernel, const std::string& name, rsl::BaseType type, int k) {
    if (rsl::component_count(type) == 1) return find_output(kernel, name);
    if (type == rsl::BaseType::Matrix) return find_output(kernel, name + "." + std::to_string(k));
    int output = find_output(kernel, name + "." + "xyz"[k]);
    return output >= 0 ? output : find_output(kernel, name + "." + "rgb"[k]);
}

// What a surface reads of a light: its categories' bits, the outputs behind its messages.
LightBinding binding_of(const ShaderInstance& surface, const ShaderInstance& light) {
    LightBinding binding;
    std::string own = categories_of(light);
    for (size_t c = 0; c < surface.lowered.categories.size(); ++c)
        binding.categories |= int32_t(has_category(own, surface.lowered.categories[c])) << c;
    binding.nondiffuse = number_of(light, "__nondiffuse");
    binding.nonspecular = number_of(light, "__nonspecular");
    const jit::Kernel& kernel = light.full.kernel();
    for (size_t m = 0; m < surface.lowered.light_messages.size(); ++m) {
        rsl::Type type = surface.lowered.light_message_types[m];
        std::string name = "message:" + surface.lowered.light_messages[m];
        int length = std::max(type.array_length, 1);
        bool known = parameter_fits(light, surface.lowered.light_messages[m], type);
        for (int e = 0; e < length; ++e) {
            std::string element = type.is_array() ? name + "[" + std::to_string(e) + "]" : name;
            for (int k = 0; k < rsl::component_count(type.base); ++k)
                binding.messages.push_back(known ? find_component(kernel, element, type.base, k)
                                                 : -1);
        }
        binding.known.push_back(known);
    }
    return binding;
}

}  // namespace

void Shading::bind_lights() {
    record_count_ = 0;
    statements_.clear();
    bindings_.clear();
    for (const LightSource& light : scene_.lights) {
        const ShaderInstance& look = *scene_.looks[light.look];
        auto& statements = statements_.emplace_back();
        for (size_t s = 0; s < look.lowered.light_statements.size(); ++s)
            statements.push_back(statement_of(look, s, scene_.description->lights[light.definition],
                                              scene_.options.shadows));
        size_t samples = 1;
        if (AreaLight* area = area_lights_[statements_.size() - 1].get()) {
            bool directed = std::any_of(statements.begin(), statements.end(),
                                        [](const auto& s) { return s.kind != rsl::kLightAmbient; });
            if (!directed) area->samples = 1;
            samples = area->samples;
        }
        record_count_ += statements.size() * samples;
    }
    for (size_t l = 0; l < scene_.looks.size(); ++l) {
        scene_.looks[l]->index = uint32_t(l);
        auto& row = bindings_.emplace_back();
        if (scene_.looks[l]->kind == ShaderInstanceKind::Light) continue;
        for (const LightSource& light : scene_.lights)
            row.push_back(binding_of(*scene_.looks[l], *scene_.looks[light.look]));
    }
}

// ---- in the frame
// --------------------------------------------------------------------------------

// What every grid with lights needs for them.
void Shading::want_lights(Grid& grid) const {
    want_triple(grid, kColP);
    want_triple(grid, kColN);
    constexpr uint16_t kRandom[] = {kColRng};
    if (lights_need_rng_) want_columns(grid, kRandom);
}

void Shading::run_lights(Grid& grid) {
    size_t count = grid.count();
    LightPoints at;
    at.count = count;
    for (size_t k = 0; k < 3; ++k) {
        at.P[k] = grid.columns[kColP + k];
        at.N[k] = grid.columns[kColN + k];
        float* accel = grid.arena->allocate_span<float>(padded(count)).data();
        float* error = grid.arena->allocate_span<float>(padded(count)).data();
        float* Ng = grid.arena->allocate_span<float>(padded(count)).data();
        for (size_t i = 0; i < count; ++i) {
            accel[i] = grid.hits.P[k][grid.points[i]];
            error[i] = grid.hits.P_error[k][grid.points[i]];
            Ng[i] = grid.hits.Ng[k][grid.points[i]];
        }
        at.accel[k] = accel;
        at.error[k] = error;
        at.Ng[k] = Ng;
    }
    at.rng = grid.columns[kColRng];
    std::span<uint32_t> surface = grid.arena->allocate_span<uint32_t>(count);
    for (size_t i = 0; i < count; ++i) surface[i] = grid.hits.instance[grid.points[i]];
    at.surface = surface.data();
    grid.record_sets[0] = make_records(grid, at);
}

jit::RecordSet Shading::make_records(Grid& grid, const LightPoints& at) {
    Arena& arena = *grid.arena;
    float* zeros = arena.allocate_span<float>(padded(at.count)).data();
    std::fill_n(zeros, padded(at.count), 0.0f);
    std::span<jit::Record> records = arena.allocate_span<jit::Record>(record_count_);
    jit::Record* next = records.data();
    for (size_t l = 0; l < scene_.lights.size(); ++l) {
        if (area_lights_[l]) {
            next = area_records(grid, at, l, next, zeros);
            continue;
        }
        const ShaderInstance& look = *scene_.looks[scene_.lights[l].look];
        const jit::Kernel& kernel = look.full.kernel();
        std::span<float*> out = arena.allocate_span<float*>(kernel.outputs.size());
        for (float*& column : out) column = arena.allocate_span<float>(padded(at.count)).data();
        Grid lit(grid.scene, grid.hits, grid.points.subspan(at.first, at.count), &look);
        lit.depth = grid.depth;
        lit.ray = grid.ray;
        lit.shadows = grid.shadows;
        lit.surface = grid.look->kind == ShaderInstanceKind::Surface ? grid.look : nullptr;
        lit.lit = &grid;
        lit.lit_first = at.first;
        lit.thread = grid.thread;
        lit.shading = this;
        lit.arena = &arena;
        lit.record_sets = grid.record_sets;
        if (!look.lowered.gathers.empty()) {  // its own, not those of the surface's turns
            lit.record_sets = arena.allocate_span<jit::RecordSet>(kRecordSets);
            std::fill(lit.record_sets.begin(), lit.record_sets.end(), jit::RecordSet{});
        }
        lit.columns =
            light_columns(look, scene_, scene_.lights[l], at.P, at.N, at.rng, at.count, arena);
        run_kernel(look.full, lit, out);
        thread(grid.thread).counters.light_points += at.count;
        const LightBinding& binding = bindings_[grid.look->index][l];
        for (const Statement& statement : statements_[l])
            *next++ = make_record(grid, at, statement, binding, out, zeros);
    }
    return {int32_t(record_count_), records.data()};
}

// A light without an output `lit` is lit everywhere.
static const float* ones_column(Arena& arena, size_t count) {
    std::span<float> column = arena.allocate_span<float>(padded(count));
    std::fill(column.begin(), column.end(), jit::float_of(1));
    return column.data();
}

jit::Record Shading::make_record(Grid& grid, const LightPoints& at, const Statement& statement,
                                 const LightBinding& binding, std::span<float* const> out,
                                 const float* zeros, const LightSamples* samples) {
    std::span<const float*> columns =
        grid.arena->allocate_span<const float*>(rsl::kLightMessages + binding.messages.size());
    std::fill(columns.begin(), columns.end(), zeros);
    auto set = [&](size_t column, int output) {
        if (output >= 0) columns[column] = out[size_t(output)];
    };
    for (size_t k = 0; k < 3; ++k) {
        set(rsl::kLightL + k, statement.L[k]);
        set(rsl::kLightCl + k, statement.Cl[k]);
        set(rsl::kLightOl + k, statement.Ol[k]);
    }
    if (statement.lit < 0) columns[rsl::kLightLit] = ones_column(*grid.arena, at.count);
    set(rsl::kLightLit, statement.lit);
    for (size_t m = 0; m < binding.messages.size(); ++m)
        set(rsl::kLightMessages + m, binding.messages[m]);
    if (statement.L[0] >= 0) {
        float *L[3], *Cl[3];
        for (size_t k = 0; k < 3; ++k) {
            L[k] = out[size_t(statement.L[k])];
            Cl[k] = statement.Cl[k] < 0 ? nullptr : out[size_t(statement.Cl[k])];
        }
        if (statement.casts_shadow && grid.shadows && Cl[0] && Cl[1] && Cl[2])
            shadow(grid, at, statement.kind == rsl::kLightSolar, L,
                   statement.lit < 0 ? nullptr : out[size_t(statement.lit)], Cl, samples);
    }
    float* uniforms =
        grid.arena->allocate_span<float>(rsl::kLightUniforms + binding.known.size()).data();
    uniforms[rsl::kLightKind] = jit::float_of(statement.kind);
    uniforms[rsl::kLightCategories] = jit::float_of(binding.categories);
    uniforms[rsl::kLightNondiffuse] = present(binding.nondiffuse, scene_);
    uniforms[rsl::kLightNonspecular] = present(binding.nonspecular, scene_);
    for (size_t m = 0; m < binding.known.size(); ++m)
        uniforms[rsl::kLightUniforms + m] = jit::float_of(binding.known[m]);
    // Columns are read at the grid's point, so those of a part of it start before it.
    for (const float*& column : columns) column -= at.first;
    return {columns.data(), uniforms};
}

namespace {

// How far a light's sample stands off the surface that shines, where the ray to it ends.
vec3 before_sample(const raytrace::HitBatch& samples, size_t i, vec3 P, vec3 to_light) {
    vec3 end = triple(samples.P, i);
    // Origin, direction and the distance of a hit all round: 16 steps of the largest.
    vec3 size = glm::max(glm::abs(end), glm::abs(P));
    vec3 error = vec3(std::max(size.x, std::max(size.y, size.z)) * 16 * 0x1p-24f) +
                 triple(samples.P_error, i);
    return raytrace::offset_ray_origin(end, error, triple(samples.Ng, i), -to_light) - end;
}

// Shadow rays by the packet, and the lit points that asked for them.
struct ShadowPacket {
    raytrace::RayPacket16 rays;
    uint32_t points[raytrace::kPacket];
    int filled = 0;

    void add(uint32_t point, vec3 org, vec3 dir, float tfar) {
        rays.org_x[filled] = org.x;
        rays.org_y[filled] = org.y;
        rays.org_z[filled] = org.z;
        rays.dir_x[filled] = dir.x;
        rays.dir_y[filled] = dir.y;
        rays.dir_z[filled] = dir.z;
        rays.tnear[filled] = 0;
        rays.tfar[filled] = tfar;
        rays.mask[filled] = raytrace::kMaskOpaque;
        rays.time[filled] = 0;
        points[filled++] = point;
    }
    vec3 org(int j) const { return {rays.org_x[j], rays.org_y[j], rays.org_z[j]}; }
    vec3 dir(int j) const { return {rays.dir_x[j], rays.dir_y[j], rays.dir_z[j]}; }
};

}  // namespace

// What is opaque takes all of Cl; the rays it lets by go on through what is transparent.
void Shading::shadow(const Grid& grid, const LightPoints& at, bool solar, const float* const L[3],
                     const float* lit, float* const Cl[3], const LightSamples* samples) {
    Thread& own = thread(grid.thread);
    mat3 accel_from_camera = glm::transpose(camera_from_accel_);
    ShadowPacket packet;
    NestedWavefront nested(own);
    raytrace::RayBatch& rest = nested->rays;
    if (any_transparent_) rest.reserve(kGridPoints);
    rest.count = 0;
    auto flush = [&] {
        if (packet.filled == 0) return;
        packet.rays.active = (1u << packet.filled) - 1;
        uint32_t blocked = scene_.accel.occluded16(packet.rays, own.counters.trace);
        for (int j = 0; j < packet.filled; ++j) {
            uint32_t i = packet.points[j];
            if (blocked >> j & 1) {
                for (size_t k = 0; k < 3; ++k) Cl[k][i] = 0;
            } else if (any_transparent_) {
                set_nested_ray(rest, rest.count, packet.org(j), packet.dir(j), packet.rays.tfar[j],
                               grid.hits, grid.points[at.first + i]);
                rest.slot[rest.count++] = i;
            }
        }
        packet.filled = 0;
    };
    for (uint32_t i = 0; i < at.count; ++i) {
        if (lit && jit::bits_of(lit[i]) == 0) continue;
        if (Cl[0][i] == 0 && Cl[1][i] == 0 && Cl[2][i] == 0) continue;
        vec3 to_light = accel_from_camera * triple(L, i);
        vec3 P = triple(at.accel, i);
        vec3 Ng = triple(at.Ng, i);
        // A point that is on no known surface leaves its error box along the ray itself.
        if (Ng == vec3(0)) Ng = glm::normalize(to_light);
        vec3 org = raytrace::offset_ray_origin(P, triple(at.error, i), Ng, to_light);
        vec3 dir = solar ? to_light : P + to_light - org;
        if (samples && !solar) dir += before_sample(samples->hits, i, P, to_light);
        packet.add(i, org, dir, solar ? std::numeric_limits<float>::infinity() : 1.0f);
        if (packet.filled == raytrace::kPacket) flush();
    }
    flush();
    if (rest.count == 0) return;
    std::span<vec3> through = own.arena.allocate_span<vec3>(rest.count);
    std::span<uint32_t> points = own.arena.allocate_span<uint32_t>(rest.count);
    size_t count = rest.count;
    for (size_t r = 0; r < count; ++r) {
        points[r] = rest.slot[r];
        rest.slot[r] = uint32_t(r);
    }
    pass_transparent(grid.thread, rest, through.data());
    for (size_t r = 0; r < count; ++r)
        for (size_t k = 0; k < 3; ++k) Cl[k][points[r]] *= through[r][int(k)];
}

static uint32_t bits(float x) {
    return uint32_t(jit::bits_of(x));
}

int32_t Shading::lights_at(Grid& grid, const jit::ServiceCall& call) {
    // A part of the grid: one lane group at its own points. Records of a group that is done are
    // let go, or a marching loop would keep them all.
    Arena& arena = *grid.arena;
    if (grid.record_group != call.first) {
        if (grid.record_group >= 0) arena.release(grid.record_mark);
        grid.record_mark = arena.mark();
        grid.record_group = call.first;
        grid.record_calls = 0;
    }
    uint32_t handle = grid.next_record_set;
    grid.next_record_set = handle + 1 < kGatherSets ? handle + 1 : 1;
    if (++grid.record_calls > kMostLightPlaces) {
        thread(grid.thread).counters.unlit += 1;
        grid.record_sets[handle] = {};
        return int32_t(handle);
    }
    LightPoints at;
    at.count = size_t(std::min<int32_t>(call.lanes, int32_t(grid.count()) - call.first));
    at.first = size_t(call.first);
    mat3 accel_from_camera = glm::transpose(camera_from_accel_);
    float* rows[13];
    for (float*& row : rows) row = arena.allocate_span<float>(jit::kMaxLanes).data();
    for (size_t i = 0; i < jit::kMaxLanes; ++i) {
        vec3 P(call.args[i], call.args[jit::kMaxLanes + i], call.args[2 * jit::kMaxLanes + i]);
        if (!(call.mask >> i & 1)) P = vec3(0);
        vec3 accel = accel_from_camera * P + eye_;
        // The point went through a rotation and a sum: gamma(4) of the magnitudes bounds that.
        vec3 error = (std::abs(P.x) + std::abs(P.y) + std::abs(P.z) + glm::abs(eye_)) * 2.4e-7f;
        for (int k = 0; k < 3; ++k) {
            rows[k][i] = P[k];
            rows[3 + k][i] = accel[k];
            rows[6 + k][i] = error[k];
            rows[9 + k][i] = 0;
        }
        // Each step of a march has numbers of its own.
        uint32_t h = grid.points[std::min(size_t(call.first) + i, grid.count() - 1)];
        rows[12][i] = jit::float_of(int32_t(raytrace::hash(
            random_of(grid.hits, h), raytrace::hash(bits(P.x), bits(P.y), bits(P.z)))));
    }
    at.rng = rows[12];
    std::span<uint32_t> surface = arena.allocate_span<uint32_t>(jit::kMaxLanes);
    std::fill(surface.begin(), surface.end(), kNone);
    at.surface = surface.data();
    for (size_t k = 0; k < 3; ++k) {
        at.P[k] = rows[k];
        at.accel[k] = rows[3 + k];
        at.error[k] = rows[6 + k];
        at.N[k] = at.Ng[k] = rows[9 + k];
    }
    grid.record_sets[handle] = make_records(grid, at);
    return int32_t(handle);
}

}  // namespace kinora

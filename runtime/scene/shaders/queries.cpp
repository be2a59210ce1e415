// runtime/scene/shaders/queries.cpp: parameters of other shaders, and the service that all
// questions go through.
#include "runtime/scene/shaders/queries.h"

#include <algorithm>
#include <bit>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "runtime/scene/scene.h"
#include "runtime/scene/spaces.h"

namespace kinora {

namespace {

using rsl::QueryKind;

char letter_of(rsl::BaseType type) {
    return "fcpvnms"[int(type)];
}

// A triple is read as any triple; all else must be of the parameter's type.
bool fits(const Query& query, rsl::Type type) {
    Query own{{}, letter_of(type.base)};
    bool same = query.type == own.type || (query.triple() && own.triple());
    bool array = query.element == rsl::kQueryLength ||
                 (query.element >= 0 && query.length == type.array_length);
    return same && (type.is_array() ? array : query.element == -1);
}

// A point, vector or normal in "current" space.
void to_current(rsl::BaseType type, const dmat4& current_from_space, const double* values,
                QueryAnswer& answer) {
    dvec3 current = parameter_in_current(type, current_from_space, values);
    for (uint32_t c = 0; c < 3; ++c) answer[c] = float(current[int(c)]);
}

// The row of the surface that the point lies on, for a light the point it lights; kNone: none.
uint32_t surface_row(const Asker& asker) {
    if (!asker.seen) return kNone;
    const PicturePoints& seen = asker.seen->of_surface();
    return seen.hits.instance[seen.points[asker.point + asker.seen->lit_first]];
}

// The same from the look's "shader" space: a surface's is that of what wears it.
void to_current(rsl::BaseType type, const Asker& asker, const ShaderInstance& look,
                const double* values, QueryAnswer& answer) {
    SpaceOwner owner = look.space_owner();
    uint32_t row = owner.node == kNone ? surface_row(asker) : kNone;
    if (row != kNone && asker.shapes.surfaces[row].look == look.index)
        owner.node = asker.shapes.shapes[asker.shapes.surfaces[row].shape].node;
    to_current(type, current_from_space(asker.nodes, asker.pose, "shader", owner), values, answer);
}

rsl::BaseType parameter_type(const ShaderUse& use, std::string_view name) {
    for (const rsl::ShaderParameter& p : use.shader->parameters)
        if (p.name == name) return p.type.base;
    return rsl::BaseType::Float;
}

// Bound to a vertex input: at hand where the surface's own kernel reads it, else made here.
bool from_vertices(const Asker& asker, const ShaderInstance& look, uint32_t layer,
                   const Query& query, QueryAnswer& answer, bool* varying) {
    *varying = false;
    for (size_t which = 0; which < look.varying.size(); ++which) {
        const VaryingParam& v = look.varying[which];
        if (v.layer != layer || v.name != query.name) continue;
        *varying = true;
        if (!asker.seen) return false;
        const PicturePoints& seen = asker.seen->of_surface();
        size_t point = asker.point + asker.seen->lit_first;
        uint32_t hit = seen.points[point], row = seen.hits.instance[hit];
        if (row == kNone ||
            asker.shaders.shader_instances[asker.shapes.surfaces[row].look].get() != &look)
            return false;
        uint32_t count = uint32_t(query.components());
        uint32_t first = query.element > 0 ? uint32_t(query.element) * count : 0;
        for (uint32_t c = 0; c < count; ++c) {
            bool read = seen.look == &look && v.column != kNoColumn &&
                        seen.columns.size() > size_t(v.column + first + c);
            const float* column = read ? seen.columns[v.column + first + c] : nullptr;
            answer[c] = column ? column[point]
                               : varying_at(asker.shapes, asker.pose, look, seen.hits, hit, which,
                                            first + c);
        }
        rsl::BaseType type = parameter_type(look.layers[layer], v.name);
        if (rsl::is_spatial(type) && !v.of_displacement()) {  // the mesh's: in the object's space
            uint32_t shape = asker.shapes.surfaces[row].shape;
            const double values[] = {answer[0], answer[1], answer[2]};
            to_current(type,
                       current_from_space(asker.nodes, asker.pose, "object",
                                          asker.shapes.shapes[shape].node),
                       values, answer);
        }
        return true;
    }
    return false;
}

bool from_source(const Asker& asker, const ShaderInstance& look, const ParamSource& source,
                 rsl::Type type, const Query& query, QueryAnswer& answer) {
    size_t element = size_t(std::max(query.element, 0));
    if (type.base == rsl::BaseType::String) {
        if (element >= source.strings.size()) return false;
        answer[0] = jit::float_of(rsl::intern(source.strings[element]));
        return true;
    }
    if (!source.value.present()) return false;
    const double* values = &asker.pose.values[source.value.offset];
    uint32_t count = source.value.count, width = uint32_t(rsl::component_count(type.base));
    auto number = [&](uint32_t c) {
        if (source.by_columns && width == 16) c = c % 4 * 4 + c / 4;
        return count == 1 ? values[0] : values[std::min(uint32_t(element) * width + c, count - 1)];
    };
    if (rsl::is_spatial(type.base) && count >= 3) {
        to_current(type.base, asker, look, values + std::min(uint32_t(element) * width, count - 3),
                   answer);
        return true;
    }
    for (uint32_t c = 0; c < width; ++c) answer[c] = float(number(c));
    return true;
}

bool from_default(const Asker& asker, const ShaderInstance& look,
                  const rsl::ShaderParameter& parameter, const Query& query, QueryAnswer& answer) {
    if (!parameter.constant) return false;
    size_t element = size_t(std::max(query.element, 0));
    const rsl::ConstantValue& value = *parameter.constant;
    if (parameter.type.base == rsl::BaseType::String) {
        if (element >= value.strings.size()) return false;
        answer[0] = jit::float_of(rsl::intern(value.strings[element]));
        return true;
    }
    size_t width = size_t(rsl::component_count(parameter.type.base));
    if ((element + 1) * width > value.numbers.size()) return false;
    const float* numbers = value.numbers.data() + element * width;
    if (value.in_shader_space) {
        const double values[] = {numbers[0], numbers[1], numbers[2]};
        to_current(parameter.type.base, asker, look, values, answer);
        return true;
    }
    for (size_t c = 0; c < width; ++c) answer[c] = numbers[c];
    return true;
}

const ShaderInstance* look_at(const SceneShaders& scene, uint32_t index) {
    return index < scene.shader_instances.size() ? scene.shader_instances[index].get() : nullptr;
}

// The volume on the side that the ray comes from, or on the other: outside is where Ng points.
const ShaderInstance* volume_of(const Asker& asker, bool opposite) {
    if (!asker.on_surface()) return nullptr;
    const PicturePoints& seen = *asker.seen;
    uint32_t hit = asker.hit();
    float along = 0;
    for (size_t k = 0; k < 3; ++k) along += seen.hits.dir[k][hit] * seen.hits.Ng[k][hit];
    bool from_outside = along < 0;
    const Surface& surface = asker.surface();
    return look_at(asker.shaders, from_outside != opposite ? surface.exterior : surface.interior);
}

uint32_t atmosphere_of(const Asker& asker) {
    uint32_t own = asker.on_surface() ? asker.surface().atmosphere : kNone;
    return own != kNone ? own : asker.shaders.atmosphere;
}

const ShaderInstance* light_of(const Asker& asker) {
    const auto& lights = asker.lights.lights;
    const size_t light = size_t(asker.light);
    return light < lights.size() ? look_at(asker.shaders, lights[light].look) : nullptr;
}

struct Asked {
    const ShaderInstance* look = nullptr;
    rsl::ShaderKind kind = rsl::ShaderKind::Surface;
};

Asked whom(QueryKind kind, const Asker& asker) {
    const ShaderInstance* surface = &asker.look;
    if (asker.seen && asker.seen->surface)
        surface = asker.seen->surface;
    else if (surface->kind != ShaderInstanceKind::Surface)
        surface = asker.on_surface() ? look_at(asker.shaders, asker.surface().look) : nullptr;
    switch (kind) {
        case QueryKind::Surface:
            return {surface, rsl::ShaderKind::Surface};
        case QueryKind::Displacement:
            return {surface, rsl::ShaderKind::Displacement};
        case QueryKind::Atmosphere:
            return {look_at(asker.shaders, atmosphere_of(asker)), rsl::ShaderKind::Volume};
        case QueryKind::Incident:
            return {volume_of(asker, false), rsl::ShaderKind::Volume};
        case QueryKind::Opposite:
            return {volume_of(asker, true), rsl::ShaderKind::Volume};
        case QueryKind::Light:
            return {light_of(asker), rsl::ShaderKind::Light};
        default:
            return {};
    }
}

bool answer_name(const Asker& asker, const Query& query, QueryAnswer& answer) {
    struct Row {
        std::string_view name;
        QueryKind kind;
    };
    constexpr Row kRows[] = {
        {"surface", QueryKind::Surface},       {"displacement", QueryKind::Displacement},
        {"atmosphere", QueryKind::Atmosphere}, {"volume", QueryKind::Atmosphere},
        {"incident", QueryKind::Incident},     {"opposite", QueryKind::Opposite},
        {"interior", QueryKind::Opposite},     {"exterior", QueryKind::Incident}};
    for (const Row& row : kRows) {
        if (row.name != query.name) continue;
        Asked asked = whom(row.kind, asker);
        for (size_t l = asked.look ? asked.look->layers.size() : 0; l-- > 0;) {
            const rsl::Shader& shader = *asked.look->layers[l].shader;
            if (shader.kind != asked.kind) continue;
            answer[0] = jit::float_of(rsl::intern(shader.name));
            return true;
        }
    }
    return false;
}

bool answer_query_at(QueryKind kind, const Asker& asker, const Query& query, QueryAnswer& answer) {
    if (kind == QueryKind::ShaderName) return answer_name(asker, query, answer);
    if (kind <= QueryKind::RayInfo) return answer_fact(kind, asker, query, answer);
    Asked asked = whom(kind, asker);
    return asked.look && answer_parameter(asker, *asked.look, asked.kind, query, answer);
}

}  // namespace

const Surface& Asker::surface() const {
    return shapes.surfaces[seen->hits.instance[hit()]];
}

bool answer_parameter(const Asker& asker, const ShaderInstance& look, rsl::ShaderKind kind,
                      const Query& query, QueryAnswer& answer) {
    for (size_t l = look.layers.size(); l-- > 0;) {
        const ShaderUse& use = look.layers[l];
        if (use.shader->kind != kind) continue;
        for (const rsl::ShaderParameter& parameter : use.shader->parameters) {
            if (parameter.name != query.name) continue;
            if (!fits(query, parameter.type)) return false;
            if (query.element == rsl::kQueryLength) {
                answer[0] = float(parameter.type.array_length);
                return true;
            }
            bool varying;
            if (from_vertices(asker, look, uint32_t(l), query, answer, &varying)) return true;
            if (varying) return false;
            for (const ParamSource& source : use.params)
                if (source.name == parameter.name &&
                    from_source(asker, look, source, parameter.type, query, answer))
                    return true;
            return from_default(asker, look, parameter, query, answer);
        }
    }
    return false;
}

namespace {

// The rows of a call's arguments.
constexpr int kLanes = jit::kMaxLanes, kAskedRows = 5;  // without `point`
int32_t integer(const jit::ServiceCall& call, int row, int lane) {
    return jit::bits_of(call.args[row * kLanes + lane]);
}
Query query_of(const jit::ServiceCall& call, int lane) {
    return {rsl::interned(integer(call, 1, lane)), char(integer(call, 2, lane)),
            integer(call, 3, lane), integer(call, 4, lane)};
}

bool ask_the_same(const jit::ServiceCall& call, int first) {
    uint32_t differs[kLanes] = {};
    for (int row = 0; row < kAskedRows; ++row)
        for (int lane = 0; lane < kLanes; ++lane)
            differs[lane] |= uint32_t(integer(call, row, lane) ^ integer(call, row, first));
    for (uint32_t left = call.mask; left; left &= left - 1)
        if (differs[std::countr_zero(left)]) return false;
    return true;
}

}  // namespace

void answer_query(const Scene& scene, const Pose& pose, const ShaderInstance& look,
                  const PicturePoints* seen, const jit::ServiceCall& call) {
    auto answer_at = [&](int lane, QueryAnswer& answer) {
        Asker asker{scene, scene, scene, scene, pose, look, seen, 0, integer(call, 5, lane)};
        if (seen) asker.point = std::min(size_t(call.first + lane), seen->count() - 1);
        return answer_query_at(QueryKind(integer(call, 0, lane)), asker, query_of(call, lane),
                               answer);
    };
    if (call.mask == 0) return;
    int first = std::countr_zero(call.mask);
    Query query = query_of(call, first);
    if (is_same_for_grid(QueryKind(integer(call, 0, first)), query) && ask_the_same(call, first)) {
        QueryAnswer answer{};
        std::fill_n(call.results, kLanes, jit::float_of(int32_t(answer_at(first, answer))));
        for (int k = 0; k < query.components(); ++k)
            std::fill_n(call.results + (1 + k) * kLanes, kLanes, answer[size_t(k)]);
        return;
    }
    for (int lane = 0; lane < kLanes; ++lane) {
        call.results[lane] = jit::float_of(0);
        QueryAnswer answer{};
        if (!(call.mask >> lane & 1) || !answer_at(lane, answer)) continue;
        call.results[lane] = jit::float_of(1);
        for (int k = 0; k < query_of(call, lane).components(); ++k)
            call.results[(1 + k) * kLanes + lane] = answer[size_t(k)];
    }
}

}  // namespace kinora

// runtime/scene/shaders/query_tables.cpp: the facts that attribute, option, rendererinfo and
// rayinfo know.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "runtime/base/numbers.h"
#include "runtime/scene/names.h"
#include "runtime/scene/nodes.h"
#include "runtime/scene/pose.h"
#include "runtime/scene/shaders.h"
#include "runtime/scene/shaders/queries.h"
#include "runtime/scene/shapes.h"

namespace kinora {

namespace {

// Numbers in a row or one text; `kind` 'p' (point) and 'v' (vector) are in current space.
struct Fact {
    std::array<double, 4> numbers{};
    std::span<const double> list;  // instead of `numbers`, where there may be more
    int count = 0;
    std::string_view text;
    bool is_text = false;

    Fact() = default;
    Fact(double x) : numbers{x}, count(1) {}
    Fact(std::initializer_list<double> few) : count(int(few.size())) {
        std::copy(few.begin(), few.end(), numbers.begin());
    }
    explicit Fact(std::span<const double> many) : list(many), count(int(many.size())) {}
    Fact(vec3 v) : Fact({double(v.x), double(v.y), double(v.z)}) {}
    Fact(std::string_view s) : text(s), is_text(true) {}
    bool known() const { return count > 0 || is_text; }
    float number(int k) const { return float(list.empty() ? numbers[size_t(k)] : list[size_t(k)]); }
};

using Find = Fact (*)(const Asker& asker);
struct Row {
    std::string_view name;
    Find find;
};

template <int x>
Fact constant(const Asker&) {
    return double(x);
}

// ---- attribute ----------------------------------------------------------------------------------

const NodeDefinition& node_of(const Asker& asker) {
    const Shape& shape = asker.shapes.shapes[asker.surface().shape];
    return asker.nodes.description->nodes[asker.nodes.nodes[shape.node].definition];
}
const ShaderInstance& look_of(const Asker& asker) {
    return *asker.shaders.shader_instances[asker.surface().look];
}

// The material or the mesh may say so.
bool one_sided(const Asker& asker) {
    return asker.shapes.rows[asker.seen->hits.instance[asker.hit()]].hide_backfaces;
}
Fact sides(const Asker& asker) {
    return one_sided(asker) ? 1.0 : 2.0;
}
Fact node_name(const Asker& asker) {
    const NodeDefinition& node = node_of(asker);
    return std::string_view(node.id.empty() ? node.name : node.id);
}
Fact material_name(const Asker& asker) {
    return std::string_view(look_of(asker).name);
}
Fact mesh_name(const Asker& asker) {
    const Mesh& mesh = asker.shapes.meshes[asker.shapes.shapes[asker.surface().shape].mesh];
    return std::string_view(asker.nodes.description->meshes[mesh.definition].id);
}
Fact row_number(const Asker& asker) {
    return double(asker.seen->hits.instance[asker.hit()]);
}
Fact ray_depth(const Asker& asker) {
    return double(asker.nodes.options.quality.ray_depth);
}
Fact diffuse_depth(const Asker& asker) {
    return double(asker.nodes.options.quality.diffuse_depth);
}
Fact backfacing(const Asker& asker) {
    return one_sided(asker) ? 1.0 : 0.0;
}
Fact transmission_mode(const Asker& asker) {
    return std::string_view(look_of(asker).opaque() ? "opaque" : "shader");
}
Fact shader_mode(const Asker&) {
    return std::string_view("shader");
}

constexpr Row kAttributes[] = {
    {"ShadingRate", constant<1>},  // a sample is shaded where it hits
    {"ShadingInterpolation", [](const Asker&) { return Fact(std::string_view("smooth")); }},
    {"Sides", sides},
    {"Matte", constant<0>},
    {"matte", constant<0>},
    {"identifier:name", node_name},
    {"identifier:object", mesh_name},
    {"identifier:shadinggroup", material_name},
    {"identifier:id", row_number},
    {"displacementbound:sphere", constant<0>},
    {"displacementbound:coordinatesystem",
     [](const Asker&) { return Fact(std::string_view("object")); }},
    {"trace:maxspeculardepth", ray_depth},
    {"trace:maxdiffusedepth", diffuse_depth},
    {"trace:displacements", constant<0>},
    {"trace:samplemotion", constant<0>},
    {"trace:bias", constant<0>},
    {"visibility:camera", constant<1>},
    {"visibility:diffuse", constant<1>},
    {"visibility:specular", constant<1>},
    {"visibility:transmission", constant<1>},
    {"visibility:trace", constant<1>},
    {"visibility:photon", constant<0>},
    {"shade:diffusehitmode", shader_mode},
    {"shade:specularhitmode", shader_mode},
    {"shade:camerahitmode", shader_mode},
    {"shade:transmissionhitmode", transmission_mode},
    {"cull:hidden", constant<0>},
    {"cull:backfacing", backfacing},
    {"dice:rasterorient", constant<0>},
};

// ---- option -------------------------------------------------------------------------------------

Fact format(const Asker& asker) {
    return {double(asker.pose.view.width), double(asker.pose.view.height), 1.0};
}
Fact frame_aspect(const Asker& asker) {
    return asker.pose.view.half_width / asker.pose.view.half_height;
}
Fact shutter(const Asker& asker) {
    return {asker.pose.time, asker.pose.time + asker.pose.shutter};
}
Fact clipping(const Asker& asker) {
    return {asker.pose.view.znear, asker.pose.view.zfar};
}
Fact frame(const Asker& asker) {
    return std::round(asker.pose.time * frames_per_second(asker.nodes));
}
Fact projection(const Asker& asker) {
    return std::string_view(asker.pose.view.orthographic ? "orthographic" : "perspective");
}
Fact scene_file(const Asker& asker) {
    return std::string_view(asker.nodes.description->path);
}

constexpr Row kOptions[] = {
    {"Format", format},
    {"DeviceResolution", format},
    {"FrameAspectRatio", frame_aspect},
    {"PixelAspectRatio", constant<1>},
    {"CropWindow",
     [](const Asker&) {
         return Fact({0.0, 1.0, 0.0, 1.0});
     }},
    {"DepthOfField",
     [](const Asker&) {
         return Fact({1e30, 1.0, 1.0});
     }},  // a pinhole
    {"Shutter", shutter},
    {"Clipping", clipping},
    {"Frame", frame},
    {"Projection", projection},
    {"Exposure",
     [](const Asker&) {
         return Fact({1.0, 1.0});
     }},
    {"RelativeDetail", constant<1>},
    {"MaxRayLevel", ray_depth},
    {"trace:maxdepth", ray_depth},
    {"limits:gridsize", [](const Asker&) { return Fact(double(kGridPoints)); }},
    {"limits:bucketsize",
     [](const Asker&) {
         return Fact({64.0, 64.0});
     }},
    {"scene:file", scene_file},
};

// ---- rendererinfo -------------------------------------------------------------------------------

constexpr Row kRenderer[] = {
    {"renderer", [](const Asker&) { return Fact(std::string_view("Kinora")); }},
    {"version",
     [](const Asker&) {
         double v[3] = {};
         int part[3] = {};
         read_numbers<int>(KINORA_VERSION, '.', part);
         std::copy_n(part, 3, v);
         return Fact({v[0], v[1], v[2], 0.0});
     }},
    {"versionstring", [](const Asker&) { return Fact(std::string_view(KINORA_VERSION)); }},
};

// ---- rayinfo ------------------------------------------------------------------------------------

Fact depth(const Asker& asker) {
    return double(asker.seen->depth);
}
Fact kind(const Asker& asker) {
    constexpr std::string_view kNames[] = {"camera", "specular", "diffuse", "transmission"};
    return kNames[size_t(asker.seen->ray.type)];
}
// Nothing is shaded to be kept: neither a cache nor a grid.
Fact intent(const Asker&) {
    return std::string_view("shaderay");
}
Fact label(const Asker& asker) {
    return std::string_view(rsl::interned(asker.seen->ray.label));
}
vec3 of_hit(const Asker& asker, const float* const columns[3]) {
    uint32_t hit = asker.hit();
    return {columns[0][hit], columns[1][hit], columns[2][hit]};
}
Fact origin(const Asker& asker) {
    const EyeSpace& space = asker.seen->space;
    return space.camera_from_accel * (of_hit(asker, asker.seen->hits.org) - space.eye);
}
Fact direction(const Asker& asker) {
    return asker.seen->space.camera_from_accel *
           glm::normalize(of_hit(asker, asker.seen->hits.dir));
}
Fact length(const Asker& asker) {
    vec3 way = of_hit(asker, asker.seen->hits.P) - of_hit(asker, asker.seen->hits.org);
    return double(glm::length(way));
}
Fact specular_depth(const Asker& asker) {
    return double(asker.seen->ray.specular);
}
Fact ray_diffuse_depth(const Asker& asker) {
    return double(asker.seen->ray.diffuse);
}
Fact shadow_depth(const Asker& asker) {
    return asker.seen->ray.type == RayType::Transmission ? 1.0 : 0.0;
}

// Integrators keep no more samples than these.
Fact sample_limit(const Asker& asker) {
    constexpr double kNoLimit = 1e9;
    const uint32_t most = asker.seen->ray.most_samples;
    return most ? double(most) : kNoLimit;
}

// Of a light whose shader leaves them to the renderer.
Fact lamp_samples(const Asker& asker) {
    return double(std::max(asker.seen->lamp_samples, 1u));
}

constexpr Row kRay[] = {
    {"depth", depth},
    {"type", kind},
    {"intent", intent},
    {"shadingintent", intent},
    {"label", label},
    {"origin", origin},
    {"direction", direction},
    {"length", length},
    {"speculardepth", specular_depth},
    {"diffusedepth", ray_diffuse_depth},
    {"shadowdepth", shadow_depth},
    {"samplelimit", sample_limit},
    {"lampsamples", lamp_samples},
};

// -------------------------------------------------------------------------------------------------

std::span<const Row> rows_of(rsl::QueryKind kind_asked) {
    switch (kind_asked) {
        case rsl::QueryKind::Attribute:
            return kAttributes;
        case rsl::QueryKind::Option:
            return kOptions;
        case rsl::QueryKind::RendererInfo:
            return kRenderer;
        case rsl::QueryKind::RayInfo:
            return kRay;
        default:
            return {};
    }
}

// Of rays, by name: what their tag and depth say.
constexpr std::string_view kOfTag[] = {"depth",         "type",         "label",
                                       "speculardepth", "diffusedepth", "shadowdepth",
                                       "samplelimit",   "lampsamples"};

std::string_view plain_name(const Query& query) {
    std::string_view name = query.name;
    if (name.starts_with("Ri:")) name.remove_prefix(3);
    return name;
}

// Several numbers are read as an array no longer than they are, of numbers, triples or matrices;
// three as a triple, sixteen as a matrix.
bool read(const Fact& fact, const Query& query, QueryAnswer& answer) {
    if (fact.is_text) {
        if (query.type != 's' || query.element != -1) return false;
        answer[0] = jit::float_of(rsl::intern(fact.text));
        return true;
    }
    int width = query.components();
    if (query.type == 's') return false;
    if (query.element == rsl::kQueryLength) {
        answer[0] = float(fact.count / width);
        return fact.count % width == 0;
    }
    bool array = query.element >= 0;
    int first = array ? query.element * width : 0;
    bool fits = array ? query.length <= fact.count / width && first + width <= fact.count
                      : fact.count == width;
    for (int k = 0; fits && k < width; ++k) answer[size_t(k)] = fact.number(first + k);
    return fits;
}

// "user:NAME" of the node, else of the nodes above it.
bool user_attribute(const Asker& asker, const Query& query, QueryAnswer& answer) {
    const Shape& shape = asker.shapes.shapes[asker.surface().shape];
    for (uint32_t n = shape.node; n != kNone; n = asker.nodes.nodes[n].parent) {
        const NodeDefinition& node =
            asker.nodes.description->nodes[asker.nodes.nodes[n].definition];
        for (const UserAttribute& user : node.attributes) {
            if (user.name != query.name) continue;
            if (user.numbers.empty()) {
                return read(Fact(std::string_view(user.text)), query, answer);
            }
            return read(Fact(std::span<const double>(user.numbers)), query, answer);
        }
    }
    return false;
}

}  // namespace

bool answer_fact(rsl::QueryKind kind_asked, const Asker& asker, const Query& query,
                 QueryAnswer& answer) {
    bool of_point =
        kind_asked == rsl::QueryKind::Attribute || kind_asked == rsl::QueryKind::RayInfo;
    if (of_point && !asker.seen) return false;
    if (kind_asked == rsl::QueryKind::Attribute && !asker.on_surface()) return false;
    std::string_view name = plain_name(query);
    for (const Row& row : rows_of(kind_asked))
        if (row.name == name) return read(row.find(asker), query, answer);
    return kind_asked == rsl::QueryKind::Attribute && user_attribute(asker, query, answer);
}

bool is_same_for_grid(rsl::QueryKind kind_asked, const Query& query) {
    if (kind_asked == rsl::QueryKind::Option || kind_asked == rsl::QueryKind::RendererInfo)
        return true;
    return kind_asked == rsl::QueryKind::RayInfo &&
           std::find(std::begin(kOfTag), std::end(kOfTag), plain_name(query)) != std::end(kOfTag);
}

}  // namespace kinora

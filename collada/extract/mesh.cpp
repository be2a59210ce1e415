// collada/extract/mesh.cpp: <geometry>: positions, sources, and the primitives on them.
#include <algorithm>
#include <cmath>

#include "collada/extract/primitives_p.h"
#include "collada/text/numbers_p.h"

namespace kinora::collada {

namespace {

bool holds_names(const Element& source) {
    bool numbers = source.child("float_array") || source.child("int_array");
    return !numbers && (source.child("Name_array") || source.child("IDREF_array"));
}

}  // namespace

uint32_t MeshReader::source_index(Link link) {
    auto [at, fresh] = sources.emplace(link.element, kNone);
    if (!fresh) return at->second;
    if (holds_names(*link.element)) return kNone;  // an input of somebody's own
    DoubleSource data = read_double_source(x, link);
    if (data.values.empty()) return kNone;
    bool fits =
        x.budget.reserve(sizeof(FloatSource) + data.values.size() * sizeof(float), x.where(link));
    if (!fits) return kNone;
    FloatSource source{std::string(link.element->value("id")), data.stride, {}};
    source.values.resize(data.values.size());
    // Beyond a float's range counts as not finite, too.
    std::transform(data.values.begin(), data.values.end(), source.values.begin(),
                   [](double v) { return std::abs(v) <= 3.4028234e38 ? float(v) : 0.0f; });
    entries.push_back(uint32_t(source.values.size() / source.stride));
    missing.push_back(kNone);
    return at->second = append(geometry.sources, std::move(source));
}

uint32_t MeshReader::missing_entry(uint32_t source, std::string_view semantic) {
    if (missing[source] != kNone) return missing[source];
    FloatSource& values = geometry.sources[source];
    values.values.insert(values.values.end(), values.stride, semantic == "COLOR" ? 1.0f : 0.0f);
    return missing[source] = entries[source];
}

namespace {

void read_positions(MeshReader& mesh, Link source) {
    DoubleSource data = read_double_source(mesh.x, source);
    if (!mesh.x.budget.reserve(data.count * sizeof(dvec3), mesh.x.where(source))) return;
    mesh.geometry.positions.resize(data.count, dvec3(0.0));
    for (size_t i = 0; i < data.count; ++i) {
        dvec3& p = mesh.geometry.positions[i];
        for (uint32_t k = 0; k < std::min(3u, data.stride); ++k)
            p[int(k)] = data.values[i * data.stride + k];
        if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) continue;
        mesh.bad_position.resize(data.count);
        mesh.bad_position[i] = true;
        p = i > 0 ? mesh.geometry.positions[i - 1] : dvec3(0.0);  // keeps bounds as they are
    }
}

uint32_t read_set(const Element& input) {
    uint64_t set = 0;
    return parse_count(input.value("set"), set) && set < kNone ? uint32_t(set) : 0;
}

bool read_vertices(MeshReader& mesh, Link link) {
    const Element* position = find_input(*link.element, "POSITION");
    if (!position) {
        mesh.x.diag.report(Code::PRIM_NO_POSITION, mesh.x.where(link));
        return false;
    }
    Link source = resolve(mesh.x, {link.doc, position}, "source", {"source"});
    if (!source) return false;
    read_positions(mesh, source);
    mesh.vertices = link.element;
    for (const Element& input : link.element->children()) {
        if (input.name != "input" || input.value("semantic") == "POSITION") continue;
        Link values = resolve(mesh.x, {link.doc, &input}, "source", {"source"});
        uint32_t index = values ? mesh.source_index(values) : kNone;
        if (index == kNone) continue;
        mesh.vertices_inputs.push_back(
            {std::string(input.value("semantic")), read_set(input), index, 0});
    }
    return true;
}

bool read_double_sided(const Element& geometry) {
    for (const Element& extra : geometry.children())
        if (extra.name == "extra")
            for (const Element& technique : extra.children())
                if (const Element* flag = technique.child("double_sided"))
                    return parse_bool(flag->text).value_or(true);
    return true;
}

}  // namespace

uint32_t geometry_index(Extraction& x, Link link) {
    auto [at, fresh] = x.made.emplace(link.element, kNone);
    if (!fresh) return at->second;
    uint32_t& result = at->second;
    const Element* mesh_element = link.element->child("mesh");
    if (const Element* convex = mesh_element ? nullptr : link.element->child("convex_mesh")) {
        if (convex->attribute("convex_hull_of")) {
            Link whole = resolve(x, {link.doc, convex}, "convex_hull_of", {"geometry"});
            if (!whole) return kNone;
            x.diag.report(Code::GEOM_HULL, x.where({link.doc, convex}, "convex_hull_of"),
                          whole.element->value("id"));
            uint32_t index = geometry_index(x, whole);  // a loop of hulls ends at kNone
            return x.made[link.element] = index;
        }
        mesh_element = convex;
    }
    if (!mesh_element) {
        const Element* other = link.element->first_child;
        while (other && (other->name == "asset" || other->name == "extra")) other = other->next;
        x.diag.report(Code::GEOM_KIND, x.where({link.doc, other ? other : link.element}),
                      other ? other->name : link.element->name);
        return result;
    }
    Geometry geometry;
    geometry.id = link.element->value("id");
    geometry.name = link.element->value("name");
    geometry.where = x.where(link);
    geometry.double_sided = read_double_sided(*link.element) && read_double_sided(*mesh_element);
    const Element* vertices = mesh_element->child("vertices");
    if (!vertices) {
        x.diag.report(Code::SCHEMA_MISSING_ELEMENT, x.where({link.doc, mesh_element}), "mesh",
                      "vertices");
        return result;
    }
    if (!x.budget.reserve(sizeof(Geometry), geometry.where)) return result;
    MeshReader mesh{x, geometry, {}, {}, {}, nullptr, {}, {}};
    if (!read_vertices(mesh, {link.doc, vertices})) return result;
    for (const Element& child : mesh_element->children())
        if (is_triangulated(child.name) || child.name == "lines" || child.name == "linestrips")
            read_primitive(mesh, {link.doc, &child});
    x.geometry_frames.push_back(x.frames.of(link));
    return result = append(x.scene.geometries, std::move(geometry));
}

}  // namespace kinora::collada

// collada/extract/primitives.cpp: inputs and indices of one primitive element become a group.
#include <algorithm>

#include "collada/extract/primitives_p.h"
#include "collada/text/numbers_p.h"

namespace kinora::collada {

namespace {

constexpr uint32_t kMaxOffset = 1 << 16;

// What the numbers at one offset of <p> point into.
struct OffsetUse {
    uint32_t offset;
    uint32_t limit;        // entries of the shortest source at this offset
    std::string semantic;  // of that source, for findings
};

struct Inputs {
    bool has_vertex = false;
    uint32_t stride = 1;
    std::vector<OffsetUse> offsets;  // [0] is VERTEX's
    std::vector<VertexInput> inputs;
};

uint32_t entry_count(const FloatSource& source) {
    return uint32_t(source.values.size() / source.stride);
}

// The list of an offset; several inputs share one.
uint32_t use_offset(Inputs& inputs, uint32_t offset, uint32_t limit, std::string_view semantic) {
    for (uint32_t i = 0; i < inputs.offsets.size(); ++i) {
        OffsetUse& use = inputs.offsets[i];
        if (use.offset != offset) continue;
        if (limit < use.limit) use.limit = limit, use.semantic = semantic;
        return i;
    }
    return append(inputs.offsets, OffsetUse{offset, limit, std::string(semantic)});
}

uint32_t input_offset(Extraction& x, Link input) {
    uint64_t offset = 0;
    const Attribute* a = input.element->attribute("offset");
    if (!a) return 0;  // check_elements reports it
    if (parse_count(a->value, offset) && offset < kMaxOffset) return uint32_t(offset);
    x.diag.report(Code::PRIM_INPUT, x.where(input, "offset"), input.element->value("semantic"),
                  std::string("its offset is no number in range"));
    return kNone;
}

void add_vertices_inputs(MeshReader& mesh, Inputs& inputs) {
    for (const VertexInput& input : mesh.vertices_inputs) {
        uint32_t entries = entry_count(mesh.geometry.sources[input.source]);
        if (entries < mesh.geometry.positions.size()) {
            mesh.x.diag.report(Code::PRIM_INPUT, mesh.geometry.where, input.semantic,
                               fmt::format("it has {} entries for {} positions", entries,
                                           mesh.geometry.positions.size()));
            continue;
        }
        inputs.inputs.push_back(input);
    }
}

void add_input(MeshReader& mesh, Link link, uint32_t offset, Inputs& inputs) {
    std::string_view semantic = link.element->value("semantic");
    Link source = resolve(mesh.x, link, "source", {"source"});
    uint32_t index = source ? mesh.source_index(source) : kNone;
    if (index == kNone) {
        mesh.x.diag.report(Code::PRIM_INPUT, mesh.x.where(link), semantic,
                           std::string("its source has no values"));
        return;
    }
    uint64_t set = 0;
    if (!parse_count(link.element->value("set"), set) || set >= kNone) set = 0;
    uint32_t list = use_offset(inputs, offset, entry_count(mesh.geometry.sources[index]), semantic);
    inputs.inputs.push_back({std::string(semantic), uint32_t(set), index, list});
}

Inputs read_inputs(MeshReader& mesh, Link primitive) {
    Inputs inputs;
    std::vector<std::pair<Link, uint32_t>> others;
    for (const Element& child : primitive.element->children()) {
        if (child.name != "input") continue;
        Link link{primitive.doc, &child};
        uint32_t offset = input_offset(mesh.x, link);
        if (offset == kNone) continue;
        inputs.stride = std::max(inputs.stride, offset + 1);
        if (child.value("semantic") != "VERTEX") {
            others.push_back({link, offset});
        } else if (!inputs.has_vertex) {
            inputs.has_vertex = true;
            inputs.offsets.insert(inputs.offsets.begin(),
                                  {offset, uint32_t(mesh.geometry.positions.size()), "VERTEX"});
        }
    }
    if (!inputs.has_vertex) return inputs;
    add_vertices_inputs(mesh, inputs);
    for (auto& [link, offset] : others) add_input(mesh, link, offset, inputs);
    return inputs;
}

// The location of number `n` of the joined <p>.
Location number_location(Extraction& x, Link primitive, const PrimitiveIndices& p, size_t n) {
    size_t vertex = n / p.stride;
    auto after = std::upper_bound(p.parts.begin(), p.parts.end(), vertex,
                                  [](size_t v, const auto& part) { return v < part.first; });
    const PrimitiveIndices::Part& part = after[-1];
    size_t skip = n - size_t(part.first) * p.stride;
    std::string_view word = word_number(part.element->text, skip);
    if (word.empty()) return x.where({primitive.doc, part.element});
    size_t begin = size_t(word.data() - part.element->text.data());
    return x.document(primitive.doc).text_location(*part.element, begin, begin + word.size());
}

// The first vertex from `v` on whose number at the offset is beyond what it points into.
uint32_t next_beyond(const PrimitiveIndices& p, const OffsetUse& use, uint32_t v, uint32_t count) {
    const int32_t* numbers = p.numbers.data() + use.offset;
    while (v < count && uint32_t(numbers[size_t(v) * p.stride]) < use.limit) ++v;
    return v;
}

// Which vertices name only what exists; empty when all do. Reports the first bad one.
std::vector<bool> usable_vertices(MeshReader& mesh, Link primitive, const PrimitiveIndices& p,
                                  const Inputs& inputs) {
    std::vector<bool> usable;
    const uint32_t count = p.vertex_count();
    auto reject = [&](uint32_t vertex) {
        if (usable.empty()) usable.assign(count, true);
        usable[vertex] = false;
    };
    for (const OffsetUse& use : inputs.offsets) {
        uint32_t v = next_beyond(p, use, 0, count);
        if (v == count) continue;
        size_t number = size_t(v) * p.stride + use.offset;
        Location where = number_location(mesh.x, primitive, p, number);
        int32_t index = p.numbers[number];
        if (index < 0)
            mesh.x.diag.report(Code::PRIM_INDEX_NEGATIVE, where, index);
        else
            mesh.x.diag.report(Code::PRIM_INDEX_RANGE, where, index, use.semantic, use.limit);
        for (; v < count; v = next_beyond(p, use, v + 1, count)) reject(v);
    }
    if (mesh.bad_position.empty()) return usable;
    for (uint32_t v = 0; v < count; ++v) {
        uint32_t position = uint32_t(p.numbers[size_t(v) * p.stride + inputs.offsets[0].offset]);
        if (position < mesh.bad_position.size() && mesh.bad_position[position]) reject(v);
    }
    return usable;
}

}  // namespace

void read_primitive(MeshReader& mesh, Link primitive) {
    const Element& e = *primitive.element;
    Inputs inputs = read_inputs(mesh, primitive);
    if (!inputs.has_vertex) {
        mesh.x.diag.report(Code::PRIM_NO_VERTEX, mesh.x.where(primitive), e.name);
        return;
    }
    PolygonList polygons;
    PrimitiveIndices p = read_indices(mesh.x, primitive, inputs.stride, polygons);
    if (p.vertex_count() == 0) {
        mesh.x.diag.report(Code::PRIM_EMPTY, mesh.x.where(primitive), e.name);
        return;
    }
    std::vector<bool> usable = usable_vertices(mesh, primitive, p, inputs);
    if (!is_triangulated(e.name)) {
        mesh.geometry.line_count += count_lines(mesh.x, primitive, p, polygons);
        return;
    }
    std::vector<uint32_t> triangles =
        triangles_of(mesh, primitive, p, polygons, usable, inputs.offsets[0].offset);
    if (triangles.empty()) {
        mesh.x.diag.report(Code::PRIM_EMPTY, mesh.x.where(primitive), e.name);
        return;
    }
    PrimitiveGroup group;
    group.material = e.value("material");
    group.inputs = std::move(inputs.inputs);
    group.where = mesh.x.where(primitive);
    for (const OffsetUse& use : inputs.offsets) {
        std::vector<uint32_t>& list = group.indices.emplace_back(triangles.size());
        const int32_t* numbers = p.numbers.data() + use.offset;
        for (size_t i = 0; i < list.size(); ++i)
            list[i] = uint32_t(numbers[size_t(triangles[i]) * p.stride]);
    }
    mesh.geometry.groups.push_back(std::move(group));
}

}  // namespace kinora::collada

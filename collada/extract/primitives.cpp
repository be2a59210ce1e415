// collada/extract/primitives.cpp: inputs and indices of one primitive element become a group.
#include <fmt/format.h>

#include <algorithm>

#include "collada/extract/primitives_p.h"
#include "collada/text/numbers_p.h"

namespace kinora::collada {

namespace {

constexpr uint32_t kMaxOffset = 1 << 16;

struct Inputs {
    bool has_vertex = false;
    uint32_t stride = 1;
    std::vector<uint32_t> offsets;    // each once; [0] is VERTEX's
    std::vector<VertexInput> inputs;  // a list is first the number of an offset
};

// The list of an offset; several inputs share one.
uint32_t use_offset(Inputs& inputs, uint32_t offset) {
    for (uint32_t i = 0; i < inputs.offsets.size(); ++i)
        if (inputs.offsets[i] == offset) return i;
    return append(inputs.offsets, offset);
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
        uint32_t entries = mesh.entries[input.source];
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
    inputs.inputs.push_back(
        {std::string(semantic), uint32_t(set), index, use_offset(inputs, offset)});
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
            inputs.offsets.insert(inputs.offsets.begin(), offset);
        }
    }
    if (!inputs.has_vertex) return inputs;
    add_vertices_inputs(mesh, inputs);
    for (auto& [link, offset] : others) add_input(mesh, link, offset, inputs);
    return inputs;
}

// Number `n` of the joined <p> as its element writes it; "" where that cannot be told.
struct WrittenNumber {
    const Element* element;
    std::string_view word;
};

WrittenNumber written_number(const PrimitiveIndices& p, size_t n) {
    size_t vertex = n / p.stride;
    auto after = std::upper_bound(p.parts.begin(), p.parts.end(), vertex,
                                  [](size_t v, const auto& part) { return v < part.first; });
    const PrimitiveIndices::Part& part = after[-1];
    size_t skip = n - size_t(part.first) * p.stride;
    return {part.element, word_number(part.element->text, skip)};
}

Location number_location(Extraction& x, Link primitive, const WrittenNumber& number) {
    const Element& element = *number.element;
    if (number.word.empty()) return x.where({primitive.doc, &element});
    size_t begin = size_t(number.word.data() - element.text.data());
    return x.document(primitive.doc).text_location(element, begin, begin + number.word.size());
}

// The first vertex from `v` on whose number at the offset is `limit` or beyond.
uint32_t next_beyond(const PrimitiveIndices& p, uint32_t offset, uint32_t limit, uint32_t v = 0) {
    const int32_t* numbers = p.numbers.data() + offset;
    while (v < p.vertex_count() && uint32_t(numbers[size_t(v) * p.stride]) < limit) ++v;
    return v;
}

void report_index(MeshReader& mesh, Link primitive, const PrimitiveIndices& p, size_t number,
                  std::string_view semantic, uint32_t limit) {
    WrittenNumber written = written_number(p, number);
    Location where = number_location(mesh.x, primitive, written);
    int32_t read = p.numbers[number];
    std::string index = written.word.empty() ? fmt::to_string(read) : std::string(written.word);
    if (read < 0)
        mesh.x.diag.report(Code::PRIM_INDEX_NEGATIVE, where, index);
    else
        mesh.x.diag.report(Code::PRIM_INDEX_RANGE, where, index, semantic, limit);
}

// Which vertices have a position; empty when all do. Reports the first that names none.
std::vector<bool> usable_vertices(MeshReader& mesh, Link primitive, const PrimitiveIndices& p,
                                  uint32_t offset) {
    std::vector<bool> usable;
    const uint32_t count = p.vertex_count();
    auto reject = [&](uint32_t vertex) {
        if (usable.empty()) usable.assign(count, true);
        usable[vertex] = false;
    };
    uint32_t limit = uint32_t(mesh.geometry.positions.size());
    uint32_t bad = next_beyond(p, offset, limit);
    if (bad < count)
        report_index(mesh, primitive, p, size_t(bad) * p.stride + offset, "VERTEX", limit);
    for (; bad < count; bad = next_beyond(p, offset, limit, bad + 1)) reject(bad);
    if (mesh.bad_position.empty()) return usable;
    for (uint32_t v = 0; v < count; ++v) {
        uint32_t position = uint32_t(p.numbers[size_t(v) * p.stride + offset]);
        if (position < mesh.bad_position.size() && mesh.bad_position[position]) reject(v);
    }
    return usable;
}

// Inputs with an index beyond their source get a list of their own, in which it names a stand-in.
void mend_values(MeshReader& mesh, Link primitive, const PrimitiveIndices& p,
                 const std::vector<uint32_t>& offsets, PrimitiveGroup& group) {
    std::vector<VertexInput> kept;
    for (VertexInput& input : group.inputs) {
        uint32_t limit = mesh.entries[input.source];
        const std::vector<uint32_t>& list = group.indices[input.list];
        bool sound = std::all_of(list.begin(), list.end(), [&](uint32_t i) { return i < limit; });
        if (!sound) {
            uint32_t offset = offsets[input.list], v = next_beyond(p, offset, limit);
            report_index(mesh, primitive, p, size_t(v) * p.stride + offset, input.semantic, limit);
            uint64_t bytes = list.size() * sizeof(uint32_t);
            if (!mesh.x.budget.reserve(bytes, group.where)) continue;  // without the input, then
            uint32_t stand_in = mesh.missing_entry(input.source, input.semantic);
            std::vector<uint32_t> mended = list;
            for (uint32_t& i : mended)
                if (i >= limit) i = stand_in;
            input.list = append(group.indices, std::move(mended));
        }
        kept.push_back(std::move(input));
    }
    group.inputs = std::move(kept);
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
    std::vector<bool> usable = usable_vertices(mesh, primitive, p, inputs.offsets[0]);
    if (!is_triangulated(e.name)) {
        mesh.geometry.line_count += count_lines(mesh.x, primitive, p, polygons);
        return;
    }
    std::vector<uint32_t> triangles =
        triangles_of(mesh, primitive, p, polygons, usable, inputs.offsets[0]);
    if (triangles.empty()) {
        mesh.x.diag.report(Code::PRIM_EMPTY, mesh.x.where(primitive), e.name);
        return;
    }
    PrimitiveGroup group;
    group.material = e.value("material");
    group.inputs = std::move(inputs.inputs);
    group.where = mesh.x.where(primitive);
    for (uint32_t offset : inputs.offsets) {
        std::vector<uint32_t>& list = group.indices.emplace_back(triangles.size());
        const int32_t* numbers = p.numbers.data() + offset;
        for (size_t i = 0; i < list.size(); ++i)
            list[i] = uint32_t(numbers[size_t(triangles[i]) * p.stride]);
    }
    mend_values(mesh, primitive, p, inputs.offsets, group);
    mesh.geometry.groups.push_back(std::move(group));
}

}  // namespace kinora::collada

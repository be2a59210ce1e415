// collada/extract/primitives.cpp: inputs and indices of one primitive element become a group.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "collada/extract/primitives_p.h"
#include "collada/text/numbers_p.h"

namespace kinora::collada {

namespace {

constexpr uint32_t kMaxOffset = 1 << 16;
constexpr size_t kMostTexcoords = 8;  // that inputs of other names stand for

struct Inputs {
    bool has_vertex = false;
    uint32_t stride = 1;
    std::vector<uint32_t> offsets;    // each once; [0] is VERTEX's
    std::vector<VertexInput> inputs;  // a list is first the number of an offset
    std::map<std::pair<std::string, uint32_t>, uint32_t> first;  // of a semantic and set: in inputs
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

// The first of two inputs with one semantic and set counts, so that all programs read the same one;
// inputs of <vertices> come before others.
// The second is left out here, so that all readers of the group show the same one.
void add_first_of_set(MeshReader& mesh, Location where, std::string_view set, VertexInput input,
                      Inputs& inputs) {
    auto [at, fresh] =
        inputs.first.try_emplace({input.semantic, input.set}, uint32_t(inputs.inputs.size()));
    const VertexInput* known = fresh ? nullptr : &inputs.inputs[at->second];
    if (!known)
        inputs.inputs.push_back(std::move(input));
    else if (known->source != input.source || known->list != input.list)
        mesh.x.diag.report(Code::PRIM_SET_TWICE, where, input.semantic,
                           set.empty() ? "no set" : fmt::format("set {}", set));
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
        add_first_of_set(mesh, mesh.geometry.where, "", input, inputs);
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
    add_first_of_set(mesh, mesh.x.where(link), link.element->value("set"),
                     {std::string(semantic), uint32_t(set), index, use_offset(inputs, offset)},
                     inputs);
}

// "UV", and TEXCOORD with its set's number behind it.
bool names_texcoords(std::string_view semantic) {
    constexpr std::string_view kTexcoord = "TEXCOORD";
    if (semantic == "UV") return true;
    if (!semantic.starts_with(kTexcoord)) return false;
    uint64_t set = 0;
    return parse_count(semantic.substr(kTexcoord.size()), set);
}

// Without a TEXCOORD, inputs that are meant as such stand for the sets 0, 1 ... besides.
void add_texcoords(MeshReader& mesh, Location where, Inputs& inputs) {
    std::vector<VertexInput> meant;
    for (const VertexInput& input : inputs.inputs) {
        if (input.semantic == "TEXCOORD") return;
        if (meant.size() < kMostTexcoords && names_texcoords(input.semantic))
            meant.push_back(input);
    }
    for (uint32_t set = 0; set < meant.size(); ++set) {
        mesh.x.diag.report(Code::PRIM_TEXCOORD_NAME, where, meant[set].semantic, set);
        meant[set].semantic = "TEXCOORD";
        meant[set].set = set;
        inputs.inputs.push_back(std::move(meant[set]));
    }
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
    add_texcoords(mesh, mesh.x.where(primitive), inputs);
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

// collada/extract/primitives_p.h: the parts of one primitive element on its way to triangles.
#pragma once

#include "collada/extract/extract_p.h"

namespace kinora::collada {

// The <p> numbers of one primitive element, joined: vertex v is numbers [v*stride, (v+1)*stride).
struct PrimitiveIndices {
    struct Part {
        const Element* element;  // a <p> or <h>
        uint32_t first;          // its first vertex
    };
    std::vector<int32_t> numbers;
    std::vector<Part> parts;
    uint32_t stride = 1;
    uint32_t vertex_count() const { return uint32_t(numbers.size() / stride); }
};

// A polygon: loops of vertices, the outline first.
struct PolygonList {
    std::vector<uint32_t> loop_sizes;
    std::vector<uint32_t> loops_of;  // loops of each polygon
    std::vector<uint32_t> first;     // first vertex of each polygon
};

// Reads all <p>, <ph> of the element. `polygons` gets the outlines of <polygons>.
PrimitiveIndices read_indices(Extraction& x, Link primitive, uint32_t stride,
                              PolygonList& polygons);

bool is_triangulated(std::string_view name);  // triangles polylist polygons tristrips trifans

struct MeshReader {
    Extraction& x;
    Geometry& geometry;
    std::vector<bool> bad_position;                        // not finite; empty: none
    std::unordered_map<const Element*, uint32_t> sources;  // <source> -> index; kNone: unusable
    std::vector<VertexInput> vertices_inputs;              // of <vertices>, without POSITION
    const Element* vertices = nullptr;

    std::vector<uint32_t> entries,
        missing;  // of each source: the file's, and the stand-in's number

    uint32_t source_index(Link source);
    // An entry behind the file's own for corners that name none: white for colours, else 0 (a
    // normal that vanishes gives way to the face's).
    uint32_t missing_entry(uint32_t source, std::string_view semantic);
};

// Adds the triangles of one element to the geometry.
void read_primitive(MeshReader& mesh, Link primitive);

// Segments of a <lines> or <linestrips>; checks its count.
uint32_t count_lines(Extraction& x, Link primitive, const PrimitiveIndices& p,
                     const PolygonList& strips);

// Vertex numbers, three a triangle; only vertices with `usable` are named (empty: all are).
std::vector<uint32_t> triangles_of(MeshReader& mesh, Link primitive, const PrimitiveIndices& p,
                                   const PolygonList& polygons, const std::vector<bool>& usable,
                                   uint32_t position_offset);

}  // namespace kinora::collada

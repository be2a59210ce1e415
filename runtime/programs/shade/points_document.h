// runtime/programs/shade/points_document.h: the file of `run --points`: points of one's own and the
// world that shaders see there (docs/shade.md#points).
#pragma once

#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "runtime/base/math.h"

namespace kinora {

// What is wrong with the file, for its writer.
struct PointsError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// Numbers or texts in nested lists, of one length at each depth.
struct PointsValue {
    std::vector<size_t> lengths;  // outermost first; none: a single number or text
    std::vector<double> numbers;
    std::vector<std::string> texts;
    bool flat = false;  // from elsewhere: only how many they are is known

    bool is_text() const { return !texts.empty(); }
    size_t size() const { return is_text() ? texts.size() : numbers.size(); }
};
using PointsValues = std::map<std::string, PointsValue>;

struct PointsShader {
    std::string handle, file, shader;  // file: as the working directory finds it; shader "": first
    PointsValues parameters;           // points, vectors and normals in "shader" space
    dmat4 current_from_shader{1.0};
};

struct PointsDocument {
    size_t count = 1;
    size_t columns = 0, rows = 0;  // of the grid, columns first; 0: none
    PointsValues variables;        // points, vectors and normals in "current" space
    PointsValues parameters;
    std::map<std::string, dmat4> spaces;  // current from the space; others are current
    std::vector<PointsShader> lights;
    std::vector<PointsShader> co_shaders;  // in the shader's own space
    std::optional<PointsShader> displacement;
    PointsValues options, attributes, rayinfo, rendererinfo;
};

// Throws PointsError.
PointsDocument read_points_document(const std::string& path);

// "a number", "a list of 4 lists of 3 numbers".
std::string points_shape(const std::vector<size_t>& lengths, bool text);

}  // namespace kinora

// runtime/programs/shade/points_document.cpp: reads the JSON of `run --points`.
#include "runtime/programs/shade/points_document.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>

#include "runtime/base/diagnostic.h"

namespace kinora {

namespace {

using Json = nlohmann::json;

constexpr size_t kMostPoints = size_t(1) << 22;
constexpr size_t kDeepestList = 4;

[[noreturn]] void fail(const std::string& text) {
    throw PointsError(text);
}

void read_list(const Json& json, const std::string& where, size_t depth, PointsValue& out) {
    if (!json.is_array()) {
        if (depth != out.lengths.size()) fail(where + ": its lists are not equally deep");
        bool text = json.is_string();
        if (!text && !json.is_number() && !json.is_boolean())
            fail(fmt::format("{}: a {} stands where a number or a text is expected", where,
                             json.type_name()));
        if (text ? !out.numbers.empty() : !out.texts.empty())
            fail(where + ": numbers and texts are mixed");
        if (text)
            out.texts.push_back(json.get<std::string>());
        else
            out.numbers.push_back(json.is_boolean() ? double(json.get<bool>())
                                                    : json.get<double>());
        return;
    }
    if (json.empty()) fail(where + ": an empty list");
    if (depth == kDeepestList)
        fail(fmt::format("{}: lists are nested {} deep at most", where, kDeepestList));
    if (depth == out.lengths.size()) {
        if (out.size() > 0) fail(where + ": its lists are not equally deep");
        out.lengths.push_back(json.size());
    }
    if (json.size() != out.lengths[depth])
        fail(fmt::format("{}: a list of {} stands among lists of {}", where, json.size(),
                         out.lengths[depth]));
    for (const Json& item : json) read_list(item, where, depth + 1, out);
}

PointsValue value_of(const Json& json, const std::string& where) {
    PointsValue value;
    read_list(json, where, 0, value);
    return value;
}

PointsValues values_of(const Json& json, const std::string& where) {
    if (!json.is_object()) fail(where + ": takes names with their values, as {\"Kd\": 0.5}");
    PointsValues values;
    for (const auto& [name, item] : json.items()) values[name] = value_of(item, where + "." + name);
    return values;
}

std::string text_of(const Json& json, const std::string& where) {
    if (!json.is_string()) fail(where + ": takes a text");
    return json.get<std::string>();
}

// Sixteen numbers as RiTransform takes them: of row vectors, the translation last.
dmat4 matrix_of(const Json& json, const std::string& where) {
    PointsValue value = value_of(json, where);
    if (value.numbers.size() != 16)
        fail(where + ": takes the 16 numbers of a matrix, row by row, the translation last");
    dmat4 matrix;
    for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = value.numbers[size_t(i)];
    double determinant = glm::determinant(matrix);
    if (!std::isfinite(determinant) || determinant == 0)
        fail(where + ": the matrix has no inverse");
    return matrix;
}

size_t number_of(const Json& json, const std::string& where) {
    if (!json.is_number_integer() || json.get<double>() < 1 ||
        json.get<double>() > double(kMostPoints))
        fail(fmt::format("{}: takes a whole number from 1 to {}", where, kMostPoints));
    return json.get<size_t>();
}

// What may stand in an object: a name, and what reads it.
struct Entry {
    const char* name;
    std::function<void(const Json&, const std::string& where)> read;
};

void read_entries(const Json& json, const std::string& where, const std::vector<Entry>& entries) {
    if (!json.is_object()) fail((where.empty() ? "the file" : where) + ": takes an object {...}");
    for (const auto& [name, item] : json.items()) {
        std::vector<std::string_view> names;
        const Entry* found = nullptr;
        for (const Entry& entry : entries) {
            names.push_back(entry.name);
            if (name == entry.name) found = &entry;
        }
        std::string place = where.empty() ? name : where + "." + name;
        std::string_view near = nearest_name(name, names);
        if (!found && !near.empty())
            fail(fmt::format("'{}' is not known; did you mean '{}'?", place, near));
        if (!found)
            fail(fmt::format("'{}' is not known; known are {}", place, fmt::join(names, ", ")));
        found->read(item, place);
    }
}

PointsShader shader_of(const Json& json, const std::string& where, const std::string& folder) {
    PointsShader shader;
    read_entries(
        json, where,
        {{"handle", [&](auto& item, auto& at) { shader.handle = text_of(item, at); }},
         {"file",
          [&](auto& item, auto& at) {
              std::string file = text_of(item, at);
              shader.file = file.starts_with("/") ? file : folder + file;
          }},
         {"shader", [&](auto& item, auto& at) { shader.shader = text_of(item, at); }},
         {"parameters", [&](auto& item, auto& at) { shader.parameters = values_of(item, at); }},
         {"space",
          [&](auto& item, auto& at) { shader.current_from_shader = matrix_of(item, at); }}});
    if (shader.file.empty()) fail(where + ": needs a \"file\", the shader's source");
    return shader;
}

std::vector<PointsShader> read_shaders(const Json& json, const std::string& where,
                                       const std::string& folder) {
    if (!json.is_array()) fail(where + ": takes a list of shaders");
    std::vector<PointsShader> shaders;
    for (size_t l = 0; l < json.size(); ++l) {
        std::string place = fmt::format("{}[{}]", where, l);
        shaders.push_back(shader_of(json[l], place, folder));
        const std::string& handle = shaders.back().handle;
        for (size_t k = 0; k < l && !handle.empty(); ++k)
            if (shaders[k].handle == handle)
                fail(fmt::format("{}: the handle '{}' is taken", place, handle));
    }
    return shaders;
}

std::vector<PointsShader> read_co_shaders(const Json& json, const std::string& where,
                                          const std::string& folder) {
    std::vector<PointsShader> shaders = read_shaders(json, where, folder);
    for (size_t k = 0; k < shaders.size(); ++k) {
        std::string place = fmt::format("{}[{}]", where, k);
        if (shaders[k].handle.empty()) fail(place + ": needs a \"handle\", its name for others");
        if (!shaders[k].shader.empty())
            fail(place + ".shader: a co-shader is the first of its file");
        if (shaders[k].current_from_shader != dmat4(1.0))
            fail(place + ".space: a co-shader is in the space of the shader that calls it");
    }
    return shaders;
}

void read_grid(const Json& json, const std::string& where, PointsDocument& document) {
    if (!json.is_array() || json.size() != 2) fail(where + ": takes [columns, rows]");
    document.columns = number_of(json[0], where + "[0]");
    document.rows = number_of(json[1], where + "[1]");
    if (document.columns * document.rows > kMostPoints)
        fail(fmt::format("{}: at most {} points", where, kMostPoints));
}

// How many points: as the file says, or as P is long, or a float of each point.
void count_points(std::optional<size_t> said, PointsDocument& document) {
    if (document.columns) {
        document.count = document.columns * document.rows;
        if (said && *said != document.count)
            fail(fmt::format("points: {}, but the grid of {} x {} has {}", *said, document.columns,
                             document.rows, document.count));
        return;
    }
    if (said) {
        document.count = *said;
        return;
    }
    for (std::string_view name : {"P", "N", "I", "s", "t", "u", "v", "Cs", "Os"}) {
        auto found = document.variables.find(std::string(name));
        bool triple = name[0] >= 'A' && name[0] <= 'Z';
        size_t depth = triple ? 2 : 1;  // lists around one value a point
        if (found == document.variables.end() || found->second.lengths.size() != depth) continue;
        document.count = found->second.lengths[0];
        return;
    }
}

}  // namespace

std::string points_shape(const std::vector<size_t>& lengths, bool text) {
    const char* noun = text ? "text" : "number";
    if (lengths.empty()) return fmt::format("a {}", noun);
    std::string shape =
        fmt::format("{} {}{}", lengths.back(), noun, lengths.back() == 1 ? "" : "s");
    for (size_t k = lengths.size() - 1; k-- > 0;)
        shape = fmt::format("{} list{} of {}", lengths[k], lengths[k] == 1 ? "" : "s", shape);
    return "a list of " + shape;
}

PointsDocument read_points_document(const std::string& path) {
    std::ifstream file(path);
    if (!file) fail("cannot be read");
    Json json;
    try {
        json = Json::parse(file);
    } catch (const Json::exception& error) {
        std::string text = error.what();
        fail("is no JSON: " + text.substr(text.find("] ") + 2));
    }
    std::string folder = path.substr(0, path.rfind('/') + 1);
    PointsDocument document;
    std::optional<size_t> points;
    auto list = [](PointsValues& values) {
        return [&values](const Json& item, const std::string& at) { values = values_of(item, at); };
    };
    auto spaces = [&](const Json& item, const std::string& at) {
        if (!item.is_object()) fail(at + ": takes names with the 16 numbers of a matrix");
        for (const auto& [name, matrix] : item.items())
            document.spaces[name] = matrix_of(matrix, at + "." + name);
    };
    read_entries(
        json, "",
        {{"points", [&](auto& item, auto& at) { points = number_of(item, at); }},
         {"grid", [&](auto& item, auto& at) { read_grid(item, at, document); }},
         {"variables", list(document.variables)},
         {"parameters", list(document.parameters)},
         {"spaces", spaces},
         {"lights",
          [&](auto& item, auto& at) { document.lights = read_shaders(item, at, folder); }},
         {"coshaders",
          [&](auto& item, auto& at) { document.co_shaders = read_co_shaders(item, at, folder); }},
         {"displacement",
          [&](auto& item, auto& at) { document.displacement = shader_of(item, at, folder); }},
         {"options", list(document.options)},
         {"attributes", list(document.attributes)},
         {"rayinfo", list(document.rayinfo)},
         {"rendererinfo", list(document.rendererinfo)}});
    count_points(points, document);
    return document;
}

}  // namespace kinora

// runtime/scene/ri/calls/declaration.h: what values a token of a parameter list has.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace kinora::ri {

// How many values a primitive has of a variable: one; one a face; one a corner of the parameter
// space; one a control point; one a corner of each face.
enum class StorageClass : uint8_t { Constant, Uniform, Varying, Vertex, FaceVarying };
enum class Type : uint8_t { Float, Integer, String, Color, Point, Vector, Normal, Hpoint, Matrix };

struct Declaration {
    StorageClass storage = StorageClass::Uniform;
    Type type = Type::Float;
    uint32_t array = 0;  // elements; 0: it is no array
    bool operator==(const Declaration&) const = default;

    uint32_t elements() const { return array ? array : 1; }
};

// Numbers (or strings) of one value of the type.
uint32_t components(Type type, uint32_t color_samples);

// "varying color", "point[2]", "uniform  float [ 3 ]", "mpoint": the class is uniform where none is
// named. Nothing: it is no declaration. `name` is what is left behind it, where a caller wants one:
// "uniform float Kd" is a declaration with its name.
std::optional<Declaration> parse_declaration(std::string_view text,
                                             std::string_view* name = nullptr);
// As parse_declaration reads it: "varying color", "constant point[2]".
std::string declaration_text(const Declaration& declaration);

// What RiDeclare said, over the standard ones of the interface.
class Declarations {
  public:
    // Those of 3.2: "P" is a vertex point, and so on.
    static const Declarations& standard();

    void declare(std::string_view name, const Declaration& declaration);
    const Declaration* find(std::string_view name) const;

  private:
    std::map<std::string, Declaration, std::less<>> declared_;
};

}  // namespace kinora::ri

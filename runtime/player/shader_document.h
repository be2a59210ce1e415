// runtime/player/shader_document.h: the shader that is being edited.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace kinora {

// A finding with where it is, for lists and for underlining.
struct FindingText {
    std::string severity, code, message, help;
    std::string file;             // "" none
    int line = 0, column = 0;     // from 1; 0 none
    uint32_t begin = 0, end = 0;  // bytes of the file, or of the edited text
    std::string printed;          // as programs print it, with the source line
};

enum class ParamKind : uint8_t { Float, Color, Point, Vector, Normal, Matrix, Text };

inline constexpr size_t kCurvePoints = 129;

// A parameter of the edited shader, from its declaration.
struct ShaderParamInfo {
    std::string name;
    ParamKind kind = ParamKind::Float;
    bool output = false, varying = false;
    uint32_t length = 0;          // of an array; 0: none
    std::vector<double> numbers;  // what it is now; empty where it varies
    std::string text;
    bool animated = false;
    // Where it is: what the file's keys make of it over the scene's range, in kCurvePoints equal
    // steps of time; all numbers of a step together. Colors as the file has them.
    std::vector<float> curve;
    bool changed = false;  // by hand
};

struct ShaderDocument {
    std::string material;   // "" nothing is being edited
    std::string wearer;     // whose edit the text is: of all that wear it, the first
    std::string file;       // what `save` writes
    std::string name;       // FindingText::file of findings in the text
    bool embedded = false;  // in the scene's file, between <code> tags
    std::string text;
    size_t caret = 0;      // byte of the text
    uint64_t version = 0;  // grows with each change of the text
    uint64_t shown = 0;    // the version that the picture is made with
    bool compiling = false;
    bool dirty = false;                 // not saved
    std::vector<FindingText> findings;  // of the newest version compiled
    double compile_ms = 0;
    std::vector<ShaderParamInfo> params;
};

}  // namespace kinora

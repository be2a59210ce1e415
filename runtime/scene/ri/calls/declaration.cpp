// runtime/scene/ri/calls/declaration.cpp: declarations as text, and the standard ones.
#include "runtime/scene/ri/calls/declaration.h"

#include <algorithm>

#include "runtime/base/numbers.h"

namespace kinora::ri {
namespace {

struct StorageWord {
    std::string_view word;
    StorageClass storage;
};
constexpr StorageWord kStorageWords[] = {
    {"constant", StorageClass::Constant},       {"uniform", StorageClass::Uniform},
    {"varying", StorageClass::Varying},         {"vertex", StorageClass::Vertex},
    {"facevarying", StorageClass::FaceVarying}, {"facevertex", StorageClass::FaceVarying},
};

struct TypeWord {
    std::string_view word;
    Type type;
};
constexpr TypeWord kTypeWords[] = {
    {"float", Type::Float},   {"integer", Type::Integer}, {"string", Type::String},
    {"color", Type::Color},   {"point", Type::Point},     {"vector", Type::Vector},
    {"normal", Type::Normal}, {"hpoint", Type::Hpoint},   {"matrix", Type::Matrix},
    {"int", Type::Integer},   {"mpoint", Type::Matrix},
};

// Words of a declaration: letters, and brackets with what is between them.
class Words {
  public:
    explicit Words(std::string_view text) : rest_(text) {}

    std::string_view next() {
        skip_space();
        size_t n = 0;
        while (n < rest_.size() && !is_space(rest_[n]) && rest_[n] != '[') ++n;
        return take(n);
    }
    // "[3]": 3; nothing behind: 0. Nothing: brackets without a number above 0.
    std::optional<uint32_t> array() {
        skip_space();
        if (rest_.empty() || rest_[0] != '[') return 0;
        size_t end = rest_.find(']');
        if (end == rest_.npos) return std::nullopt;
        std::string_view inside = rest_.substr(1, end - 1);
        rest_.remove_prefix(end + 1);
        while (!inside.empty() && is_space(inside.front())) inside.remove_prefix(1);
        while (!inside.empty() && is_space(inside.back())) inside.remove_suffix(1);
        auto count = number_of<uint32_t>(inside);
        return count && *count > 0 && *count <= kMostElements ? count : std::nullopt;
    }
    std::string_view rest() {
        skip_space();
        while (!rest_.empty() && is_space(rest_.back())) rest_.remove_suffix(1);
        return rest_;
    }

  private:
    static constexpr uint32_t kMostElements = 1 << 20;

    static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
    void skip_space() {
        while (!rest_.empty() && is_space(rest_[0])) rest_.remove_prefix(1);
    }
    std::string_view take(size_t n) {
        std::string_view word = rest_.substr(0, n);
        rest_.remove_prefix(n);
        return word;
    }
    std::string_view rest_;
};

struct StandardRow {
    std::string_view names;  // parted by blanks
    std::string_view declaration;
};
// 3.2, sections 5 and 4, and what renderers of the time added. "Option:limits:gridsize" is the
// token "gridsize" of Option "limits".
constexpr StandardRow kStandard[] = {
    {"P", "vertex point"},
    {"Pw", "vertex hpoint"},
    {"Pz", "vertex float"},
    {"N", "varying normal"},
    {"Np", "uniform normal"},
    {"Cs Os", "varying color"},
    {"s t", "varying float"},
    {"st", "varying float[2]"},
    {"width", "varying float"},
    {"constantwidth", "constant float"},
    {"Ka Kd Ks Kr roughness intensity coneangle conedeltaangle beamdistribution mindistance "
     "maxdistance distance amplitude fov",
     "uniform float"},
    {"from to", "uniform point"},
    {"lightcolor specularcolor background", "uniform color"},
    {"texturename", "uniform string"},
    {"Option:searchpath:shader Option:searchpath:texture Option:searchpath:archive "
     "Option:searchpath:procedural Option:searchpath:display Option:ribparse:varsubst "
     "Option:statistics:filename Option:shutter:offset Option:limits:texturememorytype "
     "Option:rib:format Option:rib:compression",
     "uniform string"},
    {"Option:limits:gridsize Option:limits:texturememory Option:limits:eyesplits "
     "Option:limits:geommemory Option:limits:zthreshold Option:statistics:endofframe "
     "Option:trace:maxdepth Option:render:multipass Option:statistics:echoapi",
     "uniform integer"},
    {"Option:limits:bucketsize", "uniform integer[2]"},
    {"Option:shadow:bias Option:shadow:bias0 Option:shadow:bias1", "uniform float"},
    {"Attribute:identifier:name Attribute:identifier:shadinggroup Attribute:light:shadows "
     "Attribute:render:casts_shadows Attribute:displacementbound:coordinatesystem "
     "Attribute:shade:transmissionhitmode Attribute:shade:diffusehitmode "
     "Attribute:shade:specularhitmode Attribute:grouping:membership Attribute:trimcurve:sense "
     "Attribute:shadow:shadowmapname Attribute:visibility:transmission",
     "uniform string"},
    {"Attribute:visibility:camera Attribute:visibility:diffuse Attribute:visibility:specular "
     "Attribute:visibility:trace Attribute:visibility:indirect Attribute:visibility:photon "
     "Attribute:trace:maxspeculardepth Attribute:trace:maxdiffusedepth "
     "Attribute:trace:displacements Attribute:cull:hidden Attribute:cull:backfacing "
     "Attribute:dice:binary Attribute:dice:rasterorient Attribute:dice:hair "
     "Attribute:render:truedisplacement Attribute:render:visibility Attribute:light:nsamples "
     "Attribute:sides:doubleshaded Attribute:derivatives:centered",
     "uniform integer"},
    {"Attribute:displacementbound:sphere Attribute:bound:displacement Attribute:trace:bias "
     "Display::dither",
     "uniform float"},
    {"Display::quantize", "uniform float[4]"},
    {"Display::exposure", "uniform float[2]"},
};

Declarations make_standard() {
    Declarations made;
    for (const StandardRow& row : kStandard) {
        Words names(row.names);
        for (std::string_view name = names.next(); !name.empty(); name = names.next())
            made.declare(name, *parse_declaration(row.declaration));
    }
    return made;
}

}  // namespace

uint32_t components(Type type, uint32_t color_samples) {
    constexpr uint32_t kComponents[] = {1, 1, 1, 3, 3, 3, 3, 4, 16};
    return type == Type::Color ? color_samples : kComponents[size_t(type)];
}

std::optional<Declaration> parse_declaration(std::string_view text, std::string_view* name) {
    Words words(text);
    Declaration read;
    std::string_view word = words.next();
    auto storage = std::ranges::find(kStorageWords, word, &StorageWord::word);
    if (storage != std::end(kStorageWords)) {
        read.storage = storage->storage;
        word = words.next();
    }
    auto type = std::ranges::find(kTypeWords, word, &TypeWord::word);
    if (type == std::end(kTypeWords)) return std::nullopt;
    read.type = type->type;
    auto array = words.array();
    if (!array) return std::nullopt;
    read.array = *array;
    std::string_view rest = words.rest();
    if (name) *name = rest;
    if (name ? rest.empty() || rest.find(' ') != rest.npos : !rest.empty()) return std::nullopt;
    return read;
}

std::string declaration_text(const Declaration& declaration) {
    std::string text(kStorageWords[size_t(declaration.storage)].word);
    text += ' ';
    text += kTypeWords[size_t(declaration.type)].word;
    if (declaration.array) text += '[' + std::to_string(declaration.array) + ']';
    return text;
}

const Declarations& Declarations::standard() {
    static const Declarations made = make_standard();
    return made;
}

void Declarations::declare(std::string_view name, const Declaration& declaration) {
    declared_.insert_or_assign(std::string(name), declaration);
}

const Declaration* Declarations::find(std::string_view name) const {
    auto found = declared_.find(name);
    return found == declared_.end() ? nullptr : &found->second;
}

}  // namespace kinora::ri

// rsl/model/pairs.cpp: the table of optional parameters, and which of them are results.
#include "rsl/model/pairs.h"

#include <algorithm>

#include "rsl/model/builtin.h"

namespace kinora::rsl {

namespace {

// A row: one optional parameter. texture3d and bake3d take any other name as that of a channel.
struct OptionalParameter {
    std::string_view name;
    BaseType type;            // what its value must be, whoever is called; Invalid: anything
    std::string_view takers;  // built-ins, and gather, that it is no news to, separated by spaces
    bool result = false;      // its value is a variable that the call sets
    // It is known and changes nothing, which is no news where its value is one of these words (what
    // is done anyway); null: it does what it should, or has nothing to change here.
    const char* idle = nullptr;
};

constexpr BaseType kAny = BaseType::Invalid;
constexpr BaseType kNumber = BaseType::Float;
constexpr BaseType kText = BaseType::String;

#define RAYS "trace transmission visibility occlusion indirectdiffuse areashadow"
#define PHOTONS "photonmap caustic subsurface"
#define POINTS "texture3d bake3d"

constexpr OptionalParameter kOptionalParameters[] = {
    // Rays.
    {"samples", kNumber,
     "trace transmission visibility areashadow texture environment shadow bump texture3d " PHOTONS},
    {"samplecone", kNumber, "trace transmission visibility"},
    {"bias", kNumber, RAYS " gather environment shadow"},
    {"maxdist", kNumber, "trace occlusion indirectdiffuse gather environment " PHOTONS},
    {"coneangle", kNumber, "occlusion indirectdiffuse"},
    {"falloff", kNumber, "occlusion"},
    {"falloffmode", kNumber, "occlusion"},
    {"environmentdir", kAny, RAYS, true},
    {"environmentmap", kText, "occlusion indirectdiffuse"},
    {"distribution", kText, "gather"},
    {"distribution", kText, "occlusion indirectdiffuse", false, "cosine"},
    {"subset", kAny, RAYS " gather", false, ""},
    {"excludesubset", kAny, RAYS " gather", false, ""},
    {"othreshold", kAny, RAYS " gather", false, ""},
    {"environmentspace", kAny, "occlusion indirectdiffuse", false, "world"},
    {"environmentcolor", kAny, "occlusion indirectdiffuse", true},
    {"falloff", kNumber, "indirectdiffuse", false, ""},
    {"falloffmode", kNumber, "indirectdiffuse", false, ""},
    {"samplecone", kNumber, "environment", false, ""},
    {"bias0", kNumber, "shadow", false, ""},
    {"bias1", kNumber, "shadow", false, ""},
    {"gapbias", kNumber, "shadow", false, ""},
    {"volume", kAny, "gather"},
    {"lightcache", kAny, "gather"},
    {"source", kNumber, "areashadow"},
    {"gapbias", kNumber, "areashadow", false, ""},
    // What the renderer does anyway, or hints for methods it has no need of.
    {"samplebase", kNumber, RAYS " gather"},
    {"label", kText, RAYS " gather"},
    {"hitmode", kAny, RAYS " gather", false, "default shader"},
    {"hitsides", kAny, RAYS " gather", false, "both"},
    {"minsamples", kAny, RAYS},
    {"maxvariation", kAny, RAYS},
    {"maxerror", kAny, RAYS},
    {"maxpixeldist", kAny, RAYS},
    {"adaptive", kAny, RAYS},
    {"brightnesswarning", kAny, RAYS},
    {"pointbased", kAny, RAYS},
    {"clamp", kAny, RAYS},
    {"maxsolidangle", kAny, RAYS},
    {"sortbleeding", kAny, RAYS},
    {"rayoffset", kAny, RAYS},
    {"filemode", kAny, RAYS},
    {"irradiancefile", kAny, RAYS},
    {"coordsystem", kAny, RAYS},
    {"interpolate", kAny, RAYS},
    {"minsamples", kAny, "shadow environment"},
    // Maps.
    {"blur", kNumber, "texture environment shadow bump areashadow"},
    {"sblur", kNumber, "texture"},
    {"tblur", kNumber, "texture"},
    {"width", kNumber, "texture environment shadow areashadow filterstep"},
    {"swidth", kNumber, "texture environment shadow areashadow filterstep"},
    {"twidth", kNumber, "texture environment shadow areashadow"},
    {"fill", kNumber, "texture environment bump"},
    {"filter", kText, "texture environment shadow areashadow bump filterstep"},
    // Point files.
    {"filename", kText, RAYS " " PHOTONS},
    {"radius", kNumber, POINTS},
    {"coordsystem", kText, POINTS},
    {"interpolate", kAny, POINTS},
    {"radiusscale", kNumber, "bake3d"},
    {"filterradius", kAny, "texture3d", false, ""},
    {"filterscale", kAny, "texture3d", false, ""},
    {"maxdepth", kAny, "texture3d"},
    {"lerp", kAny, "texture environment shadow bump texture3d"},
    {"expandborders", kAny, "texture environment shadow bump"},
    {"estimator", kNumber, PHOTONS},
    {"lookup", kAny, PHOTONS},
    {"mindist", kAny, PHOTONS},
    {"smooth", kAny, PHOTONS},
    {"albedo", kAny, PHOTONS},
    {"diffusemeanfreepath", kAny, PHOTONS},
    {"dmfp", kAny, PHOTONS},
    {"ior", kAny, PHOTONS},
    {"scale", kAny, PHOTONS},
    {"unitlength", kAny, PHOTONS},
};

#undef RAYS
#undef PHOTONS
#undef POINTS

bool has_word(std::string_view words, std::string_view word) {
    for (size_t at = words.find(word); at != words.npos; at = words.find(word, at + 1)) {
        size_t end = at + word.size();
        bool whole =
            (at == 0 || words[at - 1] == ' ') && (end == words.size() || words[end] == ' ');
        if (whole) return true;
    }
    return false;
}

bool is_variable(const Expr& e) {
    return e.kind == ExprKind::Variable || e.kind == ExprKind::Index ||
           e.kind == ExprKind::Component;
}

// The callee's row; an empty callee's: the first of that name.
const OptionalParameter* find_option(std::string_view name, std::string_view callee = {}) {
    for (const OptionalParameter& option : kOptionalParameters)
        if (option.name == name && (callee.empty() || has_word(option.takers, callee)))
            return &option;
    return nullptr;
}

}  // namespace

std::string_view pair_name(std::span<Expr* const> args, size_t value) {
    const auto* name = value > 0 ? as_if<StringExpr>(args[value - 1]) : nullptr;
    return name ? std::string_view(name->value) : std::string_view();
}

BaseType option_type(std::string_view name) {
    const OptionalParameter* option = find_option(name);
    return option ? option->type : BaseType::Invalid;
}

bool takes_option(std::string_view callee, std::string_view name) {
    return find_option(name, callee);
}

bool is_idle_option(std::string_view callee, std::string_view name, const std::string* text) {
    const OptionalParameter* option = find_option(name, callee);
    if (!option || !option->idle) return false;
    return !text || text->empty() || !has_word(option->idle, *text);
}

bool is_output_pair(const CallExpr& call, size_t value) {
    if (!call.builtin || value <= call.pairs || (value - call.pairs) % 2 == 0) return false;
    std::string_view name = pair_name(call.args, value);
    if (name.empty() || !is_variable(*call.args[value])) return false;
    if (call.builtin->effects & kReadsChannels) return !takes_option(call.name, name);
    const OptionalParameter* option = find_option(name, call.name);
    return option && option->result;
}

bool is_gather_output(std::string_view name) {
    return name.starts_with("surface:") || name.starts_with("ray:") ||
           name.starts_with("primitive:");
}

bool is_light_output(std::string_view name) {
    return name.starts_with("light:");
}

}  // namespace kinora::rsl

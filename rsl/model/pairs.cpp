// rsl/model/pairs.cpp: the table of optional parameters, and which of them are results.
#include "rsl/model/pairs.h"

#include <algorithm>

#include "rsl/model/builtin.h"

namespace kinora::rsl {

namespace {

constexpr BaseType kAny = BaseType::Invalid;
constexpr BaseType kNumber = BaseType::Float;
constexpr BaseType kText = BaseType::String;

#define RAYS "trace transmission visibility occlusion indirectdiffuse areashadow"
#define PHOTONS "photonmap caustic subsurface"
#define POINTS "texture3d bake3d"

constexpr OptionalParameter kOptionalParameters[] = {
    // Rays.
    {"samples", kNumber, "trace transmission visibility environment shadow"},
    {"samples", kNumber, "areashadow texture bump texture3d " PHOTONS, false, kHint},
    {"samplecone", kNumber, "trace transmission visibility"},
    {"bias", kNumber, RAYS " gather environment shadow"},
    {"maxdist", kNumber, "trace occlusion indirectdiffuse gather environment"},
    {"maxdist", kNumber, PHOTONS, false, kHint},
    {"coneangle", kNumber, "occlusion indirectdiffuse"},
    {"raytype", kText, "trace", false, kHint},
    {"weight", kAny, "trace"},
    {"opacity", kAny, "trace"},
    {"falloff", kNumber, "occlusion"},
    {"falloffmode", kNumber, "occlusion"},
    {"environmentdir", kAny, "occlusion", true},
    {"environmentdir", kAny, "trace transmission visibility indirectdiffuse areashadow", true,
     kHint},
    {"environmentmap", kText, "occlusion indirectdiffuse"},
    {"occlusion", kNumber, "indirectdiffuse", true},
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
    {"volume", kAny, "gather", false, kHint},
    {"lightcache", kAny, "gather", false, kHint},
    {"source", kAny, "shadow"},  // four points
    {"source", kAny, "areashadow", false, kHint},
    {"gapbias", kNumber, "areashadow", false, ""},
    // Integrators.
    {"mis", kNumber, "directlighting"},
    {"diffusemis", kNumber, "directlighting"},
    {"heuristic", kText, "directlighting"},
    {"integrationdomain", kText, "directlighting"},
    {"integrationdomain", kText, "indirectspecular", false, kHint},
    {"lightgroups", kAny, "directlighting"},
    {"groupeddiffuseresults", kAny, "directlighting", true},
    {"groupedspecularresults", kAny, "directlighting", true},
    {"groupedunshadoweddiffuseresults", kAny, "directlighting", true},
    {"groupedunshadowedspecularresults", kAny, "directlighting", true},
    {"lightcache", kText, "directlighting", false, kHint},  // records are shared anyway
    {"samplebase", kNumber, "indirectspecular", false, kHint},
    {"subset", kText, "indirectspecular", false, ""},
    {"position", kAny, "indirectspecular", false, ""},
    {"usemotionbias", kNumber, "indirectspecular", false, kHint},
    // Hints.
    {"samplebase", kNumber, RAYS " gather", false, kHint},
    {"label", kText, "trace gather"},
    {"label", kText, "transmission visibility occlusion indirectdiffuse areashadow", false, kHint},
    {"hitmode", kAny, RAYS " gather", false, "default shader"},
    {"hitsides", kAny, RAYS " gather", false, "both"},
    {"minsamples", kAny, RAYS, false, kHint},
    {"maxvariation", kAny, RAYS, false, kHint},
    {"maxerror", kAny, RAYS, false, kHint},
    {"maxpixeldist", kAny, RAYS, false, kHint},
    {"adaptive", kAny, RAYS, false, kHint},
    {"brightnesswarning", kAny, RAYS, false, kHint},
    {"pointbased", kAny, RAYS, false, kHint},
    {"clamp", kAny, RAYS, false, kHint},
    {"maxsolidangle", kAny, RAYS, false, kHint},
    {"sortbleeding", kAny, RAYS, false, kHint},
    {"rayoffset", kAny, RAYS, false, kHint},
    {"filemode", kAny, RAYS, false, kHint},
    {"irradiancefile", kAny, RAYS, false, kHint},
    {"coordsystem", kAny, RAYS, false, kHint},
    {"interpolate", kAny, RAYS, false, kHint},
    {"minsamples", kAny, "shadow environment", false, kHint},
    // Maps.
    {"blur", kNumber, "texture environment shadow bump"},
    {"blur", kNumber, "areashadow", false, kHint},
    {"sblur", kNumber, "texture"},
    {"tblur", kNumber, "texture"},
    {"width", kNumber, "texture environment shadow filterstep"},
    {"width", kNumber, "areashadow", false, kHint},
    {"swidth", kNumber, "texture environment shadow filterstep"},
    {"swidth", kNumber, "areashadow", false, kHint},
    {"twidth", kNumber, "texture environment shadow"},
    {"twidth", kNumber, "areashadow", false, kHint},
    {"fill", kNumber, "texture environment bump"},
    {"filter", kText, "texture bump filterstep"},
    {"filter", kText, "environment shadow areashadow", false, kHint},
    // Point files.
    {"filename", kText, PHOTONS},
    {"filename", kText, RAYS, false, kHint},
    {"radius", kNumber, "bake3d"},
    {"radius", kNumber, "texture3d", false, kHint},
    {"coordsystem", kText, POINTS},
    {"interpolate", kAny, POINTS, false, kHint},
    {"radiusscale", kNumber, "bake3d"},
    {"filterradius", kAny, "texture3d", false, ""},
    {"filterscale", kAny, "texture3d", false, ""},
    {"maxdepth", kAny, "texture3d", false, kHint},
    {"lerp", kAny, "texture environment shadow bump texture3d", false, kHint},
    {"expandborders", kAny, "texture environment shadow bump", false, kHint},
    {"estimator", kNumber, PHOTONS},
    {"lookup", kAny, PHOTONS, false, kHint},
    {"mindist", kAny, PHOTONS, false, kHint},
    {"smooth", kAny, PHOTONS, false, kHint},
    {"albedo", kAny, PHOTONS, false, kHint},
    {"diffusemeanfreepath", kAny, PHOTONS, false, kHint},
    {"dmfp", kAny, PHOTONS, false, kHint},
    {"ior", kAny, PHOTONS, false, kHint},
    {"scale", kAny, PHOTONS, false, kHint},
    {"unitlength", kAny, PHOTONS, false, kHint},
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

}  // namespace

bool is_taker(const OptionalParameter& option, std::string_view callee) {
    return has_word(option.takers, callee);
}

namespace {

// The callee's row; an empty callee's: the first of that name.
const OptionalParameter* find_option(std::string_view name, std::string_view callee = {}) {
    for (const OptionalParameter& option : kOptionalParameters)
        if (option.name == name && (callee.empty() || is_taker(option, callee))) return &option;
    return nullptr;
}

}  // namespace

std::span<const OptionalParameter> optional_parameters() {
    return kOptionalParameters;
}

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
    if (!option || !option->idle || option->idle == kHint) return false;
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

std::span<Expr* const> source_corners(const CallExpr& call) {
    for (size_t k = call.pairs + 1; k < call.args.size(); k += 2)
        if (auto* corners = as_if<ArrayLiteralExpr>(call.args[k]))
            if (pair_name(call.args, k) == "source") return corners->items;
    return {};
}

bool is_gather_output(std::string_view name) {
    return name.starts_with("surface:") || name.starts_with("ray:") ||
           name.starts_with("primitive:") || name.starts_with("environment:");
}

bool is_light_output(std::string_view name) {
    return name.starts_with("light:");
}

}  // namespace kinora::rsl

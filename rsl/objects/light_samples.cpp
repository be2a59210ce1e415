// rsl/objects/light_samples.cpp: lights that are classes with sample methods.
#include "rsl/objects/light_samples.h"

#include <algorithm>

namespace kinora::rsl {

bool has_sample_method(const ClassDefinition& c, std::string_view method) {
    return std::any_of(c.methods.begin(), c.methods.end(), [&](const Function* f) {
        return f->name == method && f->parameters.size() == 2 &&
               f->parameters[0]->type == Type{BaseType::String, -1} &&
               f->parameters[1]->structure && f->parameters[1]->type.is_array();
    });
}

namespace {

constexpr std::string_view kSent = "lightsamples_sent", kShadowed = "lightsamples_sent_shadowed";

bool has_method(const ClassDefinition& c, std::string_view name) {
    return std::any_of(c.methods.begin(), c.methods.end(),
                       [&](const Function* f) { return f->name == name; });
}

// Whether its text sets what comes from a light: a material's sample methods set responses.
bool sets_light(const Ast& ast, const ClassDefinition& c) {
    constexpr std::string_view kWords[] = {"setLightSample", "setLightSamples", "setRadiance",
                                           "lightPdf", "radiance"};
    const auto& tokens = ast.tokens.tokens;
    for (const Function* method : c.methods) {
        if (method->name != "generateSamples") continue;
        int depth = 0;
        for (size_t k = method->body->span.token; k < tokens.size(); ++k) {
            depth += tokens[k].punct == Punct::LeftBrace;
            depth -= tokens[k].punct == Punct::RightBrace;
            if (depth == 0) break;
            if (std::ranges::count(kWords, tokens[k].text)) return true;
        }
    }
    return false;
}

// A class without any stage is a light where its samples are those of one.
bool is_light(const Ast& ast, const ClassDefinition& c) {
    constexpr std::string_view kStages[] = {
        "surface",      "lighting", "diffuselighting", "specularlighting", "prelighting", "volume",
        "postlighting", "opacity",  "imager",          "transformation",   "displacement"};
    if (has_method(c, "light")) return true;
    return std::ranges::none_of(kStages, [&](auto stage) { return has_method(c, stage); }) &&
           sets_light(ast, c);
}

void add_method(Ast& ast, ShaderDefinition& shader, std::span<Function* const> functions) {
    if (!shader.shader_class || !is_light(ast, *shader.shader_class)) return;
    ClassDefinition& c = *shader.shader_class;
    if (!has_sample_method(c, "generateSamples") || !has_sample_method(c, "evaluateSamples"))
        return;
    const std::string_view wanted = has_method(c, "shadowSamples") ? kShadowed : kSent;
    for (Function* function : functions) {
        if (function->name != wanted) continue;
        function->name = ast.arena.copy(kLightSamples);
        std::vector<Function*> methods(c.methods.begin(), c.methods.end());
        methods.push_back(function);
        c.methods = ast.arena.copy(methods);
        return;
    }
}

// Those that no class has taken are not looked at.
void drop_unused(std::vector<Function*>& functions) {
    std::erase_if(functions, [](const Function* f) {
        return f->name == kLightSamples || f->name.starts_with(kSent);
    });
}

}  // namespace

void bind_light_samples(Ast& ast, std::span<Unit> units) {
    for (ShaderDefinition* shader : ast.shaders) add_method(ast, *shader, ast.functions);
    drop_unused(ast.functions);
    for (Unit& unit : units) drop_unused(unit.functions);
}

}  // namespace kinora::rsl

// runtime/scene/dae/export_rsl.cpp: profile_RSL of an effect: its code, and passes with their
// co-shaders.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "collada/document/edit.h"
#include "rsl/link.h"
#include "runtime/scene/dae/export_p.h"
#include "runtime/scene/description/rsl_literals.h"
#include "runtime/scene/profile_rsl/effect_shaders.h"

namespace kinora {

namespace {

namespace fs = std::filesystem;

// rsl::ShaderKind
constexpr const char* kStages[] = {"SURFACE", "DISPLACEMENT", "LIGHT",
                                   "VOLUME",  "IMAGER",       "TRANSFORMATION"};
// rsl::BaseType: what profile_RSL calls them.
constexpr const char* kTypes[] = {"float",  "color",  "point", "vector",
                                  "normal", "matrix", "string"};

std::string handle_value(const std::vector<std::string>& handles) {
    std::string items;
    for (const std::string& handle : handles)
        items += xml("string", "", collada::escape_text(handle));
    return handles.size() == 1
               ? items
               : xml("array", attribute("length", std::to_string(handles.size())), items);
}

}  // namespace

// The text of a parameter's value; "" if it has none.
std::string ColladaExporter::rsl_value(const ParamSource& p, const std::string& effect) {
    if (p.strings.empty()) return number_text(values(p.value));
    if (p.strings[0].empty()) return "";
    std::string path = parse_texture_name(p.strings[0]).path;
    std::error_code error;
    bool file = p.name.ends_with("_map") || is_memory_file(path) ||
                fs::is_regular_file(description_.pictures.find(path).path, error);
    std::string value =
        file ? image(p.strings[0]) : told(p.strings[0], fmt::format("effect '{}'", effect));
    std::optional<std::string> words = texture_words(parse_texture_name(p.strings[0]));
    if (file && !words)
        lost(fmt::format("effect '{}'", effect),
             fmt::format("how '{}' repeats or is filtered", p.name));
    if (file && words && !words->empty()) value += "?" + *words;
    return collada::escape_text(value);
}

// <bind>s of the parameters whose names begin with the prefix, and <newparam>s for them.
std::string ColladaExporter::rsl_binds(const ShaderUse& use, const std::string& handle,
                                       const std::string& effect, RslProfile& profile) {
    std::string binds, prefix = handle.empty() ? "" : handle + ".";
    for (const ParamSource& p : use.params) {
        const rsl::ShaderParameter* parameter = find_parameter(*use.shader, p.name);
        if (!parameter || size_t(parameter->type.base) >= std::size(kTypes)) continue;
        if (!p.name.starts_with(prefix)) continue;
        std::string symbol = p.name.substr(prefix.size());
        if (symbol.find('.') != symbol.npos) continue;  // of a co-shader
        std::string value = rsl_value(p, effect);
        if (value.empty()) continue;
        std::string type = kTypes[size_t(parameter->type.base)];
        auto same = [&](const RslProfile::Param& known) {
            return known.type == type && known.value == value && known.offset == p.value.offset;
        };
        std::string sid = (handle.empty() ? use.shader->name : handle) + "-" + symbol;
        while (profile.params.contains(sid) && !same(profile.params.at(sid))) sid += "_";
        if (profile.params.try_emplace(sid, type, value, p.value.offset).second) {
            profile.newparams += xml("newparam", attribute("sid", sid), xml(type, "", value));
            animation_.name(p.value, effect + "/" + sid, nullptr);
        }
        binds += xml("bind", attribute("symbol", symbol),
                     fmt::format("<param{}/>", attribute("ref", sid)));
    }
    return binds;
}

void ColladaExporter::rsl_code(const rsl::Shader& shader, size_t part, const std::string& effect,
                               RslProfile& profile) {
    std::string code =
        relinked_code(rsl::portable_text(shader, part), description_.pictures, link_from(path_));
    if (profile.written.insert(code).second)
        profile.codes +=
            xml("code", "", collada::cdata(told(code, fmt::format("effect '{}'", effect))));
}

// A shader goes into the last pass where its co-shaders have the handles that they have there.
void ColladaExporter::rsl_shader(const ShaderUse& use, const std::string& effect,
                                 RslProfile& profile) {
    const rsl::Shader& shader = *use.shader;
    rsl_code(shader, 0, effect, profile);
    std::string own = rsl_binds(use, "", effect, profile);
    std::map<std::string, std::string> co_shaders;
    for (size_t k : rsl::parts_to_keep(shader)) {
        const rsl::LinkedPart& part = shader.parts[k];
        std::string binds = k == 0 ? "" : rsl_binds(use, part.handle, effect, profile);
        for (const std::string& name : part.handle_parameters)
            if (const auto& handles = part.texts.at(name); !handles.empty())
                (k == 0 ? own : binds) +=
                    xml("bind", attribute("symbol", name), handle_value(handles));
        if (k == 0) continue;
        if (part.text != shader.parts[0].text) rsl_code(shader, k, effect, profile);
        co_shaders[part.handle] =
            xml("shader", attribute("stage", "COSHADER") + attribute("handle", part.handle),
                xml("name", "", part.shader) + binds);
    }
    auto contradicts = [&](const auto& row) {
        auto known = profile.handles.find(row.first);
        return known != profile.handles.end() && known->second != row.second;
    };
    if (std::ranges::any_of(co_shaders, contradicts)) {
        profile.passes += xml("pass", "", profile.shaders);
        profile.shaders.clear();
        profile.handles.clear();
    }
    profile.shaders += xml("shader", attribute("stage", kStages[size_t(shader.kind)]),
                           xml("name", "", shader.name) + own);
    for (const auto& [handle, element] : co_shaders)
        if (profile.handles.try_emplace(handle, element).second) profile.shaders += element;
}

// One technique with the code of all shaders, each once.
std::string ColladaExporter::rsl(const std::vector<const ShaderUse*>& uses,
                                 const std::string& effect) {
    RslProfile profile;
    for (const ShaderUse* use : uses)
        if (use->shader) rsl_shader(*use, effect, profile);
    profile.passes += xml("pass", "", profile.shaders);
    return xml("profile_RSL", "",
               profile.newparams +
                   xml("technique", attribute("sid", "rsl"), profile.codes + profile.passes));
}

}  // namespace kinora

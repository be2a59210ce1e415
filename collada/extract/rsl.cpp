// collada/extract/rsl.cpp: profile_RSL: shader source, and which shaders a pass runs with what.
#include <algorithm>

#include "collada/document/uri.h"
#include "collada/extract/extract_p.h"
#include "collada/text/numbers_p.h"
#include "runtime/base/file_extension.h"
#include "runtime/base/regular_file.h"
#include "runtime/base/text_encoding.h"

namespace kinora::collada {

namespace {

constexpr uintmax_t kMaxShaderBytes = 64 << 20;

struct StageRow {
    std::string_view name;
    RslStage stage;
};
constexpr StageRow kStages[] = {
    {"SURFACE", RslStage::Surface},  {"DISPLACEMENT", RslStage::Displacement},
    {"LIGHT", RslStage::Light},      {"VOLUME", RslStage::Volume},
    {"IMAGER", RslStage::Imager},    {"TRANSFORMATION", RslStage::Transformation},
    {"COSHADER", RslStage::CoShader}};

constexpr std::string_view kCompiled[] = {".slo", ".slx", ".sdl", ".sdr", ".slb", ".so", ".oso"};

bool is_compiled(std::string_view path, std::string_view text) {
    if (std::ranges::find(kCompiled, lower_extension(path)) != std::end(kCompiled)) return true;
    return text.substr(0, 4096).find('\0') != text.npos;
}

void read_code(Extraction& x, Link link, RslShading& rsl) {
    const Document& document = x.document(link.doc);
    if (trim(link.element->text).empty()) return;
    rsl.codes.push_back({std::string(link.element->text), document.source_map(*link.element),
                         document.path(), false});
}

void read_include(Extraction& x, Link link, RslShading& rsl) {
    std::string_view url = link.element->value("url");
    Location where = x.where(link, "url");
    std::string path = path_of_uri(x.document(link.doc), url);
    if (is_compiled(path, {})) {
        x.diag.report(Code::RSL_INCLUDE_COMPILED, where, url);
        return;
    }
    if (!x.documents.allowed_paths().contains(path)) {
        x.diag.report(Code::LINK_OUTSIDE, where, url);
        return;
    }
    std::optional<std::string> text = read_regular_file(path, kMaxShaderBytes);
    if (!text) {
        x.diag.report(Code::RSL_INCLUDE_MISSING, where, url);
        return;
    }
    RslCode code{utf8_text(std::move(*text)), {}, path, true};
    if (is_compiled(path, code.text)) {
        x.diag.report(Code::RSL_INCLUDE_COMPILED, where, url);
        return;
    }
    code.map.file = x.diag.files.add(path, code.text);
    code.map.segments = {{0, 0}};
    rsl.codes.push_back(std::move(code));
}

void read_bind(Extraction& x, Link link, const Effect& effect, RslShader& shader) {
    const Element& e = *link.element;
    RslBind bind;
    bind.symbol = e.value("symbol");
    bind.where = x.where(link);
    if (const Element* param = e.child("param")) {
        std::string_view ref = param->value("ref");
        bind.param = find_param(x, effect, ref);
        if (bind.param == kNone) {
            Finding& finding =
                x.diag.report(Code::FX_PARAM_UNRESOLVED, x.where({link.doc, param}, "ref"), ref);
            std::vector<std::string_view> sids;
            for (const Param& p : effect.params) sids.push_back(p.sid);
            std::string_view near = nearest_name(ref, sids);
            if (!near.empty()) finding.help = fmt::format("did you mean '{}'?", near);
            return;
        }
    } else if (const Element* value = value_child(e)) {
        if (!read_param_value(x, {link.doc, value}, bind.literal)) return;
    } else {
        x.diag.report(Code::RSL_BIND_EMPTY, bind.where, bind.symbol);
        return;
    }
    shader.binds.push_back(std::move(bind));
}

// False after an error: nothing could find the co-shader by its handle.
bool read_handle(Extraction& x, Link link, const RslShading& rsl, RslShader& shader) {
    shader.handle = link.element->value("handle");
    shader.handle_where = x.where(link, shader.handle.empty() ? "stage" : "handle");
    if (shader.stage != RslStage::CoShader) {
        if (!shader.handle.empty())
            x.diag.report(Code::RSL_HANDLE_PLACE, shader.handle_where, shader.handle);
        shader.handle.clear();
        return true;
    }
    if (shader.handle.empty()) {
        x.diag.report(Code::RSL_HANDLE_MISSING, shader.handle_where);
        return false;
    }
    if (shader.handle.find_first_of(".,") != shader.handle.npos) {
        x.diag.report(Code::RSL_HANDLE_NAME, shader.handle_where, shader.handle);
        return false;
    }
    for (const RslShader& other : rsl.shaders) {
        if (other.pass != shader.pass || other.handle != shader.handle) continue;
        x.diag.report(Code::RSL_HANDLE_TWICE, shader.handle_where, shader.handle)
            .notes.push_back({other.handle_where, "the first is here"});
        return false;
    }
    return true;
}

void read_shader(Extraction& x, Link link, const Effect& effect, uint32_t pass, RslShading& rsl) {
    const Element& e = *link.element;
    RslShader shader;
    shader.pass = pass;
    shader.where = x.where(link);
    const StageRow* stage = nullptr;
    for (const StageRow& row : kStages)
        if (row.name == e.value("stage")) stage = &row;
    if (!stage) {
        x.diag.report(Code::RSL_STAGE, x.where(link, "stage"), e.value("stage"));
        return;
    }
    shader.stage = stage->stage;
    if (!read_handle(x, link, rsl, shader)) return;
    if (const Element* name = e.child("name")) {
        shader.name = trim(name->text);
        shader.where = x.text_where({link.doc, name});
    }
    for (const Element& child : e.children())
        if (child.name == "bind") read_bind(x, {link.doc, &child}, effect, shader);
    rsl.shaders.push_back(std::move(shader));
}

}  // namespace

void read_rsl(Extraction& x, Link profile, uint32_t effect_number, Effect& effect) {
    const Element* technique = profile.element->child("technique");
    if (!technique) {
        x.diag.report(Code::SCHEMA_MISSING_ELEMENT, x.where(profile), "profile_RSL", "technique");
        return;
    }
    if (const Element* second = technique->next_named("technique"))
        x.diag.report(Code::RSL_TECHNIQUES, x.where({profile.doc, second}));
    Link link{profile.doc, technique};
    read_params(x, profile, ParamScope::ProfileRsl, effect_number, effect);
    read_params(x, link, ParamScope::Technique, effect_number, effect);
    RslShading rsl;
    rsl.technique_sid = technique->value("sid");
    rsl.where = x.where(link);
    bool has_source = false;
    uint32_t pass = 0;
    for (const Element& child : technique->children()) {
        Link part{profile.doc, &child};
        bool code = child.name == "code", include = child.name == "include";
        has_source = has_source || code || include;
        if (code) read_code(x, part, rsl);
        if (include) read_include(x, part, rsl);
        if (child.name != "pass") continue;
        for (const Element& shader : child.children())
            if (shader.name == "shader") read_shader(x, {profile.doc, &shader}, effect, pass, rsl);
        ++pass;
    }
    if (!has_source) x.diag.report(Code::RSL_NO_CODE, rsl.where);
    if (rsl.shaders.empty()) x.diag.report(Code::RSL_NO_SHADER, rsl.where);
    if (!rsl.codes.empty() && !rsl.shaders.empty()) effect.rsl = std::move(rsl);
}

}  // namespace kinora::collada

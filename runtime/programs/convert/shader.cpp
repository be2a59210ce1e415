// runtime/programs/convert/shader.cpp: --shader: RSL into the effect of a material.
#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <set>
#include <span>

#include "collada/document/edit.h"
#include "rsl/compile.h"
#include "runtime/base/regular_file.h"
#include "runtime/description/findings.h"
#include "runtime/programs/convert/convert.h"

namespace kinora {

using collada::Document;
using collada::Edit;
using collada::Element;

namespace {

constexpr const char* kStages[] = {"SURFACE", "DISPLACEMENT", "LIGHT",
                                   "VOLUME",  "IMAGER",       "TRANSFORMATION"};  // ShaderKind

std::string code_of(const std::string& file, const ConvertOptions& options, Diagnostics& diag) {
    std::string text = read_regular_file(file).value_or("");
    if (text.find("#include") == text.npos) return text;
    // Included files may not be where the document is read: their text comes along.
    rsl::ShaderSource source;
    source.text = text;
    source.map.file = diag.files.add(file, text);
    source.map.segments = {{0, 0}};
    rsl::CompileOptions compile;
    compile.include_directories = options.include_directories;
    return rsl::print_preprocessed(rsl::preprocess(source, compile, diag));
}

// profile_RSL with a <shader> for the first shader of each kind that a material can wear.
std::string profile(const std::vector<std::unique_ptr<rsl::Shader>>& shaders,
                    const std::string& code, std::string_view text, const Element& effect,
                    std::string_view old_params) {
    std::string passes;
    bool seen[6] = {};
    for (const auto& shader : shaders) {
        size_t kind = size_t(shader->kind);
        bool worn =
            shader->kind != rsl::ShaderKind::Light && shader->kind != rsl::ShaderKind::Imager;
        if (!worn || seen[kind]) continue;
        seen[kind] = true;
        passes += fmt::format("<shader stage=\"{}\"><name>{}</name>", kStages[kind], shader->name);
        // Old binds of parameters that the new shader has too stay, then parameters named alike.
        const Element* old = effect.child("profile_RSL");
        std::set<std::string> bound;
        auto has = [&](std::string_view name) {
            for (const rsl::ShaderParameter& parameter : shader->parameters)
                if (parameter.name == name) return bound.insert(std::string(name)).second;
            return false;
        };
        if (const Element* technique = old ? old->child("technique") : nullptr)
            for (const Element& pass : technique->children())
                for (const Element& shading : pass.children())
                    for (const Element& bind : shading.children())
                        if (bind.name == "bind" && has(bind.value("symbol")))
                            passes +=
                                text.substr(bind.bytes.begin, bind.bytes.end - bind.bytes.begin);
        auto bind_alike = [&](const Element& scope) {
            for (const Element& p : scope.children())
                if (p.name == "newparam" && has(p.value("sid")))
                    passes += fmt::format("<bind symbol=\"{0}\"><param ref=\"{0}\"/></bind>",
                                          p.value("sid"));
        };
        bind_alike(effect);
        if (old) bind_alike(*old);
        passes += "</shader>";
    }
    return "<profile_RSL>" + std::string(old_params) + "<technique sid=\"rsl\"><code>" +
           collada::cdata(code) + "</code><pass>" + passes + "</pass></technique></profile_RSL>";
}

// The effect's bytes with the profile in place of its old profile_RSL, or before its extras.
std::string with_profile(std::string_view text, const Element& effect, const std::string& markup) {
    std::vector<Edit> edits;
    if (const Element* old = effect.child("profile_RSL")) {
        edits.push_back({old->bytes, markup});
    } else if (const Element* extra = effect.child("extra")) {
        edits.push_back({{extra->bytes.begin, extra->bytes.begin}, markup});
    } else {
        edits.push_back(collada::append_child(text, effect, markup));
    }
    for (Edit& e : edits) {
        e.bytes.begin -= effect.bytes.begin;
        e.bytes.end -= effect.bytes.begin;
    }
    return collada::apply_edits(
        text.substr(effect.bytes.begin, effect.bytes.end - effect.bytes.begin), edits);
}

bool matches(const std::string& pattern, std::string_view name) {
    return fnmatch(pattern.c_str(), std::string(name).c_str(), 0) == 0;
}

std::vector<const Element*> materials_with_effects(const Document& document) {
    std::vector<const Element*> found;
    for (const Element& library : document.root().children())
        if (library.name == "library_materials")
            for (const Element& m : library.children())
                if (m.name == "material" && m.child("instance_effect")) found.push_back(&m);
    return found;
}

std::string_view effect_url(const Element& material) {
    return material.child("instance_effect")->value("url");
}

// The effect's parameters of RSL, as they stand in the text.
std::string rsl_params(std::string_view text, const Element& effect) {
    std::string params;
    if (const Element* old = effect.child("profile_RSL"))
        for (const Element& p : old->children())
            if (p.name == "newparam")
                params += text.substr(p.bytes.begin, p.bytes.end - p.bytes.begin);
    return params;
}

// A copy of the effect behind it, with `markup` in place of its bytes and an id of its own, and
// those of the materials that wore the effect wear the copy.
void add_copy(const Document& document, std::string_view text, const Element& effect,
              std::string markup, std::span<const Element* const> materials, std::string_view url,
              std::vector<Edit>& edits) {
    std::string id = std::string(effect.value("id")) + "-rsl";
    while (document.find(id)) id += "_";
    collada::ByteRange at = effect.attribute("id")->value_bytes;
    uint32_t begin = at.begin - effect.bytes.begin, length = at.end - at.begin;
    markup.replace(begin, length, collada::escape_attribute(id));
    edits.push_back({{effect.bytes.end, effect.bytes.end}, std::move(markup)});
    for (const Element* material : materials)
        if (effect_url(*material) == url)
            edits.push_back(
                collada::set_attribute(text, *material->child("instance_effect"), "url", "#" + id));
}

}  // namespace

std::optional<std::string> embed_shader(const std::string& path, const std::string& text,
                                        const std::string& pattern, const std::string& file,
                                        const ConvertOptions& options, Diagnostics& diag) {
    rsl::CompileOptions compile;
    compile.include_directories = options.include_directories;
    auto shaders = rsl::compile_file(file, compile, diag);
    if (shaders.empty()) {
        if (!diag.has_errors())
            diag.report(Code::CONVERT_SHADER, Location{}, fmt::format("'{}' has no shader", file));
        return std::nullopt;
    }
    std::string code = code_of(file, options, diag);
    Diagnostics quiet;
    std::optional<Document> document = collada::read_document_text(path, text, quiet);
    if (!document || !document->whole()) return text;
    std::string_view own = quiet.files.text(document->file());

    std::vector<const Element*> all = materials_with_effects(*document), materials;
    for (const Element* m : all)
        if (matches(pattern, m->value("id")) || matches(pattern, m->value("name")))
            materials.push_back(m);
    if (materials.empty()) {
        diag.report(Code::MATERIAL_UNKNOWN, Location{}, pattern);
        return std::nullopt;
    }
    auto chosen = [&](const Element* m) {
        return std::find(materials.begin(), materials.end(), m) != materials.end();
    };
    std::vector<Edit> edits;
    std::set<const Element*> done;
    for (const Element* m : materials) {
        std::string_view url = effect_url(*m);
        const Element* effect = url.starts_with('#') ? document->find(url.substr(1)) : nullptr;
        if (!effect || effect->name != "effect") {
            diag.report(Code::CONVERT_SHADER, Location{},
                        fmt::format("the effect '{}' of material '{}' is not in this file", url,
                                    m->value("id")));
            return std::nullopt;
        }
        if (!done.insert(effect).second) continue;
        std::string markup = with_profile(
            own, *effect,
            collada::prefixed(profile(shaders, code, own, *effect, rsl_params(own, *effect)),
                              collada::prefix_of(own, document->root())));
        bool keeps_its_look = std::any_of(all.begin(), all.end(), [&](const Element* other) {
            return effect_url(*other) == url && !chosen(other);
        });
        if (keeps_its_look)
            add_copy(*document, own, *effect, std::move(markup), materials, url, edits);
        else
            edits.push_back({effect->bytes, markup});
    }
    return collada::apply_edits(own, std::move(edits));
}

}  // namespace kinora

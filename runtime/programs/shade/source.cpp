// runtime/programs/shade/source.cpp: reads FILE.sl, SCENE.dae#EFFECT or standard input.
#include "runtime/programs/shade/source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "collada/document/document.h"
#include "collada/extract/extract.h"
#include "collada/scene/scene.h"
#include "runtime/base/file_extension.h"
#include "runtime/base/regular_file.h"
#include "runtime/base/text_encoding.h"
#include "runtime/programs/common/exit_codes.h"
#include "runtime/programs/common/missing_asset.h"
#include "runtime/programs/shade/co_shaders.h"
#include "runtime/scene/profile_rsl/effect_linker.h"
#include "runtime/scene/profile_rsl/joined_code.h"

namespace kinora {

namespace {

int complain(int code, const std::string& text) {
    std::fprintf(stderr, "kinora-shade: %s\n", text.c_str());
    return code;
}

int read_file(const std::string& path, ShadeSource& source) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
        return complain(kExitUnreadable, fmt::format("'{}' is a folder", path));
    std::FILE* file = path == "-" ? stdin : std::fopen(path.c_str(), "rb");
    if (!file)
        return complain(kExitUnreadable,
                        fmt::format("cannot read '{}': {}", path, std::strerror(errno)));
    char block[65536];
    while (size_t got = std::fread(block, 1, sizeof block, file)) source.text.append(block, got);
    bool ok = !std::ferror(file);
    if (file != stdin) std::fclose(file);
    if (!ok) return complain(kExitUnreadable, fmt::format("cannot read '{}'", path));
    source.text = utf8_text(std::move(source.text));
    source.map.file = source.diagnostics.files.add(path == "-" ? "<stdin>" : path, source.text);
    return kExitOk;
}

void take_binds(const collada::SceneData& data, const BoundShader& shader, ShadeSource& source) {
    std::string prefix = shader.from->handle.empty() ? "" : shader.from->handle + ".";
    for (const collada::RslBind& bind : shader.from->binds) {
        const collada::ParamValue& value = bound_value(data, shader, bind);
        ShadeParam param{prefix + bind.symbol, value.numbers, value.strings};
        if (value.image != collada::kNone) param.strings = {data.images[value.image].path};
        if (value.type == collada::ParamType::Float4x4)  // COLLADA's are for column vectors
            for (size_t i = 0; i < param.numbers.size(); ++i)
                param.numbers[i] = value.numbers[i / 16 * 16 + i % 4 * 4 + i % 16 / 4];
        source.params.push_back(std::move(param));
    }
}

// The binds of the effect's shaders and of the library's co-shaders that they use, and which
// shaders are linked with which.
void take_passes(const collada::SceneData& data, uint32_t effect, const ShadeOptions& options,
                 ShadeSource& source) {
    EffectLinker linker(data, options.compile, source.diagnostics);
    std::set<const collada::RslShader*> taken;
    for (const collada::RslShader& from : data.effects[effect].rsl->shaders) {
        BoundShader shader{&from, effect};
        taken.insert(&from);
        take_binds(data, shader, source);
        if (from.stage == collada::RslStage::CoShader) continue;
        if (auto linked = linker.linked(shader); linked && !linked->parts.empty())
            source.linked.push_back(linked->parts);
        for (const BoundShader& other : linker.co_shaders(shader))
            if (other.effect != effect && taken.insert(other.from).second)
                take_binds(data, other, source);
    }
}

// The linked shaders, then the others of the source, which are complete by themselves.
std::vector<std::unique_ptr<rsl::Shader>> compile_passes(const ShadeOptions& options,
                                                         ShadeSource& source) {
    std::vector<std::unique_ptr<rsl::Shader>> shaders;
    Diagnostics unheard;  // by themselves they lack their co-shaders
    unheard.files = source.diagnostics.files;
    for (const std::vector<rsl::LinkedPart>& parts : source.linked) {
        auto sources = rsl::sources_of(parts);
        if (auto linked = rsl::compile_linked(sources, options.compile, source.diagnostics))
            shaders.push_back(std::move(linked));
    }
    for (auto& shader : rsl::compile(source.view(), options.compile, unheard))
        if (std::ranges::none_of(shaders, [&](const auto& s) { return s->name == shader->name; }))
            shaders.push_back(std::move(shader));
    return shaders;
}

std::vector<std::unique_ptr<rsl::Shader>> compile_alone(const ShadeOptions& options,
                                                        ShadeSource& source) {
    rsl::CompileOptions with_counts = options.compile;
    with_counts.counts = bound_counts(options, source, "");
    return rsl::compile(source.view(), with_counts, source.diagnostics);
}

// The path of SCENE.dae or SCENE.dae#EFFECT; "" for other sources.
std::string scene_of_source(const std::string& source) {
    std::string path = source.substr(0, source.rfind('#'));
    return has_extension(path, {".dae"}) ? path : "";
}

// Where only one effect has RSL it need not be named.
int read_effect(const std::string& path, const ShadeOptions& options, ShadeSource& source) {
    size_t hash = options.source.rfind('#');
    std::string id = hash == std::string::npos ? "" : options.source.substr(hash + 1);
    collada::ExtractOptions extract;
    extract.allow_external = options.allow_external;
    std::optional<collada::Document> document = collada::read_document(path, source.diagnostics);
    std::optional<collada::SceneData> data;
    if (document) data = collada::extract(*document, source.diagnostics, extract);
    if (!data) return kExitUnreadable;  // findings say why
    std::string known;
    auto with_rsl = std::count_if(data->effects.begin(), data->effects.end(),
                                  [](const collada::Effect& e) { return bool(e.rsl); });
    for (const collada::Effect& effect : data->effects) {
        if (!effect.rsl) continue;
        known += (known.empty() ? "" : ", ") + effect.id;
        if (effect.id != id && !(id.empty() && with_rsl == 1)) continue;
        source.text = joined_code(*effect.rsl, source.map);
        take_passes(*data, uint32_t(&effect - data->effects.data()), options, source);
        return kExitOk;
    }
    if (known.empty())
        return complain(kExitUsage, fmt::format("no effect of '{}' has RSL shaders", path));
    return complain(kExitUsage, fmt::format("{}; '{}' has {}",
                                            id.empty() ? std::string("name an effect: FILE.dae#ID")
                                                       : fmt::format("no RSL effect '{}'", id),
                                            path, known));
}

}  // namespace

void ShadeSource::print_findings(const ShadeOptions& options) {
    Severity least = options.quiet     ? Severity::Error
                     : options.verbose ? Severity::Hint
                                       : Severity::Warning;
    const auto& findings = diagnostics.findings();
    for (; printed_ < findings.size(); ++printed_)
        if (!options.silent && findings[printed_].severity >= least)
            std::fputs(format_finding(findings[printed_], diagnostics.files).c_str(), stderr);
}

bool ShadeSource::failed(const ShadeOptions& options) const {
    return diagnostics.has_errors() ||
           (options.warnings_fail && diagnostics.count(Severity::Warning) > 0);
}

int ShadeSource::exit_code(const ShadeOptions& options, int code) const {
    if (code != kExitOk) return code;
    const auto& findings = diagnostics.findings();
    bool missing = std::any_of(findings.begin(), findings.end(),
                               [](const Finding& f) { return is_missing_asset(*f.info); });
    if (options.strict && missing) return kExitMissingAsset;
    return failed(options) ? kExitSomeFailed : kExitOk;
}

void hold_to_scene(ShadeOptions& options) {
    std::string scene = scene_of_source(options.source);
    if (scene.empty()) return;
    std::vector<std::string> folders{scene.substr(0, scene.rfind('/') + 1)};
    for (const auto* more : {&options.allow_external, &options.compile.include_directories})
        folders.insert(folders.end(), more->begin(), more->end());
    options.compile.files = AllowedPaths(folders);
    options.compile.pictures = options.compile.files.anywhere();
    for (const auto& [name, value] : options.params)  // what the user names is read where it is
        if (is_regular_file(value)) options.compile.pictures.add_file(value);
}

std::vector<std::string> shade_sources(const std::string& word) {
    if (word.rfind('#') != std::string::npos || scene_of_source(word).empty()) return {word};
    Diagnostics unheard;  // who reads an effect hears it
    std::optional<collada::Document> document = collada::read_document(word, unheard);
    std::optional<collada::SceneData> data;
    if (document) data = collada::extract(*document, unheard);
    std::vector<std::string> sources;
    for (size_t e = 0; data && e < data->effects.size(); ++e)
        if (data->effects[e].rsl) sources.push_back(word + "#" + data->effects[e].id);
    return sources.empty() ? std::vector<std::string>{word} : sources;
}

int read_shade_source(const ShadeOptions& options, ShadeSource& source) {
    source.diagnostics.judge(options.strict ? Judgement::Strict : Judgement::Rendering);
    std::string scene = scene_of_source(options.source);
    int code =
        scene.empty() ? read_file(options.source, source) : read_effect(scene, options, source);
    if (code != kExitOk) source.print_findings(options);
    return code;
}

std::optional<int> compile_shade_source(const ShadeOptions& options, ShadeSource& source) {
    for (const std::string& code : options.unwarned)
        source.diagnostics.set_severity(code, Severity::Off);
    if (int code = read_shade_source(options, source)) return code;
    if (options.preprocess_only) {
        rsl::TokenStream tokens =
            rsl::preprocess(source.view(), options.compile, source.diagnostics);
        source.print_findings(options);
        std::fputs(rsl::print_preprocessed(tokens).c_str(), stdout);
        return source.failed(options) ? kExitShader : kExitOk;
    }
    if (options.co_shaders.empty() && !source.linked.empty())
        source.shaders = compile_passes(options, source);
    else if (options.co_shaders.empty())
        source.shaders = compile_alone(options, source);
    else if (auto linked = compile_with_co_shaders(options, source))
        source.shaders.push_back(std::move(linked));
    source.diagnostics.sort_unique();  // by location: they came by stage
    source.print_findings(options);
    if (source.shaders.empty() || source.failed(options)) return kExitShader;
    return std::nullopt;
}

bool has_code(const rsl::Shader& shader) {
    return shader.kind == rsl::ShaderKind::Surface ||
           shader.kind == rsl::ShaderKind::Displacement || shader.kind == rsl::ShaderKind::Light;
}

bool can_run(const rsl::Shader& shader) {
    if (has_code(shader)) return true;
    complain(kExitUsage,
             fmt::format("'{}' is of kind {}; surface, displacement and light shaders can be run",
                         shader.name, rsl::shader_kind_name(shader.kind)));
    return false;
}

rsl::Shader* choose_shader(const ShadeOptions& options, const ShadeSource& source) {
    if (options.shader.empty()) return source.shaders.front().get();
    std::string known;
    for (const auto& shader : source.shaders) {
        if (shader->name == options.shader) return shader.get();
        known += " " + shader->name;
    }
    complain(kExitUsage, fmt::format("no shader '{}'; the source has{}", options.shader, known));
    return nullptr;
}

}  // namespace kinora

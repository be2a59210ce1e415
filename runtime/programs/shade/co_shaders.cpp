// runtime/programs/shade/co_shaders.cpp: a source with the co-shaders of --coshader.
#include "runtime/programs/shade/co_shaders.h"

#include <deque>

#include "rsl/link.h"
#include "rsl/text/findings.h"
#include "runtime/base/regular_file.h"
#include "runtime/base/text_encoding.h"

namespace kinora {

namespace {

constexpr uint64_t kMostSourceBytes = 64 << 20;

// --param HANDLE.NAME=VALUE is for that co-shader; without a handle of these it is the shader's.
rsl::LinkTexts texts_for(const ShadeOptions& options, const std::string& handle) {
    rsl::LinkTexts texts;
    for (const auto& [name, value] : options.params) {
        if (handle.empty())
            texts[name] = {value};
        else if (name.starts_with(handle + "."))
            texts[name.substr(handle.size() + 1)] = {value};
    }
    return texts;
}

}  // namespace

std::unique_ptr<rsl::Shader> compile_with_co_shaders(const ShadeOptions& options,
                                                     ShadeSource& source) {
    std::vector<rsl::LinkedSource> sources{
        {"", source.view(), options.shader, texts_for(options, "")}};
    for (const ShadeParam& param : source.params)
        if (!sources[0].texts.contains(param.name)) sources[0].texts[param.name] = param.strings;
    std::deque<std::string> kept;  // the sources are views
    for (const auto& [handle, path] : options.co_shaders) {
        std::optional<std::string> bytes = read_regular_file(path, kMostSourceBytes);
        if (!bytes) {
            source.diagnostics.report(rsl::Code::RSL_FILE_NOT_READ, Location{}, path);
            return nullptr;
        }
        kept.push_back(utf8_text(std::move(*bytes)));
        rsl::ShaderSource text{kept.back(), {}};
        text.map.file = source.diagnostics.files.add(path, kept.back());
        std::erase_if(sources, [&](const rsl::LinkedSource& s) { return s.handle == handle; });
        sources.push_back({handle, text, "", texts_for(options, handle)});
    }
    return rsl::compile_linked(sources, options.compile, source.diagnostics);
}

}  // namespace kinora

// runtime/programs/shade/co_shaders.cpp: a source with the co-shaders of --coshader.
#include "runtime/programs/shade/co_shaders.h"

#include <algorithm>
#include <deque>

#include "rsl/link.h"
#include "rsl/text/findings.h"
#include "runtime/base/regular_file.h"
#include "runtime/base/text_encoding.h"
#include "runtime/scene/load/override_scene.h"

namespace kinora {

namespace {

constexpr uint64_t kMostSourceBytes = 64 << 20;

// --param HANDLE.NAME=VALUE is for that co-shader; without a handle of these it is the shader's. It
// goes before what comes with the source.
rsl::LinkTexts texts_for(const ShadeOptions& options, const ShadeSource& source,
                         const std::string& handle) {
    std::string prefix = handle.empty() ? "" : handle + ".";
    rsl::LinkTexts texts;
    for (const ShadeParam& param : source.params)
        if (param.name.starts_with(prefix) && !param.strings.empty())
            texts[param.name.substr(prefix.size())] = param.strings;
    for (const auto& [name, value] : options.params)
        if (name.starts_with(prefix)) texts[name.substr(prefix.size())] = {value};
    return texts;
}

}  // namespace

rsl::LinkCounts bound_counts(const ShadeOptions& options, const ShadeSource& source,
                             const std::string& handle) {
    std::string prefix = handle.empty() ? "" : handle + ".";
    rsl::LinkCounts counts;
    for (const ShadeParam& param : source.params)
        if (param.name.starts_with(prefix))
            counts[param.name.substr(prefix.size())] =
                std::max(param.numbers.size(), param.strings.size());
    for (const auto& [name, value] : options.params)
        if (name.starts_with(prefix)) {
            auto numbers = parse_numbers(value);
            counts[name.substr(prefix.size())] =
                numbers ? numbers->size() : split_texts(value).size();
        }
    return counts;
}

std::vector<std::string> split_texts(const std::string& text) {
    std::vector<std::string> texts(1);
    for (char c : text)
        if (c == ',')
            texts.emplace_back();
        else
            texts.back() += c;
    return texts;
}

std::unique_ptr<rsl::Shader> compile_with_co_shaders(const ShadeOptions& options,
                                                     ShadeSource& source) {
    std::vector<rsl::LinkedSource> sources{{"", source.view(), options.shader,
                                            texts_for(options, source, ""),
                                            bound_counts(options, source, "")}};
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
        sources.push_back({handle, text, "", texts_for(options, source, handle),
                           bound_counts(options, source, handle)});
    }
    return rsl::compile_linked(sources, options.compile, source.diagnostics);
}

}  // namespace kinora

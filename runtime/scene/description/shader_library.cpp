// runtime/scene/description/shader_library.cpp: finds and compiles embedded shaders. The texts are
// in shader_library_data.cpp, which CMake makes from assets/shaders.
#include "runtime/scene/description/shader_library.h"

#include <algorithm>
#include <map>
#include <mutex>

#include "runtime/base/check.h"

namespace kinora {

struct EmbeddedShader {
    const char* name;
    const char* text;
};
extern const EmbeddedShader kEmbeddedShaders[];
extern const size_t kEmbeddedShadersCount;

std::shared_ptr<const rsl::Shader> library_shader(std::string_view name) {
    static std::mutex mutex;
    static std::map<std::string, std::shared_ptr<const rsl::Shader>, std::less<>> compiled;
    static Diagnostics library_diagnostics;  // locations in the library outlive every scene
    std::lock_guard lock(mutex);
    if (auto found = compiled.find(name); found != compiled.end()) return found->second;
    for (size_t i = 0; i < kEmbeddedShadersCount; ++i) {
        const EmbeddedShader& embedded = kEmbeddedShaders[i];
        if (name != embedded.name) continue;
        std::string file = "assets/shaders/" + std::string(name) + ".sl";
        rsl::ShaderSource source{embedded.text, {}};
        source.map.file = library_diagnostics.files.add(file, embedded.text);
        auto shaders = rsl::compile(source, {}, library_diagnostics);
        if (shaders.empty())
            check_failed(file.c_str(), 0,
                         library_diagnostics.findings().empty()
                             ? "no shader"
                             : format_finding(library_diagnostics.findings().front(),
                                              library_diagnostics.files));
        return compiled[std::string(name)] = std::move(shaders.front());
    }
    return nullptr;
}

std::string_view library_shader_text(std::string_view name) {
    for (size_t i = 0; i < kEmbeddedShadersCount; ++i)
        if (name == kEmbeddedShaders[i].name) return kEmbeddedShaders[i].text;
    return {};
}

const std::vector<std::string_view>& library_shader_names() {
    static const std::vector<std::string_view> names = [] {
        std::vector<std::string_view> all;
        for (size_t i = 0; i < kEmbeddedShadersCount; ++i) all.push_back(kEmbeddedShaders[i].name);
        std::sort(all.begin(), all.end());
        return all;
    }();
    return names;
}

}  // namespace kinora

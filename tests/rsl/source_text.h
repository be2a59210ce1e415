// tests/rsl/source_text.h: shader files of tests, and compiling text.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "rsl/compile.h"
#include "tests/folders.h"

namespace kinora::rsl {

inline CompileOptions front_end_only() {
    CompileOptions options;
    options.require_implemented = false;
    return options;
}

// The shaders of a folder of the repository and of those below it, in order.
inline std::vector<std::filesystem::path> shader_files(const std::string& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(
             std::filesystem::path(project_folder()) / folder))
        if (entry.path().extension() == ".sl") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

inline std::string read_file(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

// A text registered as a file, so that findings have places.
struct TestSource {
    explicit TestSource(std::string content, const char* name = "test.sl")
        : text(std::move(content)), source{text, {}} {
        source.map.file = diagnostics.files.add(name, text);
    }
    std::string messages() const {
        std::string all;
        for (const Finding& f : diagnostics.findings()) all += format_finding(f, diagnostics.files);
        return all;
    }
    std::string text;
    Diagnostics diagnostics;
    ShaderSource source;
};

}  // namespace kinora::rsl

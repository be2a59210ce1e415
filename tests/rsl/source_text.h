// tests/rsl/source_text.h: compiling text in tests.
#pragma once

#include <string>

#include "rsl/shader.h"

namespace kinora::rsl {

inline CompileOptions front_end_only() {
    CompileOptions options;
    options.require_implemented = false;
    return options;
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

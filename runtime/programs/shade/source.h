// runtime/programs/shade/source.h: shader text from a file, a scene's effect or stdin.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "rsl/link.h"
#include "runtime/base/diagnostic.h"
#include "runtime/programs/shade/kinora_shade.h"

namespace kinora {

// A value for a parameter: numbers, or texts for strings.
struct ShadeParam {
    std::string name;
    std::vector<double> numbers;
    std::vector<std::string> strings;
};

// What a command works on.
struct ShadeSource {
    Diagnostics diagnostics;
    std::string text;
    SourceMap map;
    std::vector<ShadeParam> params;                    // an effect's: what its <bind>s give
    std::vector<std::vector<rsl::LinkedPart>> linked;  // an effect's: shaders with co-shaders
    std::vector<std::unique_ptr<rsl::Shader>> shaders;

    rsl::ShaderSource view() const { return {text, map}; }
    // Prints the findings not yet printed, as the options say.
    void print_findings(const ShadeOptions& options);
    // An error was found; a warning counts under -Werror.
    bool failed(const ShadeOptions& options) const;
    // The exit code of a command that otherwise comes to `code`.
    int exit_code(const ShadeOptions& options, int code) const;

  private:
    size_t printed_ = 0;
};

// The sources that one word names: all RSL effects of a SCENE.dae without an #EFFECT (itself, where
// it has none or cannot be read), else the word.
std::vector<std::string> shade_sources(const std::string& word);

// A scene's shader reads files of the scene's folder, --allow-external and -I alone.
void hold_to_scene(ShadeOptions& options);

// Reads the text. Returns an exit code other than 0 when it cannot be had (said on stderr).
int read_shade_source(const ShadeOptions& options, ShadeSource& source);

// Reads and compiles; with -E prints the preprocessed text instead. Findings are printed. Returns
// nothing when shaders stand in `source`, an exit code when the command ends here.
std::optional<int> compile_shade_source(const ShadeOptions& options, ShadeSource& source);

// The shader that --shader names, else the first; null (said on stderr) when there is none.
rsl::Shader* choose_shader(const ShadeOptions& options, const ShadeSource& source);

// Whether shaders of its kind are compiled to code in this version.
bool has_code(const rsl::Shader& shader);
bool can_run(const rsl::Shader& shader);  // the same; says so on stderr if not

}  // namespace kinora

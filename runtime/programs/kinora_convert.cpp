// runtime/programs/kinora_convert.cpp: kinora-convert's command line.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "runtime/programs/convert.h"
#include "runtime/programs/exit_codes.h"

namespace kinora {

std::optional<int> parse_convert_options(int argc, char** argv, ConvertOptions& o) {
    CLI::App app("kinora-convert: scenes from one format to another", "kinora-convert");
    app.footer(
        "Exit codes: 0 ok; 1 something was lost, under --strict; 2 usage; 3 scene "
        "unreadable;\n4 shader error; 6 output cannot be written; 75 retry may help.");
    app.set_version_flag("--version", "kinora-convert " KINORA_VERSION);
    app.add_option("input", o.input, "the scene: .dae, .zae, .kmz, .gltf or .glb")->required();
    app.add_option("output", o.output, "the file to write: .glb, .gltf or .dae")->required();
    std::vector<std::string> shaders;
    app.add_option("--shader", shaders,
                   "MATERIAL=FILE.sl: put RSL on a material; MATERIAL is an id, a name or a glob");
    app.add_option("-I", o.include_directories, "where shaders find #include files");
    app.add_option("--up", o.up_axis, "the up axis a .dae shall have: X, Y or Z")
        ->transform(
            CLI::CheckedTransformer(
                std::map<std::string, UpAxis>{{"X", UpAxis::X}, {"Y", UpAxis::Y}, {"Z", UpAxis::Z}},
                CLI::ignore_case)
                .description(""))
        ->type_name("AXIS");
    app.add_option("--unit", o.meter, "metres per unit a .dae shall have");
    app.add_option("--animation-error", o.animation_error,
                   "how near sampled curves must come (1e-4 of the range they move over)");
    app.add_option("--allow-external", o.allow_external,
                   "DIR: a folder outside the scene's that it may read files of");
    app.add_flag("--strict", o.strict, "exit 1 if the output cannot hold something");
    std::string stats;
    app.add_option("--stats", stats, "sizes and times: text or json")
        ->expected(0, 1)
        ->default_str("text")
        ->check(CLI::IsMember({"text", "json"}));
    app.add_flag("-v,--verbose", o.verbose, "say more");
    app.add_flag("-q,--quiet", o.quiet, "say only errors");
    try {
        app.parse(argc, argv);
        for (const std::string& shader : shaders) {
            size_t equals = shader.find('=');
            if (equals == std::string::npos || equals == 0 || equals + 1 == shader.size())
                throw CLI::ValidationError("--shader", "takes MATERIAL=FILE.sl");
            o.shaders.emplace_back(shader.substr(0, equals), shader.substr(equals + 1));
        }
        if (o.meter && !(*o.meter >= 1e-15 && *o.meter <= 1e15))
            throw CLI::ValidationError("--unit", "takes metres, more than 0");
        if (!(o.animation_error > 0 && o.animation_error <= 1))
            throw CLI::ValidationError("--animation-error", "takes a number from 0 to 1");
        bool to_dae = o.output.ends_with(".dae");
        if (!to_dae && !o.output.ends_with(".glb") && !o.output.ends_with(".gltf"))
            throw CLI::ValidationError("output", "takes a name that ends in .glb, .gltf or .dae");
        if (!to_dae && (o.up_axis.value_or(UpAxis::Y) != UpAxis::Y || o.meter.value_or(1) != 1))
            throw CLI::ValidationError("--up, --unit", "glTF is always y up and in metres");
        if (app.count("--stats")) {
            o.stats = true;
            o.stats_json = stats == "json";
        }
    } catch (const CLI::ParseError& error) {
        int code = app.exit(error);
        return code == 0 ? kExitOk : kExitUsage;
    }
    return std::nullopt;
}

}  // namespace kinora

int main(int argc, char** argv) {
    kinora::ConvertOptions options;
    if (std::optional<int> code = kinora::parse_convert_options(argc, argv, options)) return *code;
    return kinora::convert(options);
}

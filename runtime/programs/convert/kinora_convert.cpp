// runtime/programs/convert/kinora_convert.cpp: kinora-convert's command line.
#include <filesystem>

#include "runtime/base/file_extension.h"
#include "runtime/base/memory/heap.h"
#include "runtime/programs/common/command_line.h"
#include "runtime/programs/common/run_program.h"
#include "runtime/programs/common/standard_streams.h"
#include "runtime/programs/convert/convert.h"

namespace kinora {

namespace {

// As they stand on the command line.
struct Given {
    std::vector<std::string> shaders;
    std::string threads, jobs = "all", stats;
};

void declare_folders(CLI::App& app, Given& given, ConvertOptions& o) {
    app.add_flag("-r,--recursive", o.recursive,
                 "convert all scene files below a folder; the tree stays, and a run that was ended "
                 "goes on where it was");
    app.add_option("--to", o.to, "with -r: glb, gltf or dae")
        ->check(one_of({"glb", "gltf", "dae"}));
    app.add_option("-j,--jobs", given.jobs,
                   "with -r: N files at once, -N (all but N) or all (all)");
    app.add_option(
        "--report", o.report,
        "with -r: FILE for what each file lost, as text, or as JSON if it ends in .json");
}

void declare(CLI::App& app, Given& given, ConvertOptions& o) {
    app.footer(
        "Exit codes: 0 ok; 1 something was lost, under --strict, or findings of --fail-on; 2 "
        "usage;\n"
        "3 scene unreadable; 4 shader error; 5 missing asset under --strict; 6 output cannot be\n"
        "written; 75 retry may help.");
    app.set_version_flag("--version", "kinora-convert " KINORA_VERSION);
    app.add_option("input", o.input, "the scene: .dae, .zae, .kmz, .gltf or .glb; a folder with -r")
        ->required();
    app.add_option("-o,--output,output", o.output,
                   "the file to write: .glb, .gltf or .dae; a folder with -r")
        ->required();
    declare_folders(app, given, o);
    add_list(app, "--shader", given.shaders,
             "NAME=SHADER: put RSL on a material or light; NAME is an id, a name or a glob, SHADER "
             "FILE.sl or one of ours; again for further stages");
    add_list(app, "-I", o.include_directories, "DIR: where shaders find #include files");
    add_choice<UpAxis>(app, "--up", o.up_axis,
                       {{"X", UpAxis::X}, {"Y", UpAxis::Y}, {"Z", UpAxis::Z}},
                       "the up axis a .dae shall have: X, Y or Z");
    app.add_option("--unit", o.meter, "metres per unit a .dae shall have");
    app.add_flag("--copy-textures", o.copy_textures,
                 "copy pictures into textures/ beside a .dae; else it links to where they are");
    app.add_option("--animation-error", o.animation_error,
                   "how near sampled curves must come (1e-4 of the range they move over)");
    add_list(app, "--allow-external", o.allow_external,
             "DIR: a folder outside the scene's that it may read files of");
    app.add_flag("--confine", o.confine,
                 "read pictures too only there; else they may lie anywhere");
    app.add_flag("--ignore-required", o.ignore_required,
                 "read a glTF file without the extensions that it requires and Kinora lacks");
    app.add_flag("--strict", o.findings.strict,
                 "what is missing, refused or left out is an error, and so is what the output "
                 "cannot hold");
    add_fail_on(app, o.findings.fail_on);
    app.add_option("--threads", given.threads, "N, -N (all but N) or all (all)");
    app.add_option("--stats", given.stats, "[=json]: sizes and times, on stdout")
        ->check(one_of({"text", "json"}));
    app.add_flag("-v,--verbose", o.findings.verbose, "say everything");
    app.add_flag("-q,--quiet", o.findings.quiet, "say only errors");
}

void interpret_folders(const Given& given, ConvertOptions& o) {
    std::error_code code;
    if (o.to.empty()) throw CLI::ValidationError("-r", "needs --to glb, --to gltf or --to dae");
    if (!std::filesystem::is_directory(o.input, code))
        throw CLI::ValidationError("-r", fmt::format("'{}' is no folder", o.input));
    if (std::filesystem::exists(o.output, code) && !std::filesystem::is_directory(o.output, code))
        throw CLI::ValidationError("-r", fmt::format("'{}' is no folder", o.output));
    if (std::filesystem::equivalent(o.input, o.output, code))
        throw CLI::ValidationError("-r", "writes into another folder");
    o.jobs = parse_threads(given.jobs, "--jobs");
}

void interpret(const Given& given, ConvertOptions& o) {
    for (const std::string& shader : given.shaders)
        o.shaders.push_back(split_pair(shader, "--shader", "MATERIAL=FILE.sl"));
    if (o.meter && !(*o.meter >= 1e-15 && *o.meter <= 1e15))
        throw CLI::ValidationError("--unit", "takes metres, more than 0");
    if (!(o.animation_error > 0 && o.animation_error <= 1))
        throw CLI::ValidationError("--animation-error", "takes a number from 0 to 1");
    if (o.recursive)
        interpret_folders(given, o);
    else if (!o.to.empty() || !o.report.empty())
        throw CLI::ValidationError("--to, --report", "are for folders: they need -r");
    bool to_dae = o.recursive ? o.to == "dae" : has_extension(o.output, {".dae"});
    if (!o.recursive && !has_extension(o.output, {".dae", ".glb", ".gltf"}))
        throw CLI::ValidationError("output", "takes a name that ends in .glb, .gltf or .dae");
    if (!to_dae && (o.up_axis.value_or(UpAxis::Y) != UpAxis::Y || o.meter.value_or(1) != 1))
        throw CLI::ValidationError("--up, --unit", "glTF is always y up and in metres");
    if (!to_dae && o.copy_textures)
        throw CLI::ValidationError("--copy-textures", "is for .dae; glTF holds its pictures");
    if (!given.threads.empty()) o.threads = parse_threads(given.threads);
    o.stats = !given.stats.empty();
    o.stats_json = given.stats == "json";
}

}  // namespace

std::optional<int> parse_convert_options(int argc, char** argv, ConvertOptions& o) {
    CLI::App app("kinora-convert: scenes from one format to another", "kinora-convert");
    Given given;
    declare(app, given, o);
    return parse_command_line(app, words_of(argc, argv), {{"--stats", "text"}},
                              [&] { interpret(given, o); });
}

}  // namespace kinora

int main(int argc, char** argv) {
    kinora::ready_standard_streams();
    kinora::ready_heap(kinora::kHeapOfStart);
    return kinora::run_program("kinora-convert", [&]() -> int {
        kinora::ConvertOptions options;
        if (std::optional<int> code = kinora::parse_convert_options(argc, argv, options))
            return *code;
        if (options.recursive) return kinora::convert_folder(options);
        kinora::Diagnostics diagnostics;
        return kinora::convert(options, diagnostics);
    });
}

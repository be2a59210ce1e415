// runtime/programs/shade/options.cpp: kinora-shade's command line.
#include <cstdio>

#include "rsl/lint/lint.h"
#include "runtime/base/numbers.h"
#include "runtime/programs/common/command_line.h"
#include "runtime/programs/shade/manual_pages.h"
#include "runtime/programs/shade/source.h"
#include "runtime/scene/images/image_io.h"

namespace kinora {

namespace {

constexpr const char* kSourceHelp = "FILE.sl, SCENE.dae#EFFECT, or - for standard input";
constexpr const char* kSourcesHelp =
    "FILE.sl, SCENE.dae (all its effects), SCENE.dae#EFFECT, or - for standard input";

void parse_size(const std::string& text, ShadeOptions& o) {
    int size[2];
    if (!read_numbers<int>(text, 'x', size) || size[0] < 1 || size[1] < 1 || size[0] > 16384 ||
        size[1] > 16384)
        throw CLI::ValidationError("--size", "takes WIDTHxHEIGHT, each 1 to 16384");
    o.width = size[0], o.height = size[1];
}

void choose_target(const std::string& name, ShadeOptions& o) {
    const jit::Target* target = jit::find_target(name);
    std::string names;
    for (const jit::Target& t : jit::targets())
        if (t.supported()) names += fmt::format(" {}", t.name);
    if (!target) throw CLI::ValidationError("--target", "'" + name + "' is none of" + names);
    if (!target->supported())
        throw CLI::ValidationError("--target", name + " cannot run here; what can:" + names);
    o.target = target;
}

// NAME=VALUE; VALUE may be empty (a text).
std::pair<std::string, std::string> name_and_value(const std::string& text, const char* option) {
    size_t equals = text.find('=');
    if (equals == 0 || equals == std::string::npos)
        throw CLI::ValidationError(option, "takes NAME=VALUE, not '" + text + "'");
    return {text.substr(0, equals), text.substr(equals + 1)};
}

// What the options' texts hold until all are known.
struct Texts {
    std::string size, target;
    std::vector<std::string> params, defines, unwarned, co_shaders;
    bool list = false;
};

// The codes of warnings that -Wno-NAME leaves out.
std::string code_of_warning(const std::string& name) {
    if (const FindingInfo* row = rsl::find_warning(name)) return row->code;
    std::vector<std::string> names = rsl::warning_names();
    std::string_view near = nearest_name(name, {names.begin(), names.end()});
    throw CLI::ValidationError(
        "-Wno-" + name, near.empty() ? "no warning has that name; 'check' prints their codes"
                                     : fmt::format("no such warning; did you mean '{}'?", near));
}

void add_telling(CLI::App& app, ShadeOptions& o) {
    app.set_version_flag("--version", "kinora-shade " KINORA_VERSION);
    app.add_flag("-q,--quiet", o.quiet, "say only errors");
    app.add_flag("-v,--verbose", o.verbose, "say more");
}

void add_compile(CLI::App& command, ShadeOptions& o, Texts& texts) {
    add_list(command, "-I", o.compile.include_directories, "DIR: where #include files are sought");
    add_list(command, "-D", texts.defines, "NAME, NAME=VALUE or NAME(X)=VALUE: define a macro");
    add_list(command, "-U", o.compile.undefines, "NAME: undefine a macro");
    add_list(command, "--coshader", texts.co_shaders,
             "HANDLE=FILE.sl: a co-shader, whose parameters are HANDLE.NAME");
    add_list(command, "--allow-external", o.allow_external,
             "DIR: a scene's shader may read files there too, outside its folder");
    command.add_flag("-E", o.preprocess_only, "print the preprocessed text only");
    command.add_flag("--Werror", o.warnings_fail, "warnings fail too (also -Werror)");
    add_choice<bool>(command, "--fail-on", o.warnings_fail, {{"warning", true}, {"error", false}},
                     "warning, as --Werror, or error (error)");
    command.add_flag("--strict", o.strict,
                     "what a scene's file leaves out is an error; a missing texture is exit 5");
    add_list(command, "--no-warning", texts.unwarned,
             "NAME: leaves a warning out, as unused-variable (also -Wno-NAME)");
}

void add_source(CLI::App& command, ShadeOptions& o, Texts& texts) {
    command.add_option("source", o.source, kSourceHelp)->required();
    add_compile(command, o, texts);
    command.add_option("--shader", o.shader, "which shader of the source (the first)");
}

void add_grid(CLI::App& command, ShadeOptions& o, Texts& texts) {
    command.add_option("--size", texts.size, "WIDTHxHEIGHT points (256x256)");
    add_list(command, "--param", texts.params,
             "NAME=VALUE: a number, several with commas, or a text");
    command.add_flag("--sphere", o.sphere, "a sphere instead of a square");
    command.add_flag("--flip", o.flip, "a light shines along -z of its space instead of z");
    command.add_option(
        "--output", o.output,
        "Ci, Oi, N, P or an output parameter of the shader; of an array NAME.0 and so on (Ci)");
    command.add_option("--target", texts.target, "avx512, avx2, neon or interp");
    add_choice<jit::math::Tier>(
        command, "--math", o.math,
        {{"precise", jit::math::Tier::Precise}, {"fast", jit::math::Tier::Fast}},
        "precise (1 ULP) or fast (4 ULP) (precise)");
    command.add_option("--iterations", o.iterations, "how often it is done, for the times")
        ->check(CLI::Range(1, 1000000));
}

void add_commands(CLI::App& app, ShadeOptions& o, Texts& texts) {
    CLI::App* check = app.add_subcommand("check", "all findings and a summary");
    check->add_option("sources", o.sources, kSourcesHelp)->required();
    add_compile(*check, o, texts);
    check->add_flag("--json", o.json, "as JSON");
    CLI::App* info = app.add_subcommand("info", "parameters, defaults, globals read and written");
    add_source(*info, o, texts);
    info->add_flag("--json", o.json, "as JSON");
    CLI::App* run = app.add_subcommand("run", "shade a grid of points to a picture");
    add_source(*run, o, texts);
    add_grid(*run, o, texts);
    run->add_option("-o", o.file, "the picture: .png or .exr");
    run->add_option("--compare", o.compare,
                    "interp (bit for bit) or reference (double precision): largest difference")
        ->check(one_of({"interp", "reference"}));
    run->add_option("--points", o.points,
                    "FILE.json: shade the points of a file instead and print numbers as JSON");
    run->add_flag("--json", o.json, "as JSON, which --points always is");
    CLI::App* dump = app.add_subcommand("dump", "what a stage of the compiler makes of it");
    add_source(*dump, o, texts);
    add_grid(*dump, o, texts);
    add_list(*dump, "--stage", o.stages,
             "tokens, ast, types, ir, ir:PASS or asm; several with commas (ir)", ',');
    CLI::App* bench = app.add_subcommand("bench", "compile times and Mpoints/s per target");
    add_source(*bench, o, texts);
    add_grid(*bench, o, texts);
    bench->add_flag("--json", o.json, "as JSON");
    CLI::App* tradeoff = app.add_subcommand(
        "tradeoff", "speed and error of each target, math tier and use of derivatives");
    add_source(*tradeoff, o, texts);
    add_grid(*tradeoff, o, texts);
    tradeoff->add_flag("--json", o.json, "as JSON, with histograms");
    CLI::App* manual = app.add_subcommand(
        "manual", "the language: functions, globals, statements, kinds of shader");
    manual->add_option(
        "name", o.source,
        "a function, global, statement, storage class, preprocessor line or kind of shader; "
        "without one, all are listed");
    manual->add_flag("--list", texts.list, "one line each (what it does without a name)");
    manual
        ->add_option(
            "--markdown", o.markdown,
            "[PAGE]: as docs has it: builtins, globals, words, statements or findings (builtins)")
        ->check(one_of(manual_pages()));
    for (CLI::App* command : app.get_subcommands({})) add_telling(*command, o);
}

// A first word that is no command deserves more than "a subcommand is required".
void check_command(const CLI::App& app, const std::vector<std::string>& words) {
    auto first = std::find_if(words.begin(), words.end(), [](const std::string& word) {
        return word != "-q" && word != "-v" && word != "--quiet" && word != "--verbose";
    });
    if (first == words.end() || first->starts_with("-")) return;
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
    if (std::find(names.begin(), names.end(), *first) != names.end()) return;
    std::string_view near = nearest_name(*first, {names.begin(), names.end()});
    throw CLI::ValidationError(
        "'" + *first + "'", near.empty()
                                ? fmt::format("no command; commands are {}", fmt::join(names, ", "))
                                : fmt::format("no command; did you mean '{}'?", near));
}

void interpret(const CLI::App& app, const Texts& texts, ShadeOptions& o) {
    o.command = app.get_subcommands().front()->get_name();
    if (!texts.size.empty()) parse_size(texts.size, o);
    if (!texts.target.empty()) choose_target(texts.target, o);
    for (const std::string& text : texts.params)
        o.params.push_back(name_and_value(text, "--param"));
    for (const std::string& text : texts.co_shaders)
        o.co_shaders.push_back(name_and_value(text, "--coshader"));
    for (const std::string& text : texts.defines)
        o.compile.defines.push_back(text.find('=') == std::string::npos
                                        ? std::pair(text, std::string("1"))
                                        : name_and_value(text, "-D"));
    for (const std::string& name : texts.unwarned) o.unwarned.push_back(code_of_warning(name));
    if (!o.markdown.empty() && !o.source.empty())
        throw CLI::ValidationError("--markdown",
                                   "writes whole pages; leave '" + o.source + "' out");
    if (o.command == "run" && o.json && o.points.empty())
        throw CLI::ValidationError("--json", "goes with --points FILE.json");
    if (!o.points.empty() && (!o.file.empty() || !texts.size.empty() || o.sphere ||
                              !o.compare.empty() || o.output != "Ci"))
        throw CLI::ValidationError(
            "--points",
            "has points of its own and prints all outputs; leave --size, --sphere, "
            "--output, --compare and -o out");
    hold_to_scene(o);
    if (!o.file.empty() && !is_image_path(o.file))
        throw CLI::ValidationError("-o", "takes a name that ends in .png or .exr");
}

}  // namespace

std::optional<int> parse_shade_options(int argc, char** argv, ShadeOptions& o) {
    CLI::App app("kinora-shade: the shader writer's tool", "kinora-shade");
    app.footer(std::string("kinora-shade COMMAND --help shows a command's options.\n") +
               kExitCodeHelp + "\n" + kEnvironmentHelp);
    app.require_subcommand(1);
    Texts texts;
    add_telling(app, o);
    add_commands(app, o, texts);
    std::vector<std::string> words = words_of(argc, argv);
    // -Werror is one word, as compilers have it; CLI11 would read -W -e -r ...
    std::replace(words.begin(), words.end(), std::string("-Werror"), std::string("--Werror"));
    constexpr std::string_view kNo = "-Wno-";
    for (std::string& word : words)
        if (word.starts_with(kNo)) word = "--no-warning=" + word.substr(kNo.size());
    return parse_command_line(
        app, words, {{"--markdown", "builtins"}}, [&] { interpret(app, texts, o); },
        [&] { check_command(app, words); });
}

}  // namespace kinora

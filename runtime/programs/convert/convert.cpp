// runtime/programs/convert/convert.cpp: reads a scene, writes another, says what was lost.
#include "runtime/programs/convert/convert.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <new>
#include <nlohmann/json.hpp>

#include "collada/document/write.h"
#include "runtime/base/parallel.h"
#include "runtime/base/stats.h"
#include "runtime/dae/export.h"
#include "runtime/description/findings.h"
#include "runtime/gltf/document/glb.h"
#include "runtime/gltf/export/export.h"
#include "runtime/load/import_scene.h"
#include "runtime/load/override_shader.h"
#include "runtime/programs/common/exit_codes.h"

namespace kinora {

namespace fs = std::filesystem;

namespace {

std::string extension(const std::string& path) {
    std::string e = fs::path(path).extension().string();
    for (char& c : e) c = char(std::tolower(c));
    return e;
}

// Prints findings and says which exit code they call for.
int tell(const Diagnostics& diag, const ConvertOptions& options) {
    Severity least = options.quiet     ? Severity::Error
                     : options.verbose ? Severity::Hint
                                       : Severity::Warning;
    bool lost = false, shader = false, usage = false;
    for (const Finding& f : diag.findings()) {
        lost |= f.info == &Code::CONVERT_LOST || f.info == &Code::CONVERT_EXTERNAL;
        bool rsl = std::string_view(f.info->code).starts_with("RSL_");
        shader |= f.severity == Severity::Error && (rsl || f.info == &Code::CONVERT_SHADER);
        usage |= f.info == &Code::MATERIAL_UNKNOWN;
        // What the reader makes of the scene matters less here than what becomes of it.
        bool said = f.severity >= least || (f.info == &Code::CONVERT_EXTRAS && !options.quiet);
        if (said) std::fputs(format_finding(f, diag.files).c_str(), stderr);
    }
    if (shader) return kExitShader;
    if (usage) return kExitUsage;
    return lost && options.strict ? kExitSomeFailed : kExitOk;
}

// To a temporary name beside the output, then renamed: a file that has its name is whole.
int write_whole(const std::string& path, std::string_view bytes) {
    fs::path target(path);
    std::error_code code;
    if (target.has_parent_path()) fs::create_directories(target.parent_path(), code);
    std::string temporary =
        (target.parent_path() / fmt::format(".{}.{}.tmp", target.filename().string(), getpid()))
            .string();
    int file = open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    bool ok = file >= 0;
    for (size_t at = 0; ok && at < bytes.size();) {
        ssize_t n = write(file, bytes.data() + at, bytes.size() - at);
        if (n < 0 && errno == EINTR) continue;
        ok = n > 0;
        if (ok) at += size_t(n);
    }
    ok = ok && fsync(file) == 0;
    int error = errno;
    if (file >= 0) close(file);
    if (ok && std::rename(temporary.c_str(), path.c_str()) != 0) {
        ok = false;
        error = errno;
    }
    if (ok) return kExitOk;
    if (file >= 0) unlink(temporary.c_str());
    fmt::print(stderr, "kinora: error: cannot write '{}': {}\n", path, std::strerror(error));
    return error == ENOSPC || error == EDQUOT ? kExitRetry : kExitUnwritable;
}

class Conversion {
  public:
    explicit Conversion(const ConvertOptions& options) : options_(options) {}

    int run() {
        Stopwatch watch;
        if (options_.threads) set_thread_count(options_.threads);
        bool to_dae = extension(options_.output) == ".dae";
        if (to_dae && !is_gltf(options_.input)) {
            std::optional<std::string> text = convert_document(options_, diag_);
            int code = tell(diag_, options_);
            if (!text) return ends(code) ? code : kExitUnreadable;
            return ends(code) ? code : finish(*text, code, watch);
        }
        if (!import()) {
            int code = tell(diag_, options_);
            return ends(code) ? code : kExitUnreadable;
        }
        for (const auto& [material, file] : options_.shaders)
            if (!override_shader(scene_, material, file, options_.include_directories, diag_)) {
                int code = tell(diag_, options_);
                return ends(code) ? code : kExitShader;
            }
        ColladaExport document;
        std::string bytes;
        if (to_dae)
            document = export_collada(scene_, options_.output, diag_);
        else
            bytes = export_glb(scene_, gltf_options(), diag_);
        int code = tell(diag_, options_);
        if (ends(code)) return code;
        if (to_dae) return finish_collada(code, watch, std::move(document));
        if (extension(options_.output) != ".gltf") return finish(bytes, code, watch);
        return finish_gltf(bytes, code, watch);
    }

  private:
    static bool ends(int code) { return code == kExitShader || code == kExitUsage; }

    bool import() {
        ImportOptions import;
        import.allow_external = options_.allow_external;
        import.confine = options_.confine;
        import.include_directories = options_.include_directories;
        std::optional<SceneDescription> scene = import_scene(options_.input, import, diag_);
        if (scene) scene_ = std::move(*scene);
        return scene.has_value();
    }

    GltfExportOptions gltf_options() const {
        GltfExportOptions o;
        o.animation_error = options_.animation_error;
        return o;
    }

    int finish_collada(int code, const Stopwatch& watch, ColladaExport result) {
        if (result.text.empty()) {
            fmt::print(stderr, "kinora: error: cannot write '{}': no reader would take it\n",
                       options_.output);
            return kExitUnwritable;
        }
        if (options_.up_axis || options_.meter)
            result.text = canonical(
                change_axes(options_.output, result.text, options_.up_axis, options_.meter, diag_));
        for (const auto& [name, bytes] : result.files)
            if (int failed =
                    write_whole((fs::path(options_.output).parent_path() / name).string(), bytes))
                return failed;
        return finish(result.text, code, watch);
    }

    static std::string canonical(const std::string& text) {
        Diagnostics quiet;
        auto document = collada::read_document_text("", text, quiet);
        return document && document->whole() ? collada::write(*document, quiet.files) : text;
    }

    // .gltf: the JSON with its buffer in a .bin beside it.
    int finish_gltf(const std::string& glb, int code, const Stopwatch& watch) {
        GlbParts parts = split_glb(glb);
        nlohmann::ordered_json json = nlohmann::ordered_json::parse(parts.json);
        fs::path bin = fs::path(options_.output).replace_extension(".bin");
        if (!parts.buffer.empty()) {
            json["buffers"][0]["uri"] = uri_of(bin.filename().string());
            parts.buffer.resize(json["buffers"][0]["byteLength"].get<size_t>());
            if (int failed = write_whole(bin.string(), parts.buffer)) return failed;
        }
        return finish(json.dump(1) + "\n", code, watch);
    }

    static std::string uri_of(const std::string& name) {
        std::string uri;
        for (char c : name)
            uri += std::isalnum(uint8_t(c)) || std::strchr("-_.~", c)
                       ? std::string(1, c)
                       : fmt::format("%{:02X}", uint8_t(c));
        return uri;
    }

    int finish(const std::string& bytes, int code, const Stopwatch& watch) {
        if (int failed = write_whole(options_.output, bytes)) return failed;
        size_t lost = 0, extras = 0;
        for (const Finding& f : diag_.findings()) {
            lost += f.info == &Code::CONVERT_LOST;
            extras += f.info == &Code::CONVERT_EXTRAS;
        }
        if (options_.stats_json)
            fmt::print("{}\n", nlohmann::json{{"bytes", bytes.size()},
                                              {"milliseconds", watch.ms()},
                                              {"lost", lost},
                                              {"extras", extras}}
                                   .dump());
        else if (options_.stats)
            fmt::print("{} bytes in {:.1f} ms; {} lost, {} in extras\n", bytes.size(), watch.ms(),
                       lost, extras);
        return code;
    }

    const ConvertOptions& options_;
    Diagnostics diag_;
    SceneDescription scene_;
};

}  // namespace

int convert(const ConvertOptions& options) {
    try {
        return Conversion(options).run();
    } catch (const std::bad_alloc&) {
        std::fputs("kinora: error: out of memory\n", stderr);
        return kExitRetry;
    }
}

}  // namespace kinora

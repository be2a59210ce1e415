// runtime/programs/convert/convert.cpp: reads a scene, writes another, says what was lost.
#include "runtime/programs/convert/convert.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <new>
#include <nlohmann/json.hpp>

#include "collada/document/open_scene.h"
#include "collada/document/write.h"
#include "runtime/base/display_path.h"
#include "runtime/base/file_extension.h"
#include "runtime/base/parallel.h"
#include "runtime/base/raise_findings.h"
#include "runtime/base/regular_file.h"
#include "runtime/base/stats.h"
#include "runtime/programs/common/exit_codes.h"
#include "runtime/programs/convert/worn_shaders_p.h"
#include "runtime/programs/convert/write_whole_p.h"
#include "runtime/scene/dae/export.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/gltf/document/glb.h"
#include "runtime/scene/gltf/export/export.h"
#include "runtime/scene/load/import_scene.h"
#include "runtime/scene/load/smooth_normals.h"

namespace kinora {

namespace fs = std::filesystem;

namespace {

// Whether a .kmz shows more than one document as it stands: then no document holds it all.
bool places_models(const std::string& path) {
    if (!collada::is_archive(path)) return false;
    Diagnostics quiet;
    std::optional<collada::SceneFile> file = collada::open_scene(path, quiet);
    return file && !file->models.empty();
}

class Conversion {
  public:
    // What the reader makes of the scene matters less here than what becomes of it.
    Conversion(const ConvertOptions& options, Diagnostics& diagnostics)
        : options_(options),
          diag_(diagnostics),
          printer_(options.findings, options.input, &Code::CONVERT_EXTRAS) {
        diag_.judge(options.findings.judgement());
    }

    int run() {
        Stopwatch watch;
        if (options_.threads) set_thread_count(options_.threads);
        bool to_dae = has_extension(options_.output, {".dae"});
        if (to_dae && !is_gltf(options_.input) && !places_models(options_.input)) {
            std::optional<std::string> text = convert_document(options_, diag_);
            if (int code = tell(text.has_value())) return code;
            return finish_document(*text, {}, watch);
        }
        if (!import()) return tell(false);
        if (scene_.meshes.empty() && raise_findings(diag_, "XML_")) return tell(false);
        WornShaders worn;
        for (const auto& [pattern, shader] : options_.shaders)
            if (!put_shader(scene_, pattern, {shader, options_.include_directories}, worn, diag_)) {
                int code = tell(true);
                return code ? code : kExitShader;
            }
        ColladaExport document;
        std::string bytes;
        if (to_dae) {
            flat_normals(scene_);  // what lacks normals is flat; in a .dae it would be creased
            document = export_collada(scene_, options_.output, diag_);
        } else {
            bytes = export_glb(scene_, gltf_options(), diag_);
        }
        if (int code = tell(true)) return code;
        if (to_dae) return finish_collada(watch, std::move(document));
        if (int failed = write_unpacked()) return failed;
        if (!has_extension(options_.output, {".gltf"})) return finish(bytes, watch);
        return finish_gltf(bytes, watch);
    }

  private:
    // Prints findings. Not 0: nothing is written.
    int tell(bool readable) {
        if (!readable) raise_findings(diag_, "XML_");
        printer_.print(diag_);
        printer_.summarize();
        for (const Finding& f : diag_.findings()) {
            if (f.severity != Severity::Error) continue;
            bool rsl = std::string_view(f.info->code).starts_with("RSL_");
            if (rsl || f.info == &Code::CONVERT_SHADER) return kExitShader;
            for (const FindingInfo* usage :
                 {&Code::MATERIAL_UNKNOWN, &Code::SHADER_UNKNOWN, &Code::SHADER_OF_OTHER_KIND})
                if (f.info == usage) return kExitUsage;
        }
        if (readable) return printer_.exit_code_of_errors();
        if (!diag_.has_errors())
            fmt::print(stderr, "kinora: error: '{}' cannot be converted\n", options_.input);
        return kExitUnreadable;
    }

    bool import() {
        ImportOptions import;
        import.allow_external = options_.allow_external;
        import.confine = options_.confine;
        import.ignore_required = options_.ignore_required;
        import.include_directories = options_.include_directories;
        std::optional<SceneDescription> scene = import_scene(options_.input, import, diag_);
        if (scene) scene_ = std::move(*scene);
        return scene.has_value();
    }

    GltfExportOptions gltf_options() {
        GltfExportOptions o;
        o.link = [this, beside = link_from(options_.output)](const std::string& file) {
            std::string archived = unpacked_name(file);
            return archived.empty() ? beside(file) : archived;
        };
        o.animation_error = options_.animation_error;
        return o;
    }

    // Where a file of an archive goes, beside the output; "" for other files.
    std::string unpacked_name(const std::string& file) {
        std::string shown = display_path(file), archive = options_.input + "!";
        if (shown == file || !shown.starts_with(archive)) return "";
        std::string folder = fs::path(options_.output).stem().string() + "_files";
        fs::path name = (folder / fs::path(shown.substr(archive.size()))).lexically_normal();
        return unpacked_.emplace(name.generic_string(), file).first->first;
    }

    int write_unpacked() {
        fs::path folder = fs::path(options_.output).parent_path();
        for (const auto& [name, file] : unpacked_)
            if (std::optional<std::string> bytes = read_regular_file(file))
                if (int failed = write_whole((folder / name).string(), *bytes)) return failed;
        return kExitOk;
    }

    int finish_collada(const Stopwatch& watch, ColladaExport result) {
        if (result.text.empty()) {
            fmt::print(stderr, "kinora: error: cannot write '{}': no reader would take it\n",
                       options_.output);
            return kExitUnwritable;
        }
        if (options_.up_axis || options_.meter)
            result.text = rewritten(
                change_axes(options_.output, result.text, options_.up_axis, options_.meter, diag_));
        WrittenFiles files;
        for (auto& [name, bytes] : result.files) files.push_back({name, std::move(bytes)});
        return finish_document(result.text, std::move(files), watch);
    }

    // A .dae and what lies beside it.
    int finish_document(std::string text, WrittenFiles files, const Stopwatch& watch) {
        if (options_.copy_textures) text = rewritten(copy_textures(options_.output, text, files));
        for (const WrittenFile& file : files)
            if (int failed = write_whole(
                    (fs::path(options_.output).parent_path() / file.name).string(), file.bytes))
                return failed;
        return finish(text, watch);
    }

    // With line ends where edits left none; an indented document stays so.
    static std::string rewritten(const std::string& text) {
        Diagnostics quiet;
        auto document = collada::read_document_text("", text, quiet);
        if (!document || !document->whole()) return text;
        bool indented = text.find("\n  <") != text.npos;
        return collada::write(*document, quiet.files,
                              indented ? collada::Layout::Indented : collada::Layout::Lines);
    }

    // .gltf: the JSON with its buffer in a .bin beside it.
    int finish_gltf(const std::string& glb, const Stopwatch& watch) {
        GlbParts parts = split_glb(glb);
        nlohmann::ordered_json json = nlohmann::ordered_json::parse(parts.json);
        fs::path bin = fs::path(options_.output).replace_extension(".bin");
        if (!parts.buffer.empty()) {
            json["buffers"][0]["uri"] = uri_of(bin.filename().string());
            parts.buffer.resize(json["buffers"][0]["byteLength"].get<size_t>());
            if (int failed = write_whole(bin.string(), parts.buffer)) return failed;
        }
        return finish(json.dump(1) + "\n", watch);
    }

    static std::string uri_of(const std::string& name) {
        std::string uri;
        for (char c : name)
            uri += std::isalnum(uint8_t(c)) || std::strchr("-_.~", c)
                       ? std::string(1, c)
                       : fmt::format("%{:02X}", uint8_t(c));
        return uri;
    }

    int finish(const std::string& bytes, const Stopwatch& watch) {
        printer_.print(diag_);  // what other axes cannot keep
        printer_.summarize();
        if (int failed = write_whole(options_.output, bytes)) return failed;
        size_t lost = 0, external = 0, extras = 0;
        for (const Finding& f : diag_.findings()) {
            lost += f.info == &Code::CONVERT_LOST;
            external += f.info == &Code::CONVERT_EXTERNAL;
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
        bool incomplete = options_.findings.strict && lost + external > 0;
        return incomplete ? int(kExitSomeFailed) : printer_.exit_code(kExitOk);
    }

    const ConvertOptions& options_;
    Diagnostics& diag_;
    FindingPrinter printer_;
    SceneDescription scene_;
    std::map<std::string, std::string> unpacked_;  // where it goes, from the output; the file
};

}  // namespace

int convert(const ConvertOptions& options, Diagnostics& diagnostics) {
    try {
        return Conversion(options, diagnostics).run();
    } catch (const std::bad_alloc&) {  // ends this file, not the folder that it is of
        std::fputs("kinora: error: out of memory\n", stderr);
        return kExitRetry;
    }
}

}  // namespace kinora

// runtime/programs/render/fingerprint.cpp: hashes of what a picture depends on.
#include "runtime/programs/render/fingerprint.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "rsl/model/renderer_services.h"
#include "runtime/base/display_path.h"
#include "runtime/base/files/build_id.h"
#include "runtime/base/files/content_hash.h"
#include "runtime/base/regular_file.h"
#include "runtime/scene/aovs/aovs.h"
#include "runtime/scene/description/texture_name.h"
#include "runtime/scene/quality/knobs.h"

namespace kinora {

namespace {

// Files that strings of shaders name: parameters, their defaults, literals. Before the first frame:
// then strings that shaders put together come to these.
std::set<std::string> named_files(const SceneDescription& description) {
    std::set<std::string> files;
    for (int32_t id = 1; id < rsl::interned_count(); ++id) {
        std::string name = parse_texture_name(rsl::interned(id)).path;
        if (name.empty() || name.find('\0') != std::string::npos) continue;
        for (const AllowedPaths* trees : {&description.readable, &description.pictures}) {
            auto [path, outside] = trees->find(name);
            if (!outside && is_regular_file(path)) files.insert(path);
        }
    }
    return files;
}

uint64_t hash_of(std::string_view text) {
    ContentHash hash;
    hash.add_text(text);
    return hash.value();
}

}  // namespace

uint64_t hash_inputs(const SourceFiles& texts, const SceneDescription& description,
                     const std::string& scene, KnownHashes& known, FileId shared) {
    ContentHash hash;
    for (FileId f = 0; f < texts.count(); ++f) {
        if (f >= known.texts.size() && f < shared) known.texts.push_back(hash_of(texts.text(f)));
        const uint64_t text = f < shared ? known.texts[f] : hash_of(texts.text(f));
        hash.add(&text, sizeof text);
    }
    // A file by what is in it, wherever it lies, with how a texture's name says to read it.
    auto add_file = [&](const std::string& text) {
        const size_t modes = std::min(text.find('\x1f'), text.size());
        const std::string path = text.substr(0, modes);
        const std::optional<uint64_t> content = known.files.of(path);
        hash.add_text(content ? text.substr(modes) : display_path(text));
        if (content) hash.add(&*content, sizeof *content);
        if (!content && is_regular_file(path)) hash.add_text("unreadable");
    };
    add_file(scene);
    for_each_shader_use(description, [&](const ShaderUse& use) {
        for (const ParamSource& source : use.params)
            for (const std::string& text : source.strings) add_file(text);
    });
    for (const std::string& file : description.inputs) add_file(file);
    // Maps that earlier pictures of the file are: those depend on files of their own.
    if (description.file_picture)
        for (const auto& map : description.memory_files)
            hash.add(map->bytes().data(), map->bytes().size());
    for (const std::string& file : named_files(description)) add_file(file);
    return hash.value();
}

std::string fingerprint(const RenderOptions& o, uint64_t inputs, int width, int height, double rate,
                        double time) {
    std::string text = fmt::format(
        "kinora {} {} {:016x} {}x{} {} {} filter width {} seed {} nan {} color {} camera {} up {} "
        "unit {} dice limit {} time {:a}",
        KINORA_VERSION, build_id(), inputs, width, height, o.quality.name, knob_texts(o.quality),
        o.filter_width, o.seed, int(o.nan), int(encoding_of(o)), o.camera,
        o.up_axis ? int(*o.up_axis) : -1, o.meter.value_or(0), o.dice_limit, time);
    text += fmt::format(" exposure {} {}", o.auto_exposure, o.exposure);
    if (o.background)
        text +=
            fmt::format(" background {} {} {}", o.background->x, o.background->y, o.background->z);
    text += fmt::format(" imager {} atmosphere {} aovs {} transparency {}", o.imager, o.atmosphere,
                        fmt::join(o.aovs, ","), int(o.transparency));
    for (const std::string& group : o.light_groups) text += fmt::format(" group {}", group);
    text += fmt::format(" lights {} gi {} hide {} only {} clip {}", int(o.lights), o.gi,
                        fmt::join(o.hide, ","), fmt::join(o.only, ","), o.clip);
    auto point = [](const std::optional<dvec3>& p) {
        return p ? fmt::format("{:a},{:a},{:a}", p->x, p->y, p->z) : "none";
    };
    text += fmt::format(" follow {} turntable {} rate {} fov {:a} from {} at {}", o.follow,
                        o.turntable.value_or(0), o.turntable || o.follow ? rate : 0.0, o.yfov,
                        point(o.look_from), o.look_at);
    const EnvironmentGiven& around = o.environment;
    if (around.any())
        text += fmt::format(" environment {} {} {} {}", around.what, around.rotation.value_or(0),
                            around.brightness.value_or(1), around.hidden);
    if (o.smooth) text += fmt::format(" smooth {}", *o.smooth);
    text += fmt::format(" emission {} vertex colors {} ignore {}", int(o.emission), o.vertex_colors,
                        o.ignore_required);
    for (const auto* changes : {&o.shaders, &o.params})
        for (const auto& [what, value] : *changes) text += fmt::format(" {}={}", what, value);
    if (o.frame_target.any())
        text += fmt::format(" {} {}", target_text(o.frame_target), o.fixed_settings);
    const bool motion = std::ranges::any_of(o.aovs, [](const std::string& aov) {
        return aov.starts_with("motion") || aov.starts_with(kAllAovs);
    });
    if (motion) text += fmt::format(" motion at {}", rate);
    if (o.exr.parts || o.exr.compression)
        text += fmt::format(" parts {} compression {}:{}", o.exr.parts,
                            o.exr.compression ? o.exr.compression->name : "zip", o.exr.level);
    if (!o.owner.empty()) text += fmt::format(" owner {}", o.owner);
    if (o.session) text += session_text(*o.session);
    ContentHash hash;
    hash.add_text(text);
    return hash.digits();
}

}  // namespace kinora

// runtime/picture/explain/explain.cpp: settings, the order of sections, text and JSON.
#include "runtime/picture/explain/explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "runtime/picture/explain/explain_p.h"
#include "runtime/scene/camera.h"
#include "runtime/scene/quality/knobs.h"
#include "runtime/scene/values.h"

namespace kinora {

namespace {

constexpr size_t kShownRows = 20;  // of a section, as text

void explain_settings(const Quality& quality, std::string_view preset, ExplainedRows& rows) {
    const Quality* base = find_quality(preset);
    for (const Knob& knob : knobs()) {
        std::string value = knob_text(knob, quality);
        bool by_preset = base && value == knob_text(knob, *base);
        rows.add(
            std::string(knob.option), value,
            by_preset ? fmt::format("--quality {}", preset) : fmt::format("--{}", knob.option));
    }
}

void explain_added(const Scene& scene, const Pose&, ExplainedRows& rows) {
    for (const std::string& name : scene.added) rows.add(name, "added", "the file has none in use");
}

void explain_aovs(const Scene& scene, const Pose&, ExplainedRows& rows) {
    std::string_view last;
    for (const OutputPlane& plane : scene.outputs) {
        if (!plane.in_file || plane.layer == last) continue;
        last = plane.layer;
        const AovRow* row = find_aov_row(plane.layer);
        const bool built_in = row && row->source == plane.source;
        rows.add(
            plane.layer, built_in ? std::string(row->what) : "an output of shaders",
            fmt::format("filter {}, background {:g}", word_of(plane.filter), plane.background));
    }
}

// The nodes and the camera of a pose that has made no frame.
void stand_at_start(const Scene& scene, Pose& pose) {
    evaluate_anew(scene, pose, scene.options.start_time);
    set_view(scene, pose, scene.options.width, std::max(scene.options.height, 1));
}

constexpr struct {
    std::string_view name;
    void (*explain)(const Scene&, const Pose&, ExplainedRows&);
} kSections[] = {
    {"added", explain_added},     {"meshes", explain_meshes}, {"animation", explain_animation},
    {"shaders", explain_shaders}, {"lights", explain_lights}, {"textures", explain_textures},
    {"passes", explain_passes},   {"aovs", explain_aovs},
};

}  // namespace

std::vector<Explained> explain(const Scene& scene, const Pose& pose, const Quality& quality,
                               std::string_view preset) {
    std::optional<Pose> begins;
    if (pose.first_frame) stand_at_start(scene, begins.emplace(scene));
    const Pose& seen = begins ? *begins : pose;
    std::vector<Explained> found;
    ExplainedRows rows(found);
    rows.section("settings");
    explain_settings(quality, preset, rows);
    for (const auto& section : kSections) {
        rows.section(section.name);
        const size_t first = found.size();
        section.explain(scene, seen, rows);
        std::stable_partition(found.begin() + ptrdiff_t(first), found.end(),
                              [](const Explained& row) { return row.modelled; });
    }
    return found;
}

std::string explained_text(const std::vector<Explained>& rows) {
    std::string text;
    std::string_view section;
    size_t shown = 0, more = 0;
    auto end_section = [&] {
        if (more) text += fmt::format("  and {} more: --explain=json has all\n", more);
        shown = more = 0;
    };
    for (const Explained& row : rows) {
        if (row.section != section) {
            end_section();
            section = row.section;
            text += fmt::format("{}\n", section);
        }
        if (shown == kShownRows) {
            ++more;
            continue;
        }
        ++shown;
        text += fmt::format("  {} {}: {}{}{}\n", row.modelled ? "+" : "-", row.subject, row.what,
                            row.why.empty() ? "" : "; ", row.why);
    }
    end_section();
    return text;
}

std::string explained_json(const std::vector<Explained>& rows) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    for (const Explained& row : rows)
        json[std::string(row.section)].push_back({{"subject", row.subject},
                                                  {"modelled", row.modelled},
                                                  {"what", row.what},
                                                  {"why", row.why}});
    return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace kinora

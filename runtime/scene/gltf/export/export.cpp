// runtime/scene/gltf/export/export.cpp: a SceneDescription as a .glb, part by part.
#include "runtime/scene/gltf/export/export.h"

#include <fmt/format.h>

#include <algorithm>

#include <nlohmann/json.hpp>

#include "runtime/scene/description/interface_losses.h"
#include "runtime/scene/gltf/curves/trs.h"
#include "runtime/scene/gltf/document/glb.h"
#include "runtime/scene/gltf/export/content.h"
#include "runtime/scene/gltf/export/scene_extras.h"

namespace kinora {

namespace {

// The node of axes and unit; kNone where the scene has glTF's.
uint32_t write_axes(const SceneDescription& description, const dmat4& axes, NodeWriter& nodes,
                    GltfDocument& document) {
    if (is_identity(axes)) return kNone;
    uint32_t root = nodes.write_still(axes, kNone);
    static constexpr const char* kAxes[] = {"X", "Y", "Z"};
    document.node(root)["name"] = "axes and unit";
    document.node(root)["extras"]["kinora_axes"] = {{"up", kAxes[size_t(description.up_axis)]},
                                                    {"meter", description.meter}};
    return root;
}

void report_lost_light_lists(const SceneDescription& description, LossReport& losses) {
    auto has_list = [](const MeshUse& use) { return use.lights.has_value(); };
    auto lists = [&](const NodeDefinition& node) {
        return std::ranges::any_of(node.meshes, has_list);
    };
    if (std::ranges::any_of(description.nodes, lists))
        losses.lost("the scene", "which lights shine on which meshes");
}

// What glTF's animations cannot say of the scene's.
void report_lost_times(const anim::Animation& animation, LossReport& losses) {
    anim::TimeRange range = anim::time_range(animation);
    if (range.begin < 0 && !animation.channels.empty())
        losses.lost("the animation",
                    fmt::format("what moves before time 0 (from {} s)", range.begin));
    for (const anim::Sampler& sampler : animation.samplers)
        if (sampler.pre != anim::Behaviour::Constant || sampler.post != anim::Behaviour::Constant) {
            losses.lost("the animation",
                        "what goes on beyond the range that is played (behaviours)");
            break;
        }
}

}  // namespace

std::string export_glb(const SceneDescription& description, const GltfExportOptions& options,
                       Diagnostics& diagnostics) {
    LossReport losses(diagnostics);
    GltfDocument document;
    BufferWriter buffer(document);
    std::vector<Take> takes = find_takes(description);
    CurveWriter curves(takes, options.animation_error, document, buffer);
    NodeMotion motion(description, takes, curves);
    PointerMotion pointers(description, takes, curves);
    NodeWriter nodes(description, motion, document, losses);

    dmat4 axes = gltf_axes(description);
    uint32_t root = write_axes(description, axes, nodes, document);
    Occurrences occurrences(description, root, nodes, document);
    SceneBounds bounds = bounds_of(description, occurrences, axes);

    GltfLooks looks(description, diagnostics);
    TextureWriter textures(description.pictures, document, buffer, losses);
    RslWriter rsl(description, textures, pointers, losses, options.link);
    SurfaceWriter surfaces(textures, document, losses);
    MaterialWriter materials(description, looks, surfaces, rsl, pointers, document, losses);
    MeshWriter meshes(description, looks, materials, document, buffer, losses);
    SkinWriter skins(description, root, occurrences, nodes, document, buffer);
    CameraWriter cameras(description, bounds, rsl, pointers, document, losses);
    LightWriter lights(description, bounds, axes, rsl, pointers, document, losses);
    ContentWriter content(description, occurrences, meshes, skins, cameras, lights, nodes, motion,
                          document);
    for (uint32_t o = 0; o < occurrences.size(); ++o) content.write(o);
    give_skins_a_root(document);

    write_scene_shaders(description, rsl, document, losses);
    curves.write_animations();
    write_scene_extras(description, takes, curves, document, losses);
    report_lost_times(description.animation, losses);
    report_lost_light_lists(description, losses);
    for (std::string_view what : interface_losses(description))
        losses.lost("the scene", std::string(what));
    if (description.environment) losses.lost("the scene", "its environment");
    curves.report(losses);
    losses.hidden(document.hidden());
    if (buffer.unsound())
        losses.lost("the scene", fmt::format("{} numbers that no float holds (0 stands for them)",
                                             buffer.unsound()));
    return join_glb({document.text(buffer.bytes().size()), buffer.bytes()});
}

}  // namespace kinora

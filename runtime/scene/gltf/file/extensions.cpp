// runtime/scene/gltf/file/extensions.cpp: what is known of glTF's extensions.
#include "runtime/scene/gltf/file/extensions.h"

#include <algorithm>

#include "runtime/scene/description/findings.h"
#include "runtime/scene/gltf/file/json_scan.h"

namespace kinora {

namespace {

// Read and shown.
constexpr std::string_view kUnderstood[] = {
    "KHR_lights_punctual",    "KHR_materials_unlit",
    "KHR_texture_transform",  "KHR_mesh_quantization",
    "KHR_materials_ior",      "KHR_materials_emissive_strength",
    "KHR_materials_specular", "KHR_materials_pbrSpecularGlossiness",
    "KHR_node_visibility",    "KHR_animation_pointer",
};

// The picture is the same without them: choices whose default stands in the file itself, metadata,
// sound, and what moves at a user's hand.
constexpr std::string_view kUnseen[] = {
    "AGI_articulations",
    "AGI_stk_metadata",
    "CESIUM_primitive_outline",
    "EXT_feature_metadata",
    "EXT_instance_features",
    "EXT_mesh_features",
    "EXT_structural_metadata",
    "FB_geometry_metadata",
    "KHR_audio_emitter",
    "KHR_implicit_shapes",
    "KHR_interactivity",
    "KHR_materials_variants",
    "KHR_node_hoverability",
    "KHR_node_selectability",
    "KHR_physics_rigid_bodies",
    "KHR_xmp",
    "KHR_xmp_json_ld",
    "MSFT_audio_emitter",
    "MSFT_lod",
    "OMI_physics_body",
    "OMI_physics_shape",
    "VRM",
    "VRMC_springBone",
    "VRMC_vrm",
};

// Parts of the names of those that change the picture.
constexpr std::string_view kShown[] = {"_materials_", "_texture_",   "_mesh_",
                                       "_lights_",    "_animation_", "_draco_"};

template <size_t N>
bool is_among(const std::string& extension, const std::string_view (&names)[N]) {
    return std::find(std::begin(names), std::end(names), extension) != std::end(names);
}

bool is_shown(const std::string& extension) {
    auto within = [&](std::string_view part) { return extension.find(part) != std::string::npos; };
    return std::any_of(std::begin(kShown), std::end(kShown), within);
}

}  // namespace

bool check_extensions(const GltfFile& file, const ImportOptions& options,
                      Diagnostics& diagnostics) {
    bool readable = true;
    std::vector<std::string> required = json_strings(file.json, "/extensionsRequired");
    for (const std::string& extension : required) {
        if (is_among(extension, kUnderstood)) continue;
        bool unseen = is_among(extension, kUnseen);
        bool refused = !unseen && !options.ignore_required;
        diagnostics.report(refused  ? Code::GLTF_EXTENSION_REQUIRED
                           : unseen ? Code::GLTF_EXTENSION
                                    : Code::GLTF_EXTENSION_SHOWN,
                           gltf_location(file, "/extensionsRequired"), extension);
        readable &= !refused;
    }
    for (const std::string& extension : json_strings(file.json, "/extensionsUsed")) {
        if (is_among(extension, kUnderstood) || std::ranges::count(required, extension) > 0)
            continue;
        bool shown = is_shown(extension) && !is_among(extension, kUnseen);
        diagnostics.report(shown ? Code::GLTF_EXTENSION_SHOWN : Code::GLTF_EXTENSION,
                           gltf_location(file, "/extensionsUsed"), extension);
    }
    return readable;
}

}  // namespace kinora

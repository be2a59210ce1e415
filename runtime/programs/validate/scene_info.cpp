// runtime/programs/validate/scene_info.cpp: counts of what the visual scene reaches.
#include "runtime/programs/validate/scene_info.h"

#include <algorithm>
#include <set>

#include "runtime/programs/validate/scene_walk.h"

namespace kinora {

namespace {

using collada::kNone;

struct Seen {
    std::set<uint32_t> geometries, skins, joints, materials, effects;
};

size_t uv_sets(const collada::Geometry& geometry) {
    std::set<uint32_t> sets;
    for (const collada::PrimitiveGroup& group : geometry.groups)
        for (const collada::VertexInput& input : group.inputs)
            if (input.semantic == "TEXCOORD") sets.insert(input.set);
    return sets.size();
}

size_t most_influences(const collada::Skin& skin) {
    size_t most = 0;
    for (size_t i = 0; i + 1 < skin.offsets.size(); ++i) {
        auto first = skin.influence_weights.begin();
        most = std::max(most,
                        size_t(std::count_if(first + skin.offsets[i], first + skin.offsets[i + 1],
                                             [](float w) { return w != 0; })));
    }
    return most;
}

void add_skin(const collada::Skin& skin, const collada::MeshInstance& mesh, DocumentInfo& info,
              Seen& seen) {
    info.joints_per_skin = std::max(info.joints_per_skin, skin.joints.size());
    info.influences = std::max(info.influences, most_influences(skin));
    for (uint32_t joint : mesh.joint_nodes)
        if (joint != kNone) seen.joints.insert(joint);
}

void add_mesh(const collada::SceneData& scene, const collada::MeshInstance& mesh,
              DocumentInfo& info, Seen& seen) {
    for (const collada::MaterialBinding& binding : mesh.materials)
        if (binding.material != kNone) seen.materials.insert(binding.material);
    if (mesh.geometry == kNone) return;
    const collada::Geometry& geometry = scene.geometries[mesh.geometry];
    seen.geometries.insert(mesh.geometry);
    ++info.mesh_instances;
    for (const collada::PrimitiveGroup& group : geometry.groups)
        info.triangles += group.triangle_count();
    info.vertices += geometry.positions.size();
    info.lines += geometry.line_count;
    info.uv_sets = std::max(info.uv_sets, uv_sets(geometry));
    if (mesh.morph != kNone)
        info.morph_targets = std::max(info.morph_targets, scene.morphs[mesh.morph].targets.size());
    if (mesh.skin == kNone) return;
    seen.skins.insert(mesh.skin);
    add_skin(scene.skins[mesh.skin], mesh, info, seen);
}

std::string first_name(const std::string& id, const std::string& name) {
    return id.empty() ? name : id;
}

// Images that samplers or parameters of the materials' effects name.
std::set<uint32_t> images_of(const collada::SceneData& scene, const std::set<uint32_t>& effects) {
    std::set<uint32_t> images;
    for (uint32_t e : effects) {
        const collada::Effect& effect = scene.effects[e];
        for (const collada::TextureSampler& sampler : effect.samplers)
            if (sampler.image != kNone) images.insert(sampler.image);
        for (const collada::Param& param : effect.params)
            if (param.value.image != kNone) images.insert(param.value.image);
        if (!effect.rsl) continue;
        for (const collada::RslShader& shader : effect.rsl->shaders)
            for (const collada::RslBind& bind : shader.binds)
                if (bind.param == kNone && bind.literal.image != kNone)
                    images.insert(bind.literal.image);
    }
    return images;
}

TextureInfo texture_info(const collada::Image& image) {
    TextureInfo info{first_name(image.id, image.name), image.uri, !image.path.empty(), 0, 0, {}};
    if (auto size = image_size(image.path)) {
        info.width = size->width;
        info.height = size->height;
        info.format = size->format;
    }
    return info;
}

void add_looks(const collada::SceneData& scene, DocumentInfo& info, Seen& seen) {
    for (uint32_t m : seen.materials) {
        const collada::Material& material = scene.materials[m];
        info.materials.push_back(first_name(material.id, material.name));
        if (material.effect != kNone) seen.effects.insert(material.effect);
    }
    for (uint32_t image : images_of(scene, seen.effects))
        info.textures.push_back(texture_info(scene.images[image]));
}

void add_animation(const collada::SceneData& scene, DocumentInfo& info) {
    info.channels = scene.channels.size();
    for (const collada::Channel& channel : scene.channels) {
        const std::vector<double>& times = scene.samplers[channel.sampler].times;
        if (times.empty()) continue;
        if (!info.animated) info.animated = {times.front(), times.back()};
        info.animated->first = std::min(info.animated->first, times.front());
        info.animated->second = std::max(info.animated->second, times.back());
    }
    for (const collada::Clip& clip : scene.clips)
        info.clips.push_back(
            {first_name(clip.name, clip.id), clip.start, clip.end, clip.channels.size()});
}

}  // namespace

DocumentInfo scene_info(const collada::Document& document, const collada::SceneData& scene) {
    constexpr const char* kVersions[] = {"1.4.0", "1.4.1", "1.5.0"};
    DocumentInfo info;
    info.version = kVersions[size_t(document.version())];
    info.unit = scene.asset.unit_name;
    info.meter = scene.asset.meter;
    info.up = "XYZ"[size_t(scene.asset.up_axis)];
    Seen seen;
    for (const PlacedNode& placed : placed_nodes(scene)) {
        const collada::Node& node = scene.nodes[placed.node];
        ++info.nodes;
        info.cameras += node.cameras.size();
        info.lights += node.lights.size();
        for (const collada::MeshInstance& mesh : node.meshes) add_mesh(scene, mesh, info, seen);
    }
    info.meshes = seen.geometries.size();
    info.skins = seen.skins.size();
    info.joints = seen.joints.size();
    add_looks(scene, info, seen);
    add_animation(scene, info);
    info.bounds = rest_bounds(scene);
    return info;
}

}  // namespace kinora

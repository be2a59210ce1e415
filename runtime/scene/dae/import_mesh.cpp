// runtime/scene/dae/import_mesh.cpp: COLLADA's geometries and controllers as a SceneDescription.
#include <algorithm>

#include "runtime/scene/dae/import_p.h"
#include "runtime/scene/description/display_color.h"

namespace kinora {

namespace {

// Takes the indices of `from`.
PrimitiveGroup primitive_group(const collada::Geometry& geometry, collada::PrimitiveGroup& from) {
    PrimitiveGroup group;
    group.symbol = from.material;
    for (const collada::VertexInput& input : from.inputs) {
        const collada::FloatSource& source = geometry.sources[input.source];
        group.attributes.push_back(
            {input.semantic, input.set, source.stride, source.values, from.indices[input.list]});
    }
    group.triangles = std::move(from.indices[0]);
    from = {};
    return group;
}

// Alpha and what is no colour stay.
VertexAttribute in_linear_light(VertexAttribute color) {
    color.semantic = kLinearColor;
    for (size_t i = 0; color.stride >= 3 && i + color.stride <= color.values.size();
         i += color.stride) {
        float* v = &color.values[i];
        dvec3 linear = linear_of_display({v[0], v[1], v[2]});
        for (int k = 0; k < 3; ++k) v[k] = float(linear[k]);
    }
    return color;
}

}  // namespace

void ColladaImport::import_meshes() {
    out_.meshes.reserve(out_.meshes.size() + data_.geometries.size());
    // Each is let go as soon as it is copied, so that all of them never stand in memory twice.
    for (collada::Geometry& from : data_.geometries) {
        MeshDefinition& to = out_.meshes.emplace_back();
        to.id = from.id;
        to.name = from.name;
        to.where = from.where;
        to.positions = std::move(from.positions);
        to.double_sided = from.double_sided;
        to.groups.reserve(from.groups.size());
        for (collada::PrimitiveGroup& group : from.groups)
            to.groups.push_back(primitive_group(from, group));
        from = {};
    }
}

// Where profile_COMMON or the default surface reads vertex colours. What RSL reads is as written.
void ColladaImport::add_linear_vertex_colors() {
    if (!options_.decode_colors) return;
    auto reads_linear = [&](const MeshUse& use, const PrimitiveGroup& group) {
        for (const MaterialUse& material : use.materials) {
            if (material.symbol != group.symbol || material.material == kNone) continue;
            const auto& surfaces = out_.materials[material.material].surfaces;
            if (surfaces.empty()) return true;
            return surfaces.back().linear_inputs;
        }
        return true;
    };
    auto has = [](const PrimitiveGroup& group, const char* semantic) {
        return std::any_of(group.attributes.begin(), group.attributes.end(),
                           [&](const VertexAttribute& a) { return a.semantic == semantic; });
    };
    for (const NodeDefinition& node : out_.nodes)
        for (const MeshUse& use : node.meshes) {
            if (use.mesh == kNone) continue;
            for (PrimitiveGroup& group : out_.meshes[use.mesh].groups) {
                bool wanted = has(group, "COLOR") && !has(group, kLinearColor);
                if (!wanted || !reads_linear(use, group)) continue;
                std::vector<VertexAttribute> colors;
                for (const VertexAttribute& a : group.attributes)
                    if (a.semantic == "COLOR") colors.push_back(in_linear_light(a));
                group.attributes.insert(group.attributes.end(), colors.begin(), colors.end());
            }
        }
}

void ColladaImport::import_skins() {
    for (collada::Skin& from : data_.skins) {
        SkinDefinition& to = out_.skins.emplace_back();
        to.id = from.id;
        to.bind_shape = from.bind_shape_matrix;
        to.has_bind_shape = from.has_bind_shape_matrix;
        to.joint_names = from.joints;
        to.inverse_bind = from.inverse_bind;
        to.offsets = std::move(from.offsets);
        to.joints = std::move(from.influence_joints);
        to.weights = std::move(from.influence_weights);
        to.weights_told = true;
        to.where = from.where;
    }
}

void ColladaImport::import_morphs() {
    for (size_t m = 0; m < data_.morphs.size(); ++m) {
        const collada::Morph& from = data_.morphs[m];
        out_.morphs.push_back({from.id,
                               from.method == collada::MorphMethod::Relative,
                               from.targets,
                               {morph_values_[m], uint32_t(from.weights.size())},
                               from.where,
                               from.base});
    }
}

}  // namespace kinora

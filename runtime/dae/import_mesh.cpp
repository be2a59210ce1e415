// runtime/dae/import_mesh.cpp: COLLADA's geometries and controllers as a SceneDescription.
#include "runtime/dae/import_p.h"

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

}  // namespace

void ColladaImport::import_meshes() {
    out_.meshes.reserve(out_.meshes.size() + data_.geometries.size());
    // Each is let go as soon as it is copied, so that all of them never stand in memory twice.
    for (collada::Geometry& from : data_.geometries) {
        MeshDefinition& to = out_.meshes.emplace_back();
        to.id = from.id;
        to.name = from.name;
        to.positions = std::move(from.positions);
        to.double_sided = from.double_sided;
        to.groups.reserve(from.groups.size());
        for (collada::PrimitiveGroup& group : from.groups)
            to.groups.push_back(primitive_group(from, group));
        from = {};
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

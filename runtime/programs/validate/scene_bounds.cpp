// runtime/programs/validate/scene_bounds.cpp: where the surfaces of the rest pose lie.
#include <cmath>
#include <map>

#include "runtime/programs/validate/scene_info.h"
#include "runtime/programs/validate/scene_walk.h"

namespace kinora {

namespace {

using collada::kNone;

class RestBounds {
  public:
    explicit RestBounds(const collada::SceneData& scene) : scene_(scene) {
        placed_ = placed_nodes(scene);
        for (const PlacedNode& p : placed_) world_.try_emplace(p.node, p.world);
    }

    std::optional<RestBox> run() {
        for (const PlacedNode& p : placed_)
            for (const collada::MeshInstance& mesh : scene_.nodes[p.node].meshes)
                add(mesh, p.world);
        if (!any_) return std::nullopt;
        double meter = scene_.asset.meter;
        return RestBox{bounds_.low * meter, bounds_.high * meter};
    }

  private:
    void add(const collada::MeshInstance& mesh, const dmat4& node_world) {
        if (mesh.geometry == kNone) return;
        std::vector<dvec3> positions = morphed(mesh.geometry, mesh.morph);
        dmat4 change = mesh.conversion == kNone ? dmat4(1.0) : scene_.conversions[mesh.conversion];
        bool skinned = mesh.skin != kNone && skin(scene_.skins[mesh.skin], mesh, positions);
        dmat4 m = skinned ? dmat4(1.0) : node_world * change;
        const collada::Geometry& geometry = scene_.geometries[mesh.geometry];
        for (const collada::PrimitiveGroup& group : geometry.groups)
            for (uint32_t index : group.indices[0]) extend(dvec3(m * dvec4(positions[index], 1)));
    }

    // COLLADA 1.4.1, morph: NORMALIZED: (1 - sum w) base + sum w target; RELATIVE: base + sum.
    std::vector<dvec3> morphed(uint32_t geometry, uint32_t number) const {
        if (number == kNone) return scene_.geometries[geometry].positions;
        const collada::Morph& morph = scene_.morphs[number];
        std::vector<dvec3> positions = morphed(geometry, morph.base);
        double sum = 0;
        for (double weight : morph.weights) sum += weight;
        if (morph.method == collada::MorphMethod::Normalized)
            for (dvec3& p : positions) p *= 1 - sum;
        for (size_t t = 0; t < morph.targets.size() && t < morph.weights.size(); ++t) {
            const auto& target = scene_.geometries[morph.targets[t]].positions;
            for (size_t i = 0; i < positions.size() && i < target.size(); ++i)
                positions[i] += morph.weights[t] * target[i];
        }
        return positions;
    }

    // COLLADA 1.4.1 chapter 4: v' = sum of w (joint world * inverse bind * bind shape) v, in world
    // space. False where joints are not in the scene: the mesh stays where its node is.
    bool skin(const collada::Skin& skin, const collada::MeshInstance& mesh,
              std::vector<dvec3>& positions) const {
        std::vector<dmat4> joints;
        for (size_t j = 0; j < skin.joints.size(); ++j) {
            auto node =
                j < mesh.joint_nodes.size() ? world_.find(mesh.joint_nodes[j]) : world_.end();
            if (node == world_.end() || j >= skin.inverse_bind.size()) return false;
            joints.push_back(node->second * skin.inverse_bind[j]);
        }
        for (size_t i = 0; i < positions.size() && i + 1 < skin.offsets.size(); ++i) {
            dvec4 bound = skin.bind_shape_matrix * dvec4(positions[i], 1);
            dvec4 sum(0);
            double weights = 0;
            for (uint32_t k = skin.offsets[i]; k < skin.offsets[i + 1]; ++k) {
                int32_t joint = skin.influence_joints[k];
                double weight = skin.influence_weights[k];
                sum += weight * (joint < 0 ? bound : joints[size_t(joint)] * bound);
                weights += weight;
            }
            positions[i] = std::abs(weights) > 0 ? dvec3(sum) / weights : dvec3(bound);
        }
        return true;
    }

    void extend(const dvec3& p) {
        if (!std::isfinite(p.x + p.y + p.z)) return;
        if (!any_) bounds_ = {p, p};
        any_ = true;
        for (int k = 0; k < 3; ++k) {
            bounds_.low[k] = std::min(bounds_.low[k], p[k]);
            bounds_.high[k] = std::max(bounds_.high[k], p[k]);
        }
    }

    const collada::SceneData& scene_;
    std::vector<PlacedNode> placed_;
    std::map<uint32_t, dmat4> world_;  // of a node's first occurrence
    RestBox bounds_;
    bool any_ = false;
};

}  // namespace

std::optional<RestBox> rest_bounds(const collada::SceneData& scene) {
    return RestBounds(scene).run();
}

}  // namespace kinora

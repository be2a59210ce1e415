// tests/collada/scene_promises.h: what scene.h and document.h promise whatever the file was.
#pragma once

#include <string>

#include "collada/scene/scene.h"

namespace kinora::collada {

// Each returns the first promise that is broken, as the expression that failed, or "".
#define PROMISE(condition) \
    if (!(condition)) return #condition

inline bool is_index(uint32_t index, size_t size) {
    return index == kNone || index < size;
}

inline std::string broken_instance(const SceneData& s, const MeshInstance& m) {
    PROMISE(m.geometry < s.geometries.size());
    PROMISE(is_index(m.skin, s.skins.size()) && is_index(m.morph, s.morphs.size()));
    for (const MaterialBinding& b : m.materials) PROMISE(is_index(b.material, s.materials.size()));
    if (m.skin == kNone) return {};
    const Skin& skin = s.skins[m.skin];
    PROMISE(m.joint_nodes.size() == skin.joints.size());
    for (uint32_t joint : m.joint_nodes) PROMISE(is_index(joint, s.nodes.size()));
    PROMISE(skin.inverse_bind.size() == skin.joints.size());
    PROMISE(skin.offsets.size() == s.geometries[m.geometry].positions.size() + 1);
    PROMISE(skin.offsets.back() == skin.influence_joints.size());
    for (int32_t j : skin.influence_joints) PROMISE(j < int32_t(skin.joints.size()));
    return {};
}

inline std::string broken_geometry(const Geometry& g) {
    for (const PrimitiveGroup& group : g.groups) {
        for (uint32_t i : group.indices[0]) PROMISE(i < g.positions.size());
        for (const VertexInput& input : group.inputs) {
            PROMISE(input.list < group.indices.size() && input.source < g.sources.size());
            const FloatSource& source = g.sources[input.source];
            for (uint32_t i : group.indices[input.list])
                PROMISE(i < source.values.size() / source.stride);
        }
    }
    return {};
}

inline std::string broken_promise(const SceneData& s) {
    std::string broken;
    for (const Node& n : s.nodes) {
        for (uint32_t c : n.children) PROMISE(c < s.nodes.size());
        for (const NodeInstance& i : n.instances) PROMISE(i.node < s.nodes.size());
        for (const MeshInstance& m : n.meshes)
            if (!(broken = broken_instance(s, m)).empty()) return broken;
    }
    for (const Geometry& g : s.geometries)
        if (!(broken = broken_geometry(g)).empty()) return broken;
    for (const Morph& m : s.morphs) {
        PROMISE(m.weights.size() == m.targets.size());
        PROMISE(m.base == kNone || &s.morphs[m.base] < &m);
        PROMISE(m.base == kNone || s.morphs[m.base].geometry == m.geometry);
        PROMISE(is_index(m.skin, s.skins.size()));
        for (uint32_t t : m.targets)
            PROMISE(t < s.geometries.size() &&
                    s.geometries[t].positions.size() == s.geometries[m.geometry].positions.size());
    }
    for (const Channel& c : s.channels) {
        PROMISE(c.sampler < s.samplers.size());
        PROMISE(s.samplers[c.sampler].stride == c.ref.count);
    }
    return {};
}

// Findings point into the texts they speak of.
inline std::string broken_place(const Diagnostics& diag) {
    for (const Finding& f : diag.findings()) {
        PROMISE(f.where.begin <= f.where.end);
        PROMISE(f.where.file == kNoFile || f.where.file < diag.files.count());
        PROMISE(f.where.file == kNoFile || f.where.end <= diag.files.text(f.where.file).size());
    }
    return {};
}

#undef PROMISE

}  // namespace kinora::collada

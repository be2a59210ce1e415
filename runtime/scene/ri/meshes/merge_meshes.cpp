// runtime/scene/ri/meshes/merge_meshes.cpp: materials by all but their colour, meshes by material.
#include "runtime/scene/ri/meshes/merge_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <optional>

namespace kinora {
namespace {

constexpr size_t kMostCorners = 3'000'000;  // of a mesh that others join

std::string key_of(const SceneDescription& description, const std::vector<ShaderUse>& uses) {
    std::string key;
    for (const ShaderUse& use : uses) {
        key += fmt::format("{} {} {};", static_cast<const void*>(use.shader.get()), use.space,
                           use.params.size());
        for (const LayerLink& link : use.links)
            key += fmt::format("{}<{}.{};", link.param, link.below, link.variable);
        for (const ParamSource& source : use.params) {
            if (source.name == "Cs") continue;
            key += fmt::format("{}={}:", source.name, source.strings.size());
            for (const std::string& text : source.strings)
                key += fmt::format("{} {},", text.size(), text);
            for (uint32_t i = 0; source.value.present() && i < source.value.count; ++i)
                key += fmt::format("{},", description.values[source.value.offset + i]);
        }
    }
    return key + '|';
}

// All of a material but Cs; "": it stays as it is.
std::string key_of(const SceneDescription& description, const MaterialDefinition& material) {
    if (!material.lights.empty() || !material.interior.empty() || !material.exterior.empty() ||
        material.surfaces.empty())
        return "";
    std::string key =
        fmt::format("{} {} {}|", material.name, material.hide_backfaces, material.atmosphere);
    for (const auto* uses :
         {&material.transformations, &material.displacements, &material.surfaces})
        key += key_of(description, *uses);
    return key;
}

// Materials that are one but for their colours.
struct Alike {
    std::vector<uint32_t>
        first;  // of each material: the one that stands for it; kNone: itself alone
};

Alike alike(const SceneDescription& description) {
    std::map<std::string, std::vector<uint32_t>> by_key;
    for (uint32_t m = 0; m < description.materials.size(); ++m)
        if (std::string key = key_of(description, description.materials[m]); !key.empty())
            by_key[std::move(key)].push_back(m);
    Alike made{std::vector<uint32_t>(description.materials.size(), kNone)};
    for (const auto& [key, materials] : by_key)
        for (uint32_t m : materials)
            if (materials.size() > 1) made.first[m] = materials.front();
    return made;
}

void add_color(const SceneDescription& description, uint32_t material, PrimitiveGroup& group) {
    const ParamSource* color = description.materials[material].surfaces.front().find("Cs");
    auto is_color = [](const VertexAttribute& a) { return a.semantic == "Cs"; };
    if (!color || color->value.count != 3 || std::ranges::any_of(group.attributes, is_color))
        return;
    VertexAttribute made;
    made.semantic = "Cs";
    made.stride = 3;
    for (uint32_t k = 0; k < 3; ++k)
        made.values.push_back(float(description.values[color->value.offset + k]));
    made.corners.assign(group.triangles.size(), 0);
    group.attributes.push_back(std::move(made));
}

bool same_attributes(const PrimitiveGroup& a, const PrimitiveGroup& b) {
    return std::ranges::equal(
        a.attributes, b.attributes, [](const VertexAttribute& x, const VertexAttribute& y) {
            return x.semantic == y.semantic && x.set == y.set && x.stride == y.stride;
        });
}

void append_indices(std::vector<uint32_t>& to, const std::vector<uint32_t>& from, size_t first) {
    for (uint32_t index : from) to.push_back(uint32_t(index + first));
}

struct Box {
    dvec3 low{1e300}, high{-1e300};

    void add(const dvec3& p) { low = glm::min(low, p), high = glm::max(high, p); }
    void add(const Box& other) { add(other.low), add(other.high); }
    double size() const { return glm::length(high - low); }
};

Box box_of(const MeshDefinition& mesh) {
    Box box;
    for (const dvec3& p : mesh.positions) box.add(p);
    return box;
}

// Vertices are floats about the middle of their mesh: small things beside huge ones would be lost.
bool fit_together(const Box& a, const Box& b) {
    constexpr double kMost = 1e5;  // of sizes
    Box both = a;
    both.add(b);
    return both.size() <= kMost * std::min(a.size(), b.size());
}

void append(MeshDefinition& to, MeshDefinition& from) {
    PrimitiveGroup &all = to.groups.front(), &group = from.groups.front();
    append_indices(all.triangles, group.triangles, to.positions.size());
    to.positions.insert(to.positions.end(), from.positions.begin(), from.positions.end());
    for (size_t a = 0; a < all.attributes.size(); ++a) {
        VertexAttribute &whole = all.attributes[a], &part = group.attributes[a];
        append_indices(whole.corners, part.corners, whole.values.size() / whole.stride);
        whole.values.insert(whole.values.end(), part.values.begin(), part.values.end());
    }
    from.positions = {};
    from.groups.clear();
}

class Merging {
  public:
    explicit Merging(SceneDescription& description)
        : description_(description),
          alike_(alike(description)),
          uses_(description.meshes.size(), 0) {
        for (const NodeDefinition& node : description.nodes)
            for (const MeshUse& use : node.meshes) ++uses_[use.mesh];
    }

    void merge(NodeDefinition& node) {
        std::vector<MeshUse> left;
        std::vector<Box> boxes;  // of them
        for (MeshUse& use : node.meshes) {
            if (joins(use)) share_material(use);
            const Box box = joins(use) ? box_of(mesh(use)) : Box();
            if (std::optional<size_t> open =
                    joins(use) ? find_open(left, boxes, use, box) : std::nullopt) {
                append(mesh(left[*open]), mesh(use));
                boxes[*open].add(box);
            } else {
                left.push_back(std::move(use));
                boxes.push_back(box);
            }
        }
        node.meshes = std::move(left);
    }

  private:
    MeshDefinition& mesh(const MeshUse& use) { return description_.meshes[use.mesh]; }

    bool joins(const MeshUse& use) {
        return uses_[use.mesh] == 1 && !mesh(use).lasts && mesh(use).groups.size() == 1 &&
               use.materials.size() == 1 &&
               description_.materials[use.materials[0].material].lights.empty();
    }
    void share_material(MeshUse& use) {
        uint32_t& material = use.materials[0].material;
        const uint32_t first = alike_.first[material];
        if (first == kNone) return;
        add_color(description_, material, mesh(use).groups.front());
        material = first;
    }
    // A mesh among the last few of the node.
    std::optional<size_t> find_open(const std::vector<MeshUse>& left, const std::vector<Box>& boxes,
                                    const MeshUse& use, const Box& box) {
        constexpr size_t kLooked = 8;
        for (size_t i = left.size(); i-- > 0 && left.size() - i <= kLooked;) {
            const MeshUse& open = left[i];
            if (!joins(open) || !fit_together(boxes[i], box) ||
                open.materials[0].material != use.materials[0].material ||
                open.lights != use.lights || open.visibility != use.visibility ||
                mesh(open).name != mesh(use).name)
                continue;
            const PrimitiveGroup& group = mesh(open).groups.front();
            if (group.triangles.size() < kMostCorners &&
                same_attributes(group, mesh(use).groups.front()))
                return i;
        }
        return std::nullopt;
    }

    SceneDescription& description_;
    const Alike alike_;
    std::vector<uint32_t> uses_;
};

}  // namespace

void merge_meshes(SceneDescription& description) {
    Merging merging(description);
    for (NodeDefinition& node : description.nodes) merging.merge(node);
}

}  // namespace kinora

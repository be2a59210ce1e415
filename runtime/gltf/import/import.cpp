// runtime/gltf/import/import.cpp: glTF's nodes and cameras as a SceneDescription.
#include "runtime/gltf/import/import.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/description/findings.h"
#include "runtime/gltf/import/import_p.h"

namespace kinora {

namespace {

constexpr size_t kRoom = 16;            // values that a transform has to itself
constexpr size_t kMaxNodeDepth = 1024;  // the builder recurses into children

bool all_finite(std::span<const double> numbers) {
    return std::all_of(numbers.begin(), numbers.end(), [](double v) { return std::isfinite(v); });
}

}  // namespace

std::optional<SceneDescription> import_gltf(const std::string& path, const ImportOptions& options,
                                            Diagnostics& diagnostics) {
    std::optional<GltfFile> file = read_gltf_file(path, options, diagnostics);
    if (!file) return std::nullopt;
    SceneDescription description;
    description.path = path;
    limit_files(description, file->directory, options);
    if (!GltfImport(*file, options, diagnostics, description).run()) return std::nullopt;
    description.inputs = std::move(file->files);
    return description;
}

bool GltfImport::run() {
    out_.meter = options_.meter.value_or(1.0);
    out_.up_axis = options_.up_axis.value_or(UpAxis::Y);
    std::vector<int> roots = root_nodes();
    claim_nodes(roots);
    find_axes(roots);
    find_animated();
    import_materials();
    import_lights();
    import_cameras();
    import_meshes();
    import_nodes();
    for (int root : roots)
        if (root >= 0) out_.roots.push_back(uint32_t(root));
    import_animations();
    import_scene_extras();
    if (findings_ > kMaxGltfFindings)
        diagnostics_.report(Code::GLTF_MORE, gltf_location(file_, ""),
                            findings_ - kMaxGltfFindings);
    return true;
}

// Whether so many more bytes may be taken. What a file can ask for is bounded by its size.
bool GltfImport::charge(size_t bytes, const std::string& pointer) {
    if (bytes <= allowed_bytes_ - charged_bytes_) {
        charged_bytes_ += bytes;
        return true;
    }
    if (!limit_told_)
        report(Code::GLTF_LIMIT, pointer,
               fmt::format("the scene's data would take more than {} MB, 20 times the file",
                           allowed_bytes_ >> 20));
    limit_told_ = true;
    return false;
}

bool GltfImport::exists(int index, size_t count, const char* what, const std::string& pointer) {
    if (index >= 0 && size_t(index) < count) return true;
    report(Code::GLTF_REFERENCE, pointer, what, index);
    return false;
}

// Values padded to `room`, so that one owner's channels touch no other's.
uint32_t GltfImport::append(std::span<const double> numbers, size_t room) {
    uint32_t offset = uint32_t(out_.values.size());
    out_.values.insert(out_.values.end(), numbers.begin(), numbers.end());
    out_.values.resize(offset + std::max(numbers.size(), room), 0.0);
    return offset;
}

// A name may stand for several things; an id is one thing's.
std::string GltfImport::unique_id(const std::string& name, const char* kind, size_t index) {
    std::string id = name.empty() ? fmt::format("{}_{}", kind, index) : name;
    std::string key = std::string(kind) + '\0' + id;
    if (ids_.try_emplace(key, 1).second) return id;
    id += fmt::format(".{}", index);
    ids_.try_emplace(std::string(kind) + '\0' + id, 1);
    return id;
}

// ---- the tree of nodes

std::vector<int> GltfImport::root_nodes() {
    if (!model_.scenes.empty()) {
        int scene = model_.defaultScene;
        if (scene >= 0 && !exists(scene, model_.scenes.size(), "scene", "/scene")) scene = 0;
        return model_.scenes[size_t(std::max(scene, 0))].nodes;
    }
    report(Code::GLTF_NO_SCENE, "");
    std::vector<bool> child(model_.nodes.size(), false);
    for (const tinygltf::Node& node : model_.nodes)
        for (int c : node.children)
            if (c >= 0 && size_t(c) < child.size()) child[size_t(c)] = true;
    std::vector<int> roots;
    for (size_t n = 0; n < child.size(); ++n)
        if (!child[n]) roots.push_back(int(n));
    return roots;
}

// Walks the scene's trees; a node met again (a second parent, a cycle) is not entered again, so
// what remains are trees.
void GltfImport::claim_nodes(const std::vector<int>& roots) {
    shown_.assign(model_.nodes.size(), false);
    children_.resize(model_.nodes.size());
    struct Step {
        int node, parent;
        size_t depth, place;  // place: among its parent's children, or the scene's nodes
    };
    std::vector<Step> stack;
    for (size_t r = roots.size(); r-- > 0;) stack.push_back({roots[r], -1, 1, r});
    while (!stack.empty()) {
        Step step = stack.back();
        stack.pop_back();
        std::string pointer =
            step.parent < 0
                ? fmt::format("/scenes/{}/nodes/{}", std::max(model_.defaultScene, 0), step.place)
                : fmt::format("/nodes/{}/children/{}", step.parent, step.place);
        if (!exists(step.node, model_.nodes.size(), "node", pointer)) continue;
        uint32_t node = uint32_t(step.node);
        if (shown_[node]) {
            report(Code::GLTF_NODE, pointer, step.node,
                   "it is met twice; here it is left out (each has one parent, no cycles)");
            continue;
        }
        if (step.depth > kMaxNodeDepth) {
            report(Code::GLTF_LIMIT, pointer,
                   fmt::format("nodes are nested more than {} deep", kMaxNodeDepth));
            continue;
        }
        shown_[node] = true;
        if (step.parent >= 0) children_[size_t(step.parent)].push_back(node);
        const std::vector<int>& children = model_.nodes[node].children;
        for (size_t c = children.size(); c-- > 0;)
            stack.push_back({children[c], step.node, step.depth + 1, c});
    }
}

void GltfImport::import_transforms(uint32_t index) {
    if (int(index) == axes_node_) return;
    const tinygltf::Node& from = model_.nodes[index];
    NodeDefinition& to = out_.nodes[index];
    NodeSlots& slots = slots_[index];
    std::string pointer = fmt::format("/nodes/{}", index);
    auto usable = [&](const std::vector<double>& numbers, size_t count, const char* name) {
        if (numbers.empty()) return false;
        if (numbers.size() == count && all_finite(numbers)) return true;
        report(Code::GLTF_VALUE, pointer + "/" + name,
               fmt::format("'{}' is not {} finite numbers; it is left out", name, count));
        return false;
    };
    bool has_matrix = usable(from.matrix, 16, "matrix");
    if (has_matrix && (moves_[index] & (kMovesTranslation | kMovesRotation | kMovesScale)) != 0) {
        report(Code::GLTF_NODE, pointer + "/matrix", index,
               "it is animated; only translation, rotation and scale can be, its matrix is left "
               "out");
        has_matrix = false;
    }
    if (has_matrix) {
        double rows[16];  // columns there, rows in our documents' order
        for (size_t k = 0; k < 16; ++k) rows[k % 4 * 4 + k / 4] = from.matrix[k];
        to.transforms.push_back({TransformKind::Matrix, append(rows, kRoom)});
        return;
    }
    auto add = [&](TransformKind kind, const std::vector<double>& numbers, const char* name,
                   std::span<const double> rest, bool moves, uint32_t& slot) {
        bool given = usable(numbers, rest.size(), name);
        if (!given && !moves) return;
        slot = append(given ? std::span<const double>(numbers) : rest, kRoom);
        to.transforms.push_back({kind, slot});
    };
    constexpr double kNoTranslation[] = {0, 0, 0}, kNoRotation[] = {0, 0, 0, 1},
                     kNoScale[] = {1, 1, 1};
    add(TransformKind::Translate, from.translation, "translation", kNoTranslation,
        moves_[index] & kMovesTranslation, slots.translation);
    add(TransformKind::Quaternion, from.rotation, "rotation", kNoRotation,
        moves_[index] & kMovesRotation, slots.rotation);
    add(TransformKind::Scale, from.scale, "scale", kNoScale, moves_[index] & kMovesScale,
        slots.scale);
}

void GltfImport::import_nodes() {
    out_.nodes.resize(model_.nodes.size());
    slots_.resize(model_.nodes.size());
    node_morphs_.assign(model_.nodes.size(), kNone);
    for (uint32_t n = 0; n < model_.nodes.size(); ++n) {
        if (!shown_[n]) continue;
        const tinygltf::Node& from = model_.nodes[n];
        NodeDefinition& to = out_.nodes[n];
        std::string pointer = fmt::format("/nodes/{}", n);
        to.name = from.name;
        to.id = unique_id(from.name, "node", n);
        import_transforms(n);
        import_attributes(from.extras, to);
        for (uint32_t child : children_[n]) to.children.push_back({child, dmat4(1.0)});
        if (from.camera >= 0 &&
            exists(from.camera, model_.cameras.size(), "camera", pointer + "/camera"))
            to.cameras.push_back(uint32_t(from.camera));
        if (auto light = from.extensions.find("KHR_lights_punctual");
            light != from.extensions.end() && light->second.Has("light")) {
            int index = light->second.Get("light").GetNumberAsInt();
            if (exists(index, model_.lights.size(), "light",
                       pointer + "/extensions/KHR_lights_punctual/light"))
                to.lights.push_back(uint32_t(index));
        }
        if (from.mesh >= 0 && exists(from.mesh, model_.meshes.size(), "mesh", pointer + "/mesh"))
            to.meshes.push_back(mesh_use(n));
    }
}

// ---- cameras

void GltfImport::import_cameras() {
    for (size_t c = 0; c < model_.cameras.size(); ++c) {
        const tinygltf::Camera& from = model_.cameras[c];
        CameraDefinition& to = out_.cameras.emplace_back();
        to.name = from.name;
        to.id = unique_id(from.name, "camera", c);
        to.where = gltf_location(file_, fmt::format("/cameras/{}", c));
        to.orthographic = from.type == "orthographic";
        auto slot = [&](double value) {
            return value != 0 ? ValueSlot{append(std::span(&value, 1), 1), 1} : ValueSlot{};
        };
        double metres = 1 / axes_meter_;  // lengths are the file's
        if (to.orthographic) {            // xmag and ymag are half the sides here and in COLLADA
            to.x = slot(from.orthographic.xmag * metres);
            to.y = slot(from.orthographic.ymag * metres);
            to.znear = slot(from.orthographic.znear * metres);
            to.zfar = slot(from.orthographic.zfar * metres);
        } else {
            to.y = slot(from.perspective.yfov * 180.0 / kPi);
            to.aspect = slot(from.perspective.aspectRatio);
            to.znear = slot(from.perspective.znear * metres);
            to.zfar = slot(from.perspective.zfar * metres);  // none: beyond everything
        }
        to.picture = picture_shaders(from.extras, fmt::format("/cameras/{}", c));
    }
}

}  // namespace kinora

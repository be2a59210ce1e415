// runtime/gltf/export/nodes.cpp: the unrolled tree of nodes, and what hangs on them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "anim/decompose.h"
#include "runtime/base/skin_space.h"
#include "runtime/description/findings.h"
#include "runtime/gltf/export/export_p.h"
#include "runtime/scene/transforms.h"

namespace kinora {

namespace {

constexpr double kOrthogonal = 1e-6;  // cosine between columns that counts as none

bool is_identity(const dmat4& m, double tolerance = 0) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            if (!(std::abs(m[c][r] - (c == r ? 1.0 : 0.0)) <= tolerance)) return false;
    return true;
}

std::array<double, 4> quaternion(const dmat3& rotation) {
    anim::Quaternion q = anim::normalized(anim::quaternion_from_rotation(rotation));
    return {q.x, q.y, q.z, q.w};
}

// Axes along those of `m` that are not zero, right-handed and at right angles.
dmat3 completed_axes(const dmat3& m, const dvec3& lengths) {
    dmat3 axes(1.0);
    int known = -1;
    for (int i = 0; i < 3; ++i)
        if (lengths[i] > 0) axes[i] = m[i] / lengths[i], known = i;
    if (known < 0) return dmat3(1.0);
    for (int i = 0; i < 3; ++i) {
        if (lengths[i] > 0) continue;
        int a = (i + 1) % 3, b = (i + 2) % 3;
        if (lengths[a] > 0 && lengths[b] > 0) {
            axes[i] = glm::cross(axes[a], axes[b]);
            continue;
        }
        // One axis alone is known: any two across it do.
        dvec3 u = axes[known];
        dvec3 other = std::abs(u.x) < 0.9 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
        axes[(known + 1) % 3] = glm::normalize(glm::cross(u, other));
        axes[(known + 2) % 3] = glm::cross(u, axes[(known + 1) % 3]);
        break;
    }
    return axes;
}

// Eigenvectors of a symmetric matrix as the columns of a rotation: Jacobi's method.
dmat3 eigenvectors(dmat3 s) {
    dmat3 v(1.0);
    for (int sweep = 0; sweep < 30; ++sweep)
        for (int p = 0; p < 2; ++p)
            for (int q = p + 1; q < 3; ++q) {
                if (std::abs(s[q][p]) < 1e-300) continue;
                double theta = 0.5 * std::atan2(2 * s[q][p], s[q][q] - s[p][p]);
                dmat3 turn(1.0);
                turn[p][p] = turn[q][q] = std::cos(theta);
                turn[q][p] = std::sin(theta);
                turn[p][q] = -std::sin(theta);
                s = glm::transpose(turn) * s * turn;
                v = v * turn;
            }
    return v;
}

Json numbers(const dvec3& v) {
    return {v.x, v.y, v.z};
}

void write_trs(const Trs& trs, Json& node) {
    if (trs.translation != dvec3(0.0)) node["translation"] = numbers(trs.translation);
    if (trs.rotation != std::array<double, 4>{0, 0, 0, 1}) node["rotation"] = trs.rotation;
    if (trs.scale != dvec3(1.0)) node["scale"] = numbers(trs.scale);
}

// COLLADA 1.4.1, chapter 5, up_axis: x is right for y and z up, -y for x up.
dmat4 y_up_from(UpAxis up) {
    dmat4 m(1.0);
    if (up == UpAxis::X) {
        m[0] = dvec4(0, 1, 0, 0);
        m[1] = dvec4(-1, 0, 0, 0);
    } else if (up == UpAxis::Z) {
        m[1] = dvec4(0, 0, -1, 0);
        m[2] = dvec4(0, 1, 0, 0);
    }
    return m;
}

}  // namespace

bool decompose_trs(const dmat4& m, Trs& trs) {
    trs.translation = dvec3(m[3]);
    dmat3 linear(m);
    dvec3 lengths(glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2]));
    if (glm::determinant(linear) < 0) {
        linear[0] = -linear[0];
        trs.scale = dvec3(-lengths.x, lengths.y, lengths.z);
    } else {
        trs.scale = lengths;
    }
    for (int i = 0; i < 3; ++i)
        if (std::abs(std::abs(trs.scale[i]) - 1) < 1e-12)
            trs.scale[i] = std::copysign(1.0, trs.scale[i]);
    dmat3 axes = completed_axes(linear, lengths);
    trs.rotation = quaternion(axes);
    auto across = [&](int a, int b) { return std::abs(glm::dot(axes[a], axes[b])) < kOrthogonal; };
    return across(0, 1) && across(0, 2) && across(1, 2);
}

// M = R S (polar) and S = V diag V^T, so M = (R V) diag * V^T: two nodes.
void split_shear(const dmat4& m, Trs& outer, Trs& inner) {
    anim::Matrix16 rows;
    for (size_t r = 0; r < 4; ++r)
        for (size_t c = 0; c < 4; ++c) rows[r * 4 + c] = m[int(c)][int(r)];
    anim::RigidStretch polar = anim::decompose(rows);
    dmat3 v = eigenvectors(polar.stretch);
    dmat3 diagonal = glm::transpose(v) * polar.stretch * v;
    outer.translation = polar.translation;
    outer.rotation = quaternion(anim::rotation_from_quaternion(polar.rotation) * v);
    outer.scale = {diagonal[0][0], diagonal[1][1], diagonal[2][2]};
    inner.rotation = quaternion(glm::transpose(v));
}

uint32_t GltfExport::add_node(Json node, uint32_t parent) {
    uint32_t index = uint32_t(json_["nodes"].size());
    json_["nodes"].push_back(std::move(node));
    if (parent == kNone)
        json_["scenes"][0]["nodes"].push_back(index);
    else
        json_["nodes"][parent]["children"].push_back(index);
    return index;
}

uint32_t GltfExport::static_nodes(const dmat4& matrix, uint32_t parent) {
    Json node = Json::object();
    Trs trs, inner;
    if (decompose_trs(matrix, trs)) {
        write_trs(trs, node);
        return add_node(std::move(node), parent);
    }
    trs = Trs();
    split_shear(matrix, trs, inner);
    write_trs(trs, node);
    uint32_t outer = add_node(std::move(node), parent);
    Json rest = Json::object();
    write_trs(inner, rest);
    return add_node(std::move(rest), outer);
}

// One node where the stack is translation, rotation and scale at all times; else one a transform,
// those that stand still together.
uint32_t GltfExport::stack_nodes(const NodeDefinition& definition, const dmat4& conversion,
                                 uint32_t parent) {
    std::span<const Transform> all = definition.transforms;
    if (!is_moved(all))
        return static_nodes(conversion * node_matrix(definition, description_.values), parent);
    auto matrix_of = [this](const dmat4& before, std::span<const Transform> stack) {
        dmat4 m = before;
        for (const Transform& t : stack) m = m * transform_matrix(t.kind, &at_time_[t.value]);
        return m;
    };
    // Whether a matrix is translation, rotation and scale at rest, at all keys and between them.
    auto holds = [&](const dmat4& before, std::span<const Transform> stack) {
        Trs trs;
        bool all_hold = decompose_trs(matrix_of(before, stack), trs);
        for (Take& take : takes_) {
            take_ = &take;
            std::vector<Channel> moving = channels_of(stack);
            std::vector<double> times = key_times(stack, moving);
            auto look = [&](double time) {
                evaluate(moving, time);
                all_hold = all_hold && decompose_trs(matrix_of(before, stack), trs);
            };
            for (size_t k = 0; k < times.size(); ++k) {
                look(times[k]);
                for (double s : kProbes)
                    if (k + 1 < times.size()) look(times[k] + s * (times[k + 1] - times[k]));
            }
            to_rest(moving);
        }
        return all_hold;
    };
    auto move = [&](uint32_t node, std::span<const Transform> stack, const dmat4& before) {
        for (Take& take : takes_) {
            take_ = &take;
            std::vector<Channel> moving = channels_of(stack);
            if (!moving.empty()) move_node(node, stack, before, moving);
        }
    };
    if (holds(conversion, all)) {
        uint32_t node = static_nodes(matrix_of(conversion, all), parent);
        move(node, all, conversion);
        return node;
    }
    dmat4 still = conversion;
    uint32_t node = parent;
    for (const Transform& transform : all) {
        std::span<const Transform> own(&transform, 1);
        dmat4 matrix = matrix_of(dmat4(1.0), own);
        if (!is_moved(own)) {
            still = still * matrix;
            continue;
        }
        if (!is_identity(still, 1e-15)) node = static_nodes(still, node);
        still = dmat4(1.0);
        if (!holds(dmat4(1.0), own))
            lost(fmt::format("node '{}'", definition.id), "animated shear");
        Trs trs;
        decompose_trs(matrix, trs);
        Json part = Json::object();
        write_trs(trs, part);
        node = add_node(std::move(part), node);
        move(node, own, dmat4(1.0));
    }
    return is_identity(still, 1e-15) ? node : static_nodes(still, node);
}

void GltfExport::unroll(uint32_t index, uint32_t parent, const dmat4& conversion) {
    const NodeDefinition& definition = description_.nodes[index];
    uint32_t above = parent == kNone ? root_ : placed_[parent].node;
    uint32_t node = stack_nodes(definition, conversion, above);
    std::string name = !definition.name.empty() ? definition.name : definition.id;
    if (!name.empty()) json_["nodes"][node]["name"] = name;
    Json attributes = Json::object();
    for (const UserAttribute& a : definition.attributes) {
        if (a.numbers.empty())
            attributes[a.name] = a.text;
        else
            attributes[a.name] = a.numbers;
    }
    if (!attributes.empty()) json_["nodes"][node]["extras"]["kinora_attributes"] = attributes;
    uint32_t place = uint32_t(placed_.size());
    dmat4 world = conversion * node_matrix(definition, description_.values);
    dmat4 start = conversion * node_matrix(definition, start_values_);
    if (parent != kNone) world = placed_[parent].world * world;
    if (parent != kNone) start = placed_[parent].start * start;
    placed_.push_back({index, parent, node, world, start, conversion});
    for (const ChildUse& child : definition.children) unroll(child.node, place, child.conversion);
}

uint32_t GltfExport::nearest_occurrence(uint32_t definition, uint32_t from) const {
    uint32_t best = kNone, best_shared = 0;
    for (uint32_t p = 0; p < placed_.size(); ++p) {
        if (placed_[p].definition != definition) continue;
        uint32_t shared = 0;
        for (uint32_t x = p; x != kNone && !shared; x = placed_[x].parent)
            for (uint32_t y = from; y != kNone && !shared; y = placed_[y].parent)
                if (x == y) shared = x + 1;
        if (best == kNone || shared > best_shared) best = p, best_shared = shared;
    }
    return best;
}

// A placed node and those above it once more below the glTF node `above`, which stands for `top`
// (kNone: for what is above all), without their content.
uint32_t GltfExport::stand_again(uint32_t place, uint32_t above, uint32_t top,
                                 std::map<uint32_t, uint32_t>& again) {
    auto found = again.find(place);
    if (found != again.end()) return found->second;
    if (place == top) return again[place] = above;
    const Placed& p = placed_[place];
    uint32_t parent = p.parent == kNone ? above : stand_again(p.parent, above, top, again);
    return again[place] = stack_nodes(description_.nodes[p.definition], p.conversion, parent);
}

// COLLADA 1.4.1, skinning: a skin is in world space, joint * inverse bind * bind shape.
uint32_t GltfExport::skin(const MeshUse& use, uint32_t placed) {
    const SkinDefinition& definition = description_.skins[use.skin];
    dmat4 bind_shape = definition.bind_shape;
    uint32_t above = root_;
    std::map<uint32_t, uint32_t> again;
    SkinPose rest, start;
    rest.node = placed_[placed].world * use.conversion;
    start.node = placed_[placed].start * use.conversion;
    std::vector<uint32_t> places;
    for (size_t j = 0; j < use.joint_nodes.size() && j < definition.inverse_bind.size(); ++j) {
        uint32_t joint = use.joint_nodes[j];
        uint32_t place = joint == kNone ? kNone : nearest_occurrence(joint, placed);
        if (place == kNone) continue;
        rest.joints.push_back({placed_[place].world, definition.inverse_bind[j]});
        start.joints.push_back({placed_[place].start, definition.inverse_bind[j]});
        places.push_back(place);
    }
    uint32_t shared =
        shared_ancestor(placed, places, kNone, [&](uint32_t n) { return placed_[n].parent; });
    if (shared != kNone) rest.shared = placed_[shared].world;
    if (shared != kNone) start.shared = placed_[shared].start;
    SkinPlace stands;
    if (!definition.in_world) stands = skin_place(bind_shape, rest, start);
    SkinSpace space = stands.space;
    if (space == SkinSpace::BindsNode) bind_shape = stands.bind;
    if (space == SkinSpace::Node || space == SkinSpace::NodeBelow) {  // the joints stand below it
        uint32_t top = space == SkinSpace::Node ? kNone : shared;
        above = static_nodes(use.conversion, placed_[placed].node);
        json_["nodes"][above]["name"] = definition.id + " space";
        for (uint32_t joint : use.joint_nodes) {
            uint32_t place = joint == kNone ? kNone : nearest_occurrence(joint, placed);
            if (place != kNone) stand_again(place, above, top, again);
        }
    }
    std::vector<float> inverse_bind;
    Json joints = Json::array();
    uint32_t still = kNone;  // a node that never moves, for what follows no joint
    auto add = [&](uint32_t node, const dmat4& matrix) {
        joints.push_back(node);
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 4; ++r)
                inverse_bind.push_back(c < 3 && r == 3    ? 0.0f
                                       : c == 3 && r == 3 ? 1.0f
                                                          : float(matrix[c][r]));
    };
    auto still_node = [&] {
        if (still == kNone)
            still = add_node(Json::object({{"name", definition.id + " bind shape"}}), above);
        return still;
    };
    for (size_t j = 0; j < definition.inverse_bind.size(); ++j) {
        uint32_t joint = j < use.joint_nodes.size() ? use.joint_nodes[j] : kNone;
        uint32_t place = joint == kNone ? kNone : nearest_occurrence(joint, placed);
        if (place == kNone)
            add(still_node(), bind_shape);
        else
            add(again.empty() ? placed_[place].node : again.at(place),
                definition.inverse_bind[j] * bind_shape);
    }
    bool follows_none = std::any_of(definition.joints.begin(), definition.joints.end(),
                                    [](int32_t j) { return j < 0; });
    if (follows_none || joints.empty()) add(still_node(), bind_shape);
    Json result = {{"joints", joints},
                   {"inverseBindMatrices", accessor(inverse_bind, 16, 0, false)}};
    if (!definition.id.empty()) result["name"] = definition.id;
    json_["skins"].push_back(result);
    return uint32_t(json_["skins"].size() - 1);
}

void GltfExport::hang_content(uint32_t place) {
    const NodeDefinition& definition = description_.nodes[placed_[place].definition];
    uint32_t node = placed_[place].node;
    // The first of a kind sits on the node itself, more on children.
    auto seat = [&](const char* key) {
        return json_["nodes"][node].contains(key) ? add_node(Json::object(), node) : node;
    };
    for (const MeshUse& use : definition.meshes) {
        uint32_t index = mesh(use);
        if (index == kNone) continue;
        uint32_t at = node;
        if (use.skin != kNone)
            at = add_node(Json::object({{"name", description_.meshes[use.mesh].id}}), kNone);
        else if (!is_identity(use.conversion))
            at = static_nodes(use.conversion, node);
        else
            at = seat("mesh");
        json_["nodes"][at]["mesh"] = index;
        if (use.skin != kNone) {
            json_["nodes"][at]["skin"] = skin(use, place);
        }
        if (use.morph != kNone) {
            const MorphDefinition& m = description_.morphs[use.morph];
            std::span<const double> w = values(m.weights);
            json_["nodes"][at]["weights"] = std::vector<double>(w.begin(), w.end());
            move_weights(at, m);
        }
    }
    for (uint32_t c : definition.cameras) {
        auto [found, fresh] = cameras_.try_emplace(c, uint32_t(cameras_.size()));
        if (fresh) json_["cameras"].push_back(camera(description_.cameras[c]));
        json_["nodes"][seat("camera")]["camera"] = found->second;
    }
    for (uint32_t l : definition.lights) {
        auto [found, fresh] = lights_.try_emplace(l, 0);
        if (fresh) found->second = light(description_.lights[l], placed_[place].world);
        json_["nodes"][seat("extensions")]["extensions"]["KHR_lights_punctual"]["light"] =
            found->second;
    }
}

// The joints of a skin have a common root (glTF 2.0, 3.7.3.1), which a scene's roots are not: where
// they need one, all that is no skinned mesh hangs below a node that does nothing.
void GltfExport::give_skins_a_root() {
    if (!json_.contains("skins")) return;
    Json& nodes = json_["nodes"];
    std::vector<uint32_t> top(nodes.size());  // the scene's root above each; parents come first
    for (uint32_t n = 0; n < nodes.size(); ++n) top[n] = n;
    for (uint32_t n = 0; n < nodes.size(); ++n)
        if (nodes[n].contains("children"))
            for (uint32_t child : nodes[n]["children"]) top[child] = top[n];
    bool apart = false;
    for (const Json& skin : json_["skins"])
        for (uint32_t joint : skin["joints"])
            apart |= top[joint] != top[skin["joints"][0].get<uint32_t>()];
    if (!apart) return;
    Json below = Json::array(), roots = Json::array();
    roots.push_back(nodes.size());
    for (const Json& root : json_["scenes"][0]["nodes"])
        (nodes[root.get<uint32_t>()].contains("skin") ? roots : below).push_back(root);
    nodes.push_back({{"name", "root of the joints"}, {"children", below}});
    json_["scenes"][0]["nodes"] = roots;
}

// At rest, in glTF's space: for what needs a length, near planes and lights without falloff.
void GltfExport::set_bounds(const dmat4& axes) {
    dvec3 low(1e300), high(-1e300);
    for (const Placed& p : placed_)
        for (const MeshUse& use : description_.nodes[p.definition].meshes)
            for (const dvec3& x : description_.meshes[use.mesh].positions) {
                dvec3 y(axes * p.world * use.conversion * dvec4(x, 1.0));
                low = glm::min(low, y), high = glm::max(high, y);
            }
    if (!(low.x <= high.x)) return;
    bounds_radius_ = std::max(0.5 * glm::length(high - low), 1e-12);
    bounds_centre_ = 0.5 * (low + high);
}

std::string GltfExport::glb() {
    json_["asset"] = {{"version", "2.0"}, {"generator", "kinora-convert"}};
    json_["scene"] = 0;
    json_["scenes"] = Json::array({Json::object()});
    at_time_ = description_.values;
    find_takes();
    dmat4& axes = axes_ = y_up_from(description_.up_axis);
    for (int c = 0; c < 3; ++c) axes[c] = axes[c] * description_.meter;
    if (!is_identity(axes)) {
        root_ = static_nodes(axes, kNone);
        static constexpr const char* kAxes[] = {"X", "Y", "Z"};
        json_["nodes"][root_]["name"] = "axes and unit";
        json_["nodes"][root_]["extras"]["kinora_axes"] = {
            {"up", kAxes[size_t(description_.up_axis)]}, {"meter", description_.meter}};
    }
    start_values_ = description_.values;
    const anim::Animation& animation = description_.animation;
    std::vector<uint64_t> changed(anim::changed_words(animation.owner_count));
    anim::evaluate(animation, anim::time_range(animation).begin, start_values_, changed);
    for (uint32_t root : description_.roots) unroll(root, kNone, dmat4(1.0));
    set_bounds(axes);
    for (uint32_t p = 0; p < placed_.size(); ++p) hang_content(p);
    give_skins_a_root();
    return finish();
}

}  // namespace kinora

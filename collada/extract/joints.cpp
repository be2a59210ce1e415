// collada/extract/joints.cpp: joint names lead to nodes: by sid, then id, then name; below the
// skeleton roots, then in the whole scene. Skeletons outside of it are posed with it.
#include <algorithm>
#include <map>

#include "collada/extract/extract_p.h"

namespace kinora::collada {

namespace {

enum Key : uint8_t { Sid, Id, Name, KeyCount };
constexpr const char* kKeyNames[] = {"sid", "id", "name"};

const std::string& key_of(const Node& node, Key key) {
    return key == Sid ? node.sid : key == Id ? node.id : node.name;
}

// The nodes below some roots by each of their names; joints win over other nodes, then the first.
struct JointIndex {
    std::unordered_map<std::string_view, uint32_t> by[KeyCount];
    size_t count = 0;  // of nodes

    void build(const std::vector<Node>& nodes, const std::vector<uint32_t>& roots);
    uint32_t find(std::string_view name, Key key) const {
        auto found = by[key].find(name);
        return found == by[key].end() ? kNone : found->second;
    }
};

void JointIndex::build(const std::vector<Node>& nodes, const std::vector<uint32_t>& roots) {
    std::vector<bool> seen(nodes.size());
    std::vector<uint32_t> todo(roots.rbegin(), roots.rend());
    while (!todo.empty()) {
        uint32_t at = todo.back();
        todo.pop_back();
        if (seen[at]) continue;
        seen[at] = true;
        ++count;
        const Node& node = nodes[at];
        for (Key key : {Sid, Id, Name}) {
            const std::string& name = key_of(node, key);
            if (name.empty()) continue;
            auto [found, fresh] = by[key].emplace(name, at);
            if (!fresh && node.joint && !nodes[found->second].joint) found->second = at;
        }
        for (auto c = node.children.rbegin(); c != node.children.rend(); ++c) todo.push_back(*c);
        for (auto i = node.instances.rbegin(); i != node.instances.rend(); ++i)
            todo.push_back(i->node);
    }
}

class JointResolver {
  public:
    explicit JointResolver(Extraction& x) : x_(x) {
        std::vector<uint32_t> all;
        for (uint32_t n = 0; x.options.everything && n < x.scene.nodes.size(); ++n)
            all.push_back(n);
        scene_.build(x.scene.nodes, x.scene.roots);
        rest_.build(x.scene.nodes, all);
    }
    void resolve_instance(const PendingSkin& pending);

  private:
    struct Found {
        uint32_t node = kNone;
        Key key = Sid;
        bool outside = false;
    };
    Found find(const std::string& name, JointNames kind, const JointIndex* skeleton,
               bool reached) const;
    const JointIndex* index_below(const std::vector<uint32_t>& roots, Location where);

    Extraction& x_;
    JointIndex scene_;
    JointIndex rest_;  // everything, for skins in nodes that <scene> does not reach
    std::map<std::vector<uint32_t>, JointIndex> skeletons_;
};

// Null when there are too many large skeletons to look below each of them.
const JointIndex* JointResolver::index_below(const std::vector<uint32_t>& roots, Location where) {
    constexpr uint64_t kBytesPerNode = 192;  // of the three maps
    auto [at, fresh] = skeletons_.try_emplace(roots);
    if (!fresh) return &at->second;
    if (x_.budget.is_spent()) return nullptr;
    at->second.build(x_.scene.nodes, roots);
    if (x_.budget.reserve(at->second.count * kBytesPerNode, where)) return &at->second;
    at->second = {};
    return nullptr;
}

// IDREF names are ids; a SIDREF path ends in a sid.
JointResolver::Found JointResolver::find(const std::string& name, JointNames kind,
                                         const JointIndex* skeleton, bool reached) const {
    std::string_view last = name;
    if (kind == JointNames::Sidref) last.remove_prefix(last.find_last_of('/') + 1);
    if (last.starts_with('#')) last.remove_prefix(1);
    constexpr Key kByName[] = {Sid, Id, Name}, kById[] = {Id, Sid, Name};
    for (const JointIndex* index : {skeleton, &scene_, &rest_}) {
        if (!index || (index == &rest_ && reached)) continue;
        for (Key key : kind == JointNames::Idref ? kById : kByName) {
            uint32_t node = index->find(last, key);
            if (node != kNone) return {node, key, index != skeleton};
        }
    }
    return {};
}

void JointResolver::resolve_instance(const PendingSkin& pending) {
    MeshInstance& mesh = x_.scene.nodes[pending.node].meshes[pending.mesh];
    const Skin& skin = x_.scene.skins[mesh.skin];
    Location where = x_.where(pending.instance);
    const JointIndex* skeleton = nullptr;
    if (mesh.skeleton_roots.empty())
        x_.diag.report(Code::SKIN_NO_SKELETON, where);
    else
        skeleton = index_below(mesh.skeleton_roots, where);
    uint64_t bytes = skin.joints.size() * sizeof(uint32_t);
    if (!x_.budget.reserve(bytes, where)) {
        mesh.skin = kNone;
        return;
    }
    bool reached = pending.node < x_.reached_nodes;
    size_t by_key[KeyCount] = {}, outside = 0, lost = 0;
    for (const std::string& name : skin.joints) {
        Found found = find(name, skin.joint_kind, skeleton, reached);
        mesh.joint_nodes.push_back(found.node);
        if (found.node == kNone) {
            if (++lost <= 8) x_.diag.report(Code::SKIN_JOINT_UNRESOLVED, where, name);
            continue;
        }
        ++by_key[found.key];
        outside += found.outside && skeleton;
    }
    Key proper = skin.joint_kind == JointNames::Idref ? Id : Sid;
    for (Key key : {Sid, Id, Name})
        if (key != proper && by_key[key] && proper == Sid)
            x_.diag.report(Code::SKIN_JOINT_FALLBACK, where, by_key[key], kKeyNames[key]);
    if (outside) x_.diag.report(Code::SKIN_OUTSIDE_SKELETON, where, outside);
}

}  // namespace

namespace {

// Nodes below the roots.
std::vector<bool> reached_nodes(const SceneData& scene) {
    std::vector<bool> reached(scene.nodes.size());
    std::vector<uint32_t> todo = scene.roots;
    while (!todo.empty()) {
        uint32_t at = todo.back();
        todo.pop_back();
        if (reached[at]) continue;
        reached[at] = true;
        for (uint32_t child : scene.nodes[at].children) todo.push_back(child);
        for (const NodeInstance& instance : scene.nodes[at].instances)
            todo.push_back(instance.node);
    }
    return reached;
}

// Joints that stand in no part of the shown scene pose skins there as roots that show nothing.
void place_skeletons(Extraction& x) {
    SceneData& scene = x.scene;
    std::vector<bool> reached = reached_nodes(scene);
    size_t shown = scene.roots.size();
    for (const PendingSkin& pending : x.pending_skins) {
        const MeshInstance& mesh = scene.nodes[pending.node].meshes[pending.mesh];
        if (mesh.skin == kNone || !reached[pending.node]) continue;
        for (uint32_t joint : mesh.joint_nodes) {
            if (joint == kNone || reached[joint]) continue;
            uint32_t top = joint;
            while (scene.nodes[top].parent != kNone) top = scene.nodes[top].parent;
            if (std::find(scene.roots.begin() + ptrdiff_t(shown), scene.roots.end(), top) !=
                scene.roots.end())
                continue;
            const Node& root = scene.nodes[top];
            x.diag.report(Code::SKIN_UNPLACED_SKELETON, x.where(pending.instance),
                          root.id.empty() ? root.name : root.id);
            scene.roots.push_back(top);
        }
    }
    if (scene.roots.size() == shown) return;
    std::vector<bool> posing = reached_nodes(scene);
    for (uint32_t n = 0; n < scene.nodes.size(); ++n) {
        if (!posing[n] || reached[n]) continue;
        Node& node = scene.nodes[n];
        node.meshes.clear();
        node.lights.clear();
        node.cameras.clear();
        std::erase_if(node.instances, [&](const NodeInstance& i) { return reached[i.node]; });
    }
    std::erase_if(x.pending_bindings, [&](const PendingBinding& bind) {
        return posing[bind.node] && !reached[bind.node];
    });
    check_node_graph(x);
}

}  // namespace

void resolve_joints(Extraction& x) {
    if (x.pending_skins.empty()) return;
    {
        JointResolver resolver(x);
        for (const PendingSkin& pending : x.pending_skins) resolver.resolve_instance(pending);
    }
    place_skeletons(x);
}

}  // namespace kinora::collada

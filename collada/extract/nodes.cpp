// collada/extract/nodes.cpp: the node tree, its definitions, the instances between them, what is
// hidden.
#include <algorithm>

#include "collada/extract/extract_p.h"
#include "collada/text/numbers_p.h"

namespace kinora::collada {

uint32_t node_index(Extraction& x, Link link) {
    auto [at, fresh] = x.made.emplace(link.element, kNone);
    if (!fresh || !x.budget.reserve(sizeof(Node) + kBookBytes, x.where(link))) return at->second;
    at->second = append(x.scene.nodes, Node{});
    x.nodes.add(at->second, link);
    return at->second;
}

namespace {

// Maya's and Max's exporters write into an extra what was hidden there.
void note_visibility(Extraction& x, Link node, uint32_t number) {
    for (const Element& extra : node.element->children()) {
        if (extra.name != "extra") continue;
        for (const Element& technique : extra.children()) {
            const Element* flag = technique.child("visibility");
            double value = 1;
            if (flag && parse_double(flag->text, value) && value == 0)
                x.hidden_nodes.push_back({number, {node.doc, flag}});
        }
    }
}

void read_node(Extraction& x, uint32_t number, Link link, uint32_t parent) {
    x.nodes.set_filled(number);
    const Element& e = *link.element;
    Node node;
    node.id = e.value("id");
    node.sid = e.value("sid");
    node.name = e.value("name");
    node.joint = e.value("type") == "JOINT";
    node.parent = parent;
    node.document = link.doc;
    node.where = x.where(link);
    bool inner = e.parent && e.parent->name == "node";
    node.conversion = x.frames.conversion(
        inner ? x.frames.of({link.doc, e.parent}) : x.frames.of_world(), x.frames.of(link));
    if (const Element* technique = extra_technique(e, "RSL"))
        for (const Element& item : technique->children())
            if (item.name == "attribute")
                node.attributes.emplace_back(item.value("name"), trim(item.text));
    note_visibility(x, link, number);
    size_t transforms = 0;
    for (const Element& child : e.children()) transforms += is_transform(child.name);
    if (x.budget.reserve(transforms * (sizeof(Transform) + kBookBytes), node.where))
        node.transforms.reserve(transforms);
    for (const Element& child : e.children()) {
        Link part{link.doc, &child};
        if (is_transform(child.name)) {
            if (node.transforms.size() == node.transforms.capacity()) continue;  // not affordable
            TargetRef ref{Owner::Transform, number, uint32_t(node.transforms.size())};
            node.transforms.push_back(read_transform(x, part));
            ref.count = node.transforms.back().slot.count;
            x.target_of[&child] = ref;
        } else if (child.name == "instance_geometry" || child.name == "instance_controller") {
            read_mesh_instance(x, part, node, number);
        } else if (child.name == "instance_light") {
            read_light_instance(x, part, node);
        } else if (child.name == "instance_camera") {
            read_camera_instance(x, part, node);
        } else if (child.name == "instance_node") {
            read_node_instance(x, part, node);
        } else if (child.name == "node") {
            // Depth is that of the document, which is limited.
            uint32_t index = node_index(x, part);
            if (index == kNone) continue;
            node.children.push_back(index);
            if (x.nodes.is_filled(index)) continue;
            read_node(x, index, part, number);
        }
    }
    mend_order(x, link, node.transforms);
    x.scene.nodes[number] = std::move(node);
}

}  // namespace

void read_pending_nodes(Extraction& x) {
    while (!x.nodes.empty()) {
        auto [index, link] = x.nodes.take();
        if (!x.nodes.is_filled(index)) read_node(x, index, link, kNone);
    }
    // A node read through an instance before the node it is written in has no parent yet.
    for (uint32_t i = 0; i < x.scene.nodes.size(); ++i)
        for (uint32_t child : x.scene.nodes[i].children) x.scene.nodes[child].parent = i;
}

namespace {

// Whether the visual scene shows a mesh through nodes that are not hidden.
bool shows_a_mesh(const SceneData& scene) {
    std::vector<bool> seen(scene.nodes.size(), false);
    std::vector<uint32_t> waiting = scene.roots;
    while (!waiting.empty()) {
        uint32_t n = waiting.back();
        waiting.pop_back();
        const Node& node = scene.nodes[n];
        if (seen[n] || node.hidden) continue;
        seen[n] = true;
        if (!node.meshes.empty()) return true;
        waiting.insert(waiting.end(), node.children.begin(), node.children.end());
        for (const NodeInstance& instance : node.instances) waiting.push_back(instance.node);
    }
    return false;
}

}  // namespace

void settle_visibility(Extraction& x) {
    for (const auto& [number, flag] : x.hidden_nodes)
        if (!x.moving_visibility.contains(flag.element)) x.scene.nodes[number].hidden = true;
    bool any = shows_a_mesh(x.scene);
    for (const auto& [number, flag] : x.hidden_nodes) {
        Node& node = x.scene.nodes[number];
        node.hidden &= any;  // a file in which all is hidden is looked at nevertheless
        if (node.hidden)
            x.diag.report(Code::NODE_HIDDEN, x.text_where(flag),
                          node.id.empty() ? node.name : node.id);
    }
}

namespace {

std::string node_label(const Node& node) {
    return node.id.empty() ? "<node>" : "'" + node.id + "'";
}

// Depth first without recursion: chains of instances may be as long as the file.
class GraphCheck {
  public:
    explicit GraphCheck(Extraction& x) : x_(x), nodes_(x.scene.nodes), state_(nodes_.size()) {}

    void run(uint32_t root) {
        if (state_[root].color != White) return;
        enter(root);
        while (!path_.empty()) step();
    }
    uint64_t total(uint32_t node) const { return state_[node].total; }
    void report_limit(Location where) {
        if (!limit_reported_)
            x_.diag.report(Code::LINK_TOO_MANY, where,
                           fmt::format("instances unroll to more than {} nodes",
                                       x_.options.max_node_instances));
        limit_reported_ = true;
    }

  private:
    enum Color : uint8_t { White, Gray, Black };
    struct State {
        Color color = White;
        uint64_t total = 1;  // nodes below and including this one, unrolled
        uint32_t next_child = 0, next_instance = 0;
    };

    void enter(uint32_t node) {
        state_[node].color = Gray;
        path_.push_back(node);
    }

    void step() {
        uint32_t at = path_.back();
        State& s = state_[at];
        Node& node = nodes_[at];
        if (s.next_child < node.children.size()) {
            uint32_t child = node.children[s.next_child];
            if (state_[child].color == White) return enter(child);
            ++s.next_child;
            s.total += state_[child].total;
            return;
        }
        if (s.next_instance < node.instances.size()) return step_instance(s, node);
        std::erase_if(node.instances, [](const NodeInstance& i) { return i.node == kNone; });
        s.color = Black;
        path_.pop_back();
    }

    void step_instance(State& s, Node& node) {
        NodeInstance& instance = node.instances[s.next_instance];
        State& target = state_[instance.node];
        if (target.color == White) return enter(instance.node);
        bool cycle = target.color == Gray;
        bool over = s.total + target.total > x_.options.max_node_instances;
        if (cycle) report_cycle(instance);
        if (!cycle && over) report_limit(instance.where);
        if (cycle || over)
            instance.node = kNone;
        else
            s.total += target.total;
        ++s.next_instance;
    }

    void report_cycle(const NodeInstance& instance) {
        auto from = std::find(path_.begin(), path_.end(), instance.node);
        // Where several documents take part, each node says which is its own.
        uint32_t own = nodes_[instance.node].document;
        bool several =
            std::any_of(from, path_.end(), [&](uint32_t n) { return nodes_[n].document != own; });
        auto label = [&](uint32_t n) {
            const Node& node = nodes_[n];
            if (!several) return node_label(node);
            const std::string& path = x_.scene.documents[node.document].path;
            std::string file = path.substr(path.rfind('/') + 1);
            return node.id.empty() ? "<node> of '" + file + "'" : "'" + file + "#" + node.id + "'";
        };
        std::string text;
        size_t shown = 0;
        for (auto n = from; n != path_.end(); ++n, ++shown) {
            if (shown == 16) {
                text += "... -> ";
                break;
            }
            text += label(*n) + " -> ";
        }
        x_.diag.report(Code::LINK_CYCLE, instance.where, text + label(instance.node));
    }

    Extraction& x_;
    std::vector<Node>& nodes_;
    std::vector<State> state_;
    std::vector<uint32_t> path_;
    bool limit_reported_ = false;
};

}  // namespace

void check_node_graph(Extraction& x) {
    GraphCheck check(x);
    uint64_t total = 0;
    std::vector<uint32_t> roots;
    for (uint32_t root : x.scene.roots) {
        check.run(root);
        if (total + check.total(root) > x.options.max_node_instances) {
            check.report_limit(x.scene.nodes[root].where);
            continue;
        }
        total += check.total(root);
        roots.push_back(root);
    }
    x.scene.roots = std::move(roots);
    // Nodes reached only through skeletons and the like may have cycles of their own.
    for (uint32_t i = 0; i < x.scene.nodes.size(); ++i) check.run(i);
}

}  // namespace kinora::collada

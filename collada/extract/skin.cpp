// collada/extract/skin.cpp: <skin>: joints, inverse bind matrices and influences.
#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "collada/document/element_numbers_p.h"
#include "collada/extract/extract_p.h"
#include "collada/text/numbers_p.h"
#include "runtime/base/transform_matrix.h"

namespace kinora::collada {

dmat4 matrix_of_rows(const double* rows) {
    dmat4 m;
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c) m[c][r] = rows[r * 4 + c];
    return m;
}

namespace {

bool all_finite(const double* values, size_t count) {
    for (size_t i = 0; i < count; ++i)
        if (!std::isfinite(values[i])) return false;
    return true;
}

// All names that a node answers to and that hold a space.
void collect_spaced_names(const Element& root, std::unordered_set<std::string_view>& names) {
    const Element* e = &root;
    while (e) {  // document order without recursion
        if (e->name == "node")
            for (std::string_view key : {"sid", "name", "id"})
                if (e->value(key).find(' ') != std::string_view::npos) names.insert(e->value(key));
        if (e->first_child) {
            e = e->first_child;
            continue;
        }
        while (e && !e->next) e = e->parent;
        if (e) e = e->next;
    }
}

// "Bone 01 Bone 02" split at its spaces becomes two names again, by the names nodes have.
void join_spaced_names(Extraction& x, uint32_t doc, NameSource& source) {
    if (source.names.size() <= source.written_count || source.written_count == 0) return;
    std::unordered_set<std::string_view> known;
    collect_spaced_names(x.document(doc).root(), known);
    if (known.empty()) return;
    constexpr size_t kLongest = 12;  // words in one name
    std::vector<std::string_view> joined;
    for (size_t i = 0; i < source.names.size();) {
        size_t best = 1;
        std::string name(source.names[i]);
        std::string_view best_name = source.names[i];
        for (size_t n = 2; n <= kLongest && i + n <= source.names.size(); ++n) {
            name.append(" ").append(source.names[i + n - 1]);
            auto found = known.find(name);
            if (found != known.end()) best = n, best_name = *found;
        }
        joined.push_back(best_name);
        i += best;
    }
    if (joined.size() == source.names.size()) return;
    x.diag.report(Code::SKIN_JOINT_NAMES, x.where({doc, source.array}));
    source.names = std::move(joined);
}

struct SkinReader {
    Extraction& x;
    uint32_t doc;
    Skin& skin;
    const Element* joint_source = nullptr;

    bool read_base(const Element& element);
    void read_bind_shape(const Element& element);
    bool read_joints(const Element& element);
    void read_inverse_bind(Link joints);
    void read_weights(const Element& element);

  private:
    struct Layout {
        std::vector<double> weights;
        std::vector<int32_t> joint_of;  // index in the weights' JOINT source -> joint
        uint32_t joint_offset = 0, weight_offset = 0, stride = 1;
    };
    bool read_layout(Link weights, Layout& layout);
    void read_influences(Link weights, const Layout& layout);
    void check_weights();
    Link input_source(Link parent, std::string_view semantic);
};

Link SkinReader::input_source(Link parent, std::string_view semantic) {
    const Element* input = find_input(*parent.element, semantic);
    return input ? resolve(x, {parent.doc, input}, "source", {"source"}) : Link{};
}

bool SkinReader::read_base(const Element& element) {
    Link base = resolve(x, {doc, &element}, "source", {"geometry", "controller"});
    if (!base) return false;
    if (base.element->name == "geometry") {
        skin.geometry = geometry_index(x, base);
    } else if (base.element->child("morph")) {
        skin.morph = morph_index(x, base);
        if (skin.morph != kNone && x.scene.morphs[skin.morph].skin == kNone)
            skin.geometry = x.scene.morphs[skin.morph].geometry;
        else if (skin.morph != kNone)
            x.diag.report(Code::SKIN_UNUSABLE, x.where({doc, &element}, "source"), skin.id,
                          std::string("its source is a morph of another skin"));
    } else {
        x.diag.report(Code::SKIN_UNUSABLE, x.where({doc, &element}, "source"), skin.id,
                      std::string("its source is another skin"));
    }
    return skin.geometry != kNone;
}

void SkinReader::read_bind_shape(const Element& element) {
    const Element* matrix = element.child("bind_shape_matrix");
    if (!matrix) return;
    std::vector<double> rows = read_doubles(x.document(doc), *matrix, x.diag);
    if (rows.size() < 16 || !all_finite(rows.data(), 16)) {
        auto finite = std::ranges::count_if(rows, [](double n) { return std::isfinite(n); });
        x.diag.report(Code::SKIN_BIND_SHAPE, x.where({doc, matrix}), finite);
        return;
    }
    skin.has_bind_shape_matrix = true;
    skin.bind_shape_matrix = matrix_of_rows(rows.data());
}

bool SkinReader::read_joints(const Element& element) {
    const Element* joints = element.child("joints");
    Link source = joints ? input_source({doc, joints}, "JOINT") : Link{};
    if (!source) {
        x.diag.report(Code::SKIN_UNUSABLE, x.where({doc, &element}), skin.id,
                      std::string("it names no joints"));
        return false;
    }
    joint_source = source.element;
    NameSource names = read_name_source(x, source);
    join_spaced_names(x, source.doc, names);
    skin.joint_kind = names.kind;
    constexpr uint64_t kJointBytes = sizeof(std::string) + sizeof(dmat4);
    if (!x.budget.reserve(names.names.size() * kJointBytes, x.where(source))) return false;
    skin.joints.assign(names.names.begin(), names.names.end());
    skin.inverse_bind.assign(skin.joints.size(), dmat4(1.0));
    if (skin.joints.empty()) return false;
    read_inverse_bind({doc, joints});
    return true;
}

void SkinReader::read_inverse_bind(Link joints) {
    Link source = input_source(joints, "INV_BIND_MATRIX");
    DoubleSource data = source ? read_double_source(x, source) : DoubleSource{};
    size_t count = data.values.size() / 16;  // some accessors say stride 1, count 16n
    if (count != skin.joints.size())
        x.diag.report(Code::SKIN_IBM_COUNT, x.where(joints), count, skin.joints.size());
    for (size_t j = 0; j < std::min(count, skin.joints.size()); ++j) {
        const double* rows = &data.values[j * 16];
        if (!all_finite(rows, 16)) continue;
        skin.inverse_bind[j] = matrix_of_rows(rows);
        if (is_singular(skin.inverse_bind[j]))
            x.diag.report(Code::SKIN_IBM_SINGULAR, x.where(source), skin.joints[j]);
    }
}

bool SkinReader::read_layout(Link link, Layout& layout) {
    const Element* joint = find_input(*link.element, "JOINT");
    const Element* weight = find_input(*link.element, "WEIGHT");
    Link weights = weight ? input_source(link, "WEIGHT") : Link{};
    Link names = joint ? input_source(link, "JOINT") : Link{};
    if (!weights || !names) return false;
    layout.weights = read_double_source(x, weights).values;
    for (double& w : layout.weights)
        if (!std::isfinite(w)) w = 0;
    uint64_t a = 0, b = 1;
    if (joint->attribute("offset")) parse_count(joint->value("offset"), a);
    if (weight->attribute("offset")) parse_count(weight->value("offset"), b);
    if (a > 255 || b > 255) return false;
    layout.joint_offset = uint32_t(a);
    layout.weight_offset = uint32_t(b);
    for (const Element& child : link.element->children()) {
        uint64_t offset = 0;
        if (child.name == "input" && parse_count(child.value("offset"), offset) && offset < 256)
            layout.stride = std::max(layout.stride, uint32_t(offset) + 1);
    }
    layout.stride = uint32_t(std::max({uint64_t(layout.stride), a + 1, b + 1}));
    if (names.element == joint_source) {
        for (size_t j = 0; j < skin.joints.size(); ++j) layout.joint_of.push_back(int32_t(j));
        return true;
    }
    std::unordered_map<std::string_view, int32_t> numbers;
    for (size_t j = 0; j < skin.joints.size(); ++j) numbers.emplace(skin.joints[j], int32_t(j));
    for (std::string_view name : read_name_source(x, names).names) {
        auto found = numbers.find(name);
        layout.joint_of.push_back(found == numbers.end() ? -2 : found->second);
    }
    return true;
}

void SkinReader::read_influences(Link link, const Layout& layout) {
    const Element* vcount_element = link.element->child("vcount");
    const Element* v_element = link.element->child("v");
    size_t positions = skin.offsets.size() - 1;
    std::vector<int32_t> counts, v;
    if (vcount_element)
        counts = read_ints(x.document(doc), *vcount_element, x.diag, written_count(*link.element));
    if (v_element) v = read_ints(x.document(doc), *v_element, x.diag);
    uint64_t written = 0;
    bool has_count = parse_count(link.element->value("count"), written);
    if (has_count && written != counts.size())
        x.diag.report(Code::SKIN_COUNT, x.where(link, "count"), written, counts.size());
    if (counts.size() != positions)
        x.diag.report(Code::SKIN_VCOUNT,
                      x.where({doc, vcount_element ? vcount_element : link.element}),
                      fmt::format("<vcount> has {} entries, the mesh has {} vertices",
                                  counts.size(), positions));
    uint64_t wanted = 0;
    for (int32_t& c : counts) wanted += uint64_t(c = std::max(c, 0));
    if (wanted * layout.stride != v.size())
        x.diag.report(Code::SKIN_V_LEN, x.where({doc, v_element ? v_element : link.element}),
                      v.size(), wanted * layout.stride);
    size_t at = 0, bad = 0;
    for (size_t i = 0; i < positions; ++i) {
        int32_t count = i < counts.size() ? counts[i] : 0;
        for (int32_t k = 0; k < count && at + layout.stride <= v.size(); ++k, at += layout.stride) {
            int64_t joint = v[at + layout.joint_offset], weight = v[at + layout.weight_offset];
            bool known_joint = joint >= -1 && joint < int64_t(layout.joint_of.size());
            bool known_weight = weight >= 0 && weight < int64_t(layout.weights.size());
            int32_t mapped = known_joint && joint >= 0 ? layout.joint_of[size_t(joint)] : -1;
            if (!known_joint || !known_weight || mapped == -2) {
                ++bad;
                continue;
            }
            skin.influence_joints.push_back(mapped);
            skin.influence_weights.push_back(float(layout.weights[size_t(weight)]));
        }
        skin.offsets[i + 1] = uint32_t(skin.influence_joints.size());
    }
    if (bad) x.diag.report(Code::SKIN_INDEX, x.where({doc, v_element}), bad);
}

void SkinReader::check_weights() {
    size_t off = 0, none = 0;
    double worst = 1;
    for (size_t i = 0; i + 1 < skin.offsets.size(); ++i) {
        double sum = 0;
        for (uint32_t k = skin.offsets[i]; k < skin.offsets[i + 1]; ++k)
            sum += skin.influence_weights[k];
        if (sum == 0) {
            ++none;
        } else if (std::abs(sum - 1) > 1e-3) {
            ++off;
            if (std::abs(sum - 1) > std::abs(worst - 1)) worst = sum;
        }
    }
    if (off) x.diag.report(Code::SKIN_WEIGHT_SUM, skin.where, off, worst);
    if (none) x.diag.report(Code::SKIN_ZERO_INFLUENCE, skin.where, none);
}

void SkinReader::read_weights(const Element& element) {
    const Element* weights = element.child("vertex_weights");
    Layout layout;
    if (!weights || !read_layout({doc, weights}, layout)) {
        x.diag.report(Code::SKIN_UNUSABLE, x.where({doc, weights ? weights : &element}), skin.id,
                      std::string("it has no usable <vertex_weights>"));
        skin.joints.clear();
        skin.inverse_bind.clear();
        return;
    }
    read_influences({doc, weights}, layout);
    check_weights();
}

}  // namespace

uint32_t skin_index(Extraction& x, Link link) {
    auto [at, fresh] = x.made.emplace(link.element, kNone);
    if (!fresh) return at->second;
    uint32_t& result = at->second;
    ControllerDepth depth(x);
    if (!depth.fits(link)) return result;
    const Element& element = *link.element->child("skin");
    Skin skin;
    skin.id = link.element->value("id");
    skin.where = x.where(link);
    SkinReader reader{x, link.doc, skin};
    if (!reader.read_base(element)) return result;
    size_t positions = x.scene.geometries[skin.geometry].positions.size();
    if (!x.budget.reserve(sizeof(Skin) + positions * sizeof(uint32_t), skin.where)) return result;
    skin.offsets.assign(positions + 1, 0);
    reader.read_bind_shape(element);
    x.skin_frames.push_back(x.frames.of(link));
    uint32_t conversion =
        x.frames.conversion(x.skin_frames.back(), x.geometry_frames[skin.geometry]);
    if (conversion != kNone)
        skin.bind_shape_matrix = skin.bind_shape_matrix * x.scene.conversions[conversion];
    if (reader.read_joints(element)) reader.read_weights(element);
    return result = append(x.scene.skins, std::move(skin));
}

}  // namespace kinora::collada

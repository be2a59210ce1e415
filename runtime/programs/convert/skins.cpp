// runtime/programs/convert/skins.cpp: --up and --unit: skins that the change of all nodes would
// move elsewhere than the rest.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/matrix.hpp>
#include <map>

#include "collada/document/write.h"
#include "collada/extract/extract.h"
#include "collada/scene/node_occurrences.h"
#include "runtime/programs/convert/axes_p.h"
#include "runtime/programs/convert/convert.h"
#include "runtime/scene/description/findings.h"

namespace kinora {

using collada::Document;
using collada::Edit;
using collada::Element;

std::string_view trimmed(std::string_view text) {
    size_t begin = text.find_first_not_of(" \t\r\n");
    if (begin == text.npos) return {};
    return text.substr(begin, text.find_last_not_of(" \t\r\n") + 1 - begin);
}

std::string rows_text(const dmat4& m) {
    std::string text;
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c)
            text += (r || c ? " " : "") + collada::shortest_number(m[c][r] == 0 ? 0.0 : m[c][r]);
    return text;
}

Edit replace_content(const Element& e, const std::string& text, std::string_view original) {
    uint32_t end = uint32_t(original.rfind("</", e.bytes.end - 1));
    return {{e.start_tag.end, end}, collada::escape_text(text)};
}

namespace {

dmat4 matrix_of(const double* rows) {
    dmat4 m;
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c) m[c][r] = rows[r * 4 + c];
    return m;
}

// Nothing where a word is no number.
std::vector<double> numbers_of(std::string_view text) {
    std::vector<double> numbers;
    while (!(text = trimmed(text)).empty()) {
        text.remove_prefix(text[0] == '+');
        double value = 0;
        auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc()) return {};
        numbers.push_back(value);
        text.remove_prefix(size_t(stop - text.data()));
    }
    return numbers;
}

// What a skinned vertex is multiplied by in the end.
dmat4 placement(const SkinPlacement& stand, const SkinPose& pose) {
    if (stand.space == SkinSpace::Node) return pose.node;
    if (stand.space == SkinSpace::NodeBelow) return pose.node * glm::inverse(pose.shared);
    return dmat4(1.0);
}

SkinPose changed(SkinPose pose, const dmat4& change) {
    pose.node = change * pose.node;
    pose.shared = change * pose.shared;
    for (RestJoint& joint : pose.joints) joint.world = change * joint.world;
    return pose;
}

bool alike(const dmat4& a, const dmat4& b) {
    double size = 1, apart = 0;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) {
            size = std::max(size, std::abs(b[c][r]));
            apart = std::max(apart, std::abs(a[c][r] - b[c][r]));
        }
    return apart <= 1e-6 * size;
}

class SkinChange {
  public:
    SkinChange(const Document& document, const dmat4& change, Diagnostics& own, Diagnostics& diag)
        : document_(document),
          text_(own.files.text(document.file())),
          change_(change),
          own_(own),
          diag_(diag) {}

    std::vector<Edit> run() {
        std::optional<collada::SceneData> scene = collada::extract(document_, own_);
        if (scene) judge(*scene);
        for (const auto& [index, stand] : stands_) edit(*stand.skin, stand);
        return std::move(edits_);
    }

  private:
    struct Stand {
        const Element* skin;
        dmat4 bind;            // the bind_shape_matrix, written or meant
        bool written = false;  // it is in the file
        bool stays = true;     // the same to all who judge it after the change
    };

    // Where no bind shape is written, the positions of the joints say what is meant (skin_space.h).
    void judge(const collada::SceneData& scene) {
        collada::NodeOccurrences occurrences(scene);
        for (uint32_t at = 0; at < occurrences.all().size(); ++at)
            for (const collada::MeshInstance& mesh :
                 scene.nodes[occurrences.all()[at].node].meshes) {
                if (mesh.skin == collada::kNone) continue;
                const collada::Skin& skin = scene.skins[mesh.skin];
                const Element* controller = document_.find(skin.id);
                const Element* element = controller ? controller->child("skin") : nullptr;
                if (!element || skin.where.file != document_.file()) continue;
                collada::NodeOccurrences::SkinPoses poses = occurrences.skin_poses(at, mesh);
                add(*element, skin.bind_shape_matrix, poses.rest, poses.start);
            }
    }

    void add(const Element& skin, const dmat4& bind_shape, const SkinPose& rest,
             const SkinPose& start) {
        SkinPlacement before = skin_placement(bind_shape, rest, start);
        SkinPose rest_after = changed(rest, change_), start_after = changed(start, change_);
        SkinPlacement after = skin_placement(bind_shape, rest_after, start_after);
        Stand stand{&skin, bind_shape, before.space != SkinSpace::BindsNode, true};
        if (before.space == SkinSpace::BindsNode)
            stand.bind = before.bind;
        else
            stand.stays =
                alike(placement(after, rest_after) * change_, change_ * placement(before, rest)) &&
                after.space != SkinSpace::BindsNode;
        // Vertices of no joint stand by the bind shape alone.
        bool by_node = before.space == SkinSpace::Node || before.space == SkinSpace::NodeBelow;
        if (by_node && names_no_joint(skin)) stand.stays = false;
        auto [known, fresh] = stands_.emplace(skin.index, stand);
        bool agree =
            known->second.written == stand.written && alike(known->second.bind, stand.bind);
        known->second.stays = known->second.stays && stand.stays && agree;
    }

    // A bind shape that is written leaves nothing to judge. A vertex of joint -1 it places alone,
    // out of any node's reach: there it takes the change, which the joints' matrices give back: (M
    // J) (IBM inverse(M)) (M B) = M (J IBM B).
    void edit(const Element& skin, const Stand& stand) {
        bool no_joint = names_no_joint(skin);
        const Element* array = no_joint ? inverse_bind_array(skin) : nullptr;
        std::vector<double> inverse = array ? numbers_of(array->text) : std::vector<double>{};
        if (!stand.stays || (no_joint && (inverse.empty() || inverse.size() % 16 != 0))) {
            diag_.report(Code::CONVERT_LOST, Location{},
                         fmt::format("skin of '{}'", skin.parent->value("id")),
                         no_joint ? "the place of vertices of no joint" : "its place");
            return;
        }
        if (stand.written && !no_joint) return;
        write_bind_shape(skin, no_joint ? change_ * stand.bind : stand.bind);
        if (!no_joint) return;
        std::string text;
        for (size_t at = 0; at < inverse.size(); at += 16)
            text += (at ? " " : "") + rows_text(matrix_of(&inverse[at]) * glm::inverse(change_));
        edits_.push_back(replace_content(*array, text, text_));
    }

    void write_bind_shape(const Element& skin, const dmat4& bind) {
        if (const Element* shape = skin.child("bind_shape_matrix")) {
            edits_.push_back(replace_content(*shape, rows_text(bind), text_));
            return;
        }
        uint32_t at = skin.start_tag.end;
        edits_.push_back(
            {{at, at},
             collada::prefixed("<bind_shape_matrix>" + rows_text(bind) + "</bind_shape_matrix>",
                               collada::prefix_of(text_, document_.root()))});
    }

    // The numbers of INV_BIND_MATRIX, where they are this skin's own and lie one behind the other.
    const Element* inverse_bind_array(const Element& skin) const {
        const Element* joints = skin.child("joints");
        const Element* input = joints ? input_of(*joints, "INV_BIND_MATRIX") : nullptr;
        const Element* source = input ? target_of(input->value("source")) : nullptr;
        const Element* technique = source ? source->child("technique_common") : nullptr;
        const Element* accessor = technique ? technique->child("accessor") : nullptr;
        const Element* array = accessor ? target_of(accessor->value("source")) : nullptr;
        bool plain = array && source->parent == &skin && array->parent == source &&
                     accessor->value("stride") == "16" && !accessor->attribute("offset");
        return plain ? array : nullptr;
    }

    static const Element* input_of(const Element& parent, std::string_view semantic) {
        const Element* input = parent.child("input");
        while (input && input->value("semantic") != semantic) input = input->next_named("input");
        return input;
    }

    const Element* target_of(std::string_view url) const {
        return url.starts_with('#') ? document_.find(url.substr(1)) : nullptr;
    }

    static bool names_no_joint(const Element& skin) {
        const Element* weights = skin.child("vertex_weights");
        const Element* joint = weights ? input_of(*weights, "JOINT") : nullptr;
        const Element* v = weights ? weights->child("v") : nullptr;
        if (!joint || !v) return false;
        size_t stride = 1;
        for (const Element& input : weights->children())
            if (input.name == "input") stride = std::max(stride, offset_of(input) + 1);
        std::vector<double> indices = numbers_of(v->text);
        for (size_t i = offset_of(*joint); i < indices.size(); i += stride)
            if (indices[i] == -1) return true;
        return false;
    }

    static size_t offset_of(const Element& input) {
        std::vector<double> offset = numbers_of(input.value("offset"));
        return offset.size() == 1 && offset[0] >= 0 && offset[0] < 256 ? size_t(offset[0]) : 0;
    }

    const Document& document_;
    std::string_view text_;
    dmat4 change_;
    Diagnostics& own_;
    Diagnostics& diag_;
    std::map<uint32_t, Stand> stands_;  // by the number of <skin>
    std::vector<Edit> edits_;
};

}  // namespace

std::vector<Edit> change_skins(const Document& document, const dmat4& change, Diagnostics& own,
                               Diagnostics& diag) {
    return SkinChange(document, change, own, diag).run();
}

}  // namespace kinora
